import { defineConfig } from "vitest/config";

// The limits are for a test that hangs; no test depends on how long anything takes.
export default defineConfig({
  test: { dir: "tests/js", globalSetup: "tests/js/support/install.ts", testTimeout: 120_000, hookTimeout: 120_000 },
});
