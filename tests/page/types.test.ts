// The page and its tests are well typed: the bundler only strips types.
import { execFile } from "node:child_process";
import { join } from "node:path";
import { promisify } from "node:util";
import { expect, test } from "vitest";
import { root } from "./support/browser.ts";

test("the compiler accepts the page and its tests", async () => {
  const tsc = join(root, "node_modules/typescript/bin/tsc");
  const complaints = await promisify(execFile)(process.execPath, [tsc, "-p", join(root, "web-demo/tsconfig.json")])
    .then(() => "", (error: { stdout: string }) => error.stdout);
  expect(complaints).toBe("");
});
