// Sources read beside each other: no line is wider than the formatter of C++ makes them.

import { readdirSync, readFileSync, statSync } from "node:fs";
import { join, relative, resolve } from "node:path";
import { expect, it } from "vitest";

const root = resolve(import.meta.dirname, "../..");
const columns = Number(/ColumnLimit: (\d+)/.exec(readFileSync(join(root, ".clang-format"), "utf8"))![1]);

function sources(folder: string): string[] {
  return readdirSync(folder).flatMap((name) => {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) return sources(path);
    return /\.(ts|mjs|cpp|h)$|^CMakeLists\.txt$/.test(name) ? [path] : [];
  });
}

/** Lines that are too wide, as editors take them: file and number. */
function tooWide(path: string): string[] {
  const lines = readFileSync(path, "utf8").split("\n");
  return lines.flatMap((line, i) => ([...line].length > columns ? [`${relative(root, path)}:${i + 1}`] : []));
}

it.each(["bench", "bindings", "scripts", "src", "tests", "web-demo"])("%s has no line above the columns", (folder) => {
  const files = sources(join(root, folder));
  expect(files.length).toBeGreaterThan(5);
  expect(files.flatMap(tooWide)).toEqual([]);
});
