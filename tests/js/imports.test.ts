// Data flows one way: no module of the package or of the page imports itself in a circle, types included.

import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { describe, expect, it } from "vitest";

const root = resolve(import.meta.dirname, "../..");

function sources(folder: string): string[] {
  return readdirSync(folder).flatMap((name) => {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) return sources(path);
    return /(?<!\.d)\.ts$/.test(name) ? [path] : [];
  });
}

/** The sources that one names in imports and exports, static and dynamic. */
function importsOf(path: string): string[] {
  const text = readFileSync(path, "utf8").replace(/^\s*(\/\/|\*|\/\*).*$/gm, "");
  const named = [...text.matchAll(/\b(?:from|import)\s*\(?\s*["'](\.[^"']+)["']/g)].map(([, name]) => name);
  return named.map((name) => resolve(dirname(path), name.replace(/\.js$/, ".ts"))).filter((file) => existsSync(file));
}

/** Every circle that a walk from the sources meets, as names from the root of the repository. */
function circles(folder: string): string[] {
  const done = new Set<string>();
  const found: string[] = [];
  const walk = (path: string, way: string[]) => {
    const before = way.indexOf(path);
    if (before >= 0) found.push([...way.slice(before), path].map((file) => relative(root, file)).join(" -> "));
    if (before >= 0 || done.has(path)) return;
    for (const next of importsOf(path)) walk(next, [...way, path]);
    done.add(path);
  };
  for (const path of sources(folder)) walk(path, []);
  return found;
}

describe.each(["bindings/js", "web-demo/src"])("%s", (folder) => {
  it("has modules that import each other", () => {
    const files = sources(join(root, folder));
    expect(files.length).toBeGreaterThan(30);
    expect(files.flatMap(importsOf).length).toBeGreaterThan(100);
  });

  it("has no circle of imports", () => {
    expect(circles(join(root, folder))).toEqual([]);
  });
});
