// Packs the package and installs it into an empty project, as a user would: every test runs on that.

import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import type { TestProject } from "vitest/node";

declare module "vitest" {
  export interface ProvidedContext {
    /** The project that has the package in its node_modules. */
    consumer: string;
    tarball: string;
  }
}

const root = resolve(import.meta.dirname, "../../..");

/** Imports every entry, so that tests resolve them as an application does. */
const entries = `
export * as pliant from "pliant";
export * as inline from "pliant/inline";
export * as io from "pliant/io";
export * as worker from "pliant/worker";
export * as picture from "pliant/picture";
export * as three from "pliant/three";
`;

export default function setup({ provide }: TestProject): () => void {
  if (!existsSync(join(root, "dist/pliant.js"))) throw new Error("dist/ is missing; run: npm run build");
  const consumer = mkdtempSync(join(tmpdir(), "pliant-consumer-"));
  const npm = (args: string[], cwd: string) =>
    execFileSync("npm", [...args, "--loglevel=error"], { cwd, encoding: "utf8" });
  const [{ filename }] = JSON.parse(npm(["pack", "--json", "--ignore-scripts", "--pack-destination", consumer], root));
  const tarball = join(consumer, filename);
  writeFileSync(join(consumer, "package.json"), JSON.stringify({ name: "consumer", private: true, type: "module" }));
  npm(["install", "--offline", "--no-audit", "--no-fund", tarball], consumer);
  writeFileSync(join(consumer, "entries.mjs"), entries);
  provide("consumer", consumer);
  provide("tarball", tarball);
  return () => rmSync(consumer, { recursive: true, force: true });
}
