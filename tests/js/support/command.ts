// Runs the installed command in a folder of its own.

import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { consumer } from "./package.js";

export class Folder {
  readonly path = mkdtempSync(join(tmpdir(), "pliant-command-"));

  /** The command as npm links it. */
  run(...args: string[]): { status: number | null; out: string; err: string } {
    const command = join(consumer, "node_modules/.bin/pliant");
    const { status, stdout, stderr } = spawnSync(process.execPath, [command, ...args], {
      cwd: this.path, encoding: "utf8",
    });
    return { status, out: stdout, err: stderr };
  }

  write(name: string, content: string | Uint8Array | object): string {
    const plain = typeof content === "string" || content instanceof Uint8Array;
    writeFileSync(join(this.path, name), plain ? content : JSON.stringify(content));
    return name;
  }

  text(name: string): string {
    return readFileSync(join(this.path, name), "utf8");
  }

  bytes(name: string): Uint8Array {
    return readFileSync(join(this.path, name));
  }

  json(name: string) {
    return JSON.parse(this.text(name));
  }

  list(): string[] {
    return readdirSync(this.path).sort();
  }

  remove(): void {
    rmSync(this.path, { recursive: true, force: true });
  }
}

/** Coordinates of the `v` lines of an OBJ file. */
export function objPositions(text: string): Float64Array {
  return Float64Array.from(
    text
      .split("\n")
      .filter((line) => line.startsWith("v "))
      .flatMap((line) => line.split(/\s+/).slice(1, 4).map(Number)),
  );
}
