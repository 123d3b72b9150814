// Ways to bring a module down for real.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { installed } from "./package.js";

/** pliant.wasm with room for so many pages of 64 kB only: it begins with 256. */
export function crampedWasm(pages: number): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(readFileSync(join(installed, "dist/pliant.wasm")));
  const [, limits] = number(bytes, sectionOf(bytes, memorySection)); // how many memories
  const [, most] = number(bytes, limits + 1); // flags, the least size
  const [before, end] = number(bytes, most);
  if (bytes[limits] !== 1 || end - most !== 3) {
    throw new Error(`the largest size is ${before} in ${end - most} bytes; expected 3`);
  }
  bytes.set([(pages & 127) | 128, ((pages >> 7) & 127) | 128, pages >> 14], most);
  return bytes;
}

const memorySection = 5;

/** Where the content of a section begins. */
function sectionOf(bytes: Uint8Array, wanted: number): number {
  for (let at = 8; at < bytes.length;) {
    const [size, content] = number(bytes, at + 1);
    if (bytes[at] === wanted) return content;
    at = content + size;
  }
  throw new Error(`there is no section ${wanted}`);
}

/** An integer as WebAssembly writes it, and where it ends. */
function number(bytes: Uint8Array, at: number): [number, number] {
  let value = 0;
  for (let shift = 0; ; shift += 7) {
    const byte = bytes[at++];
    value |= (byte & 127) << shift;
    if (byte < 128) return [value >>> 0, at];
  }
}

/** Starts a module and gives its memory beside what it gives. */
export async function withMemory<T>(start: () => Promise<T>): Promise<[T, WebAssembly.Memory]> {
  const { instantiate } = WebAssembly;
  let memory: WebAssembly.Memory | undefined;
  WebAssembly.instantiate = (async (module: WebAssembly.Module, imports: WebAssembly.Imports) => {
    const instance = await instantiate(module, imports);
    memory = Object.values(instance.exports).find((value) => value instanceof WebAssembly.Memory);
    return instance;
  }) as never;
  try {
    return [await start(), memory!];
  } finally {
    WebAssembly.instantiate = instantiate;
  }
}

/** Overwrites all that the module knows: the next call that follows a pointer traps. */
export function scramble(memory: WebAssembly.Memory): void {
  new Uint8Array(memory.buffer).fill(0xff);
}
