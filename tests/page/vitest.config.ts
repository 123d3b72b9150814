import { defineConfig } from "vitest/config";

// One browser at a time: pictures are drawn without a GPU, on the same few cores. The limits are for a
// page that hangs; no test depends on how long anything takes.
export default defineConfig({
  test: { dir: "tests/page", fileParallelism: false, testTimeout: 180_000, hookTimeout: 120_000 },
});
