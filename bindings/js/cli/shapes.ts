// Shape files of every format, by their extension.

import { readFile } from "node:fs/promises";
import { extname } from "node:path";
import { PliantError } from "../boundary/errors.js";
import { fetchBinary } from "../boundary/wasm.js";
import type { Refinement } from "../deform/sketch.js";
import { Files } from "../io/files.js";
import { type FileFormat, formats } from "../io/format.js";
import { IoModule } from "../io/module.js";
import { refined } from "../io/refined.js";
import type { ShapeFile } from "../io/shape_file.js";
import { Failure, onFile } from "./failure.js";

export const files = new Files(new IoModule({}, () => fetchBinary(new URL("./pliant-io.wasm", import.meta.url))));

/** The format of a file by its extension. */
export function formatOf<Format extends FileFormat>(path: string, among: readonly Format[]): Format {
  const format = extname(path).slice(1).toLowerCase();
  const known = among.find((name) => name === format);
  if (known) return known;
  const expected = among.map((name) => `.${name}`).join(" ");
  throw new Failure(`${path}: the extension is ${format ? `.${format}` : "missing"}; expected ${expected}`);
}

/** Errors: a Failure that names the file. */
export async function readShape(path: string): Promise<ShapeFile> {
  formatOf(path, formats);
  const bytes = await onFile(path, () => readFile(path));
  try {
    return await files.read(bytes, path);
  } catch (error) {
    // Its message begins with the path.
    throw error instanceof PliantError ? new Failure(error.message, { cause: error }) : error;
  }
}

/**
 * The file with its vertices elsewhere, as the name of another says; with a refinement, what a mesh has: positions,
 * faces, texture coordinates and colours.
 */
export function written(
  file: ShapeFile, path: string, positions: Float64Array, refinement?: Refinement,
): Promise<Uint8Array> {
  return files.write({ ...(refinement ? refined(file, refinement) : file), positions }, path);
}

/** One .glb that shows positions one after the other, at times in seconds. */
export async function animated(
  { source, format, ...file }: ShapeFile, frames: Float64Array[], times: number[],
): Promise<Uint8Array> {
  const { animateGlb } = await import("../io/glb.js");
  return animateGlb(file, format === "glb" ? new Uint8Array(await source.arrayBuffer()) : undefined, frames, times);
}
