// Shape files of every format, by their extension.

import { readFile } from "node:fs/promises";
import { extname } from "node:path";
import { toSpace } from "../boundary/check.js";
import { PliantError } from "../boundary/errors.js";
import { fetchBinary } from "../boundary/wasm.js";
import type { Refinement } from "../deform/sketch.js";
import { Files } from "../io/files.js";
import { formats, type WrittenFormat } from "../io/format.js";
import { IoModule } from "../io/module.js";
import { refined } from "../io/refined.js";
import type { PictureOptions, ShapeFile, WritableShape } from "../io/shape_file.js";
import { Failure, onFile } from "./failure.js";
import { pngCodec } from "./png_codec.js";

const module = new IoModule({}, () => fetchBinary(new URL("./pliant-io.wasm", import.meta.url)));

export const files = new Files(module, pngCodec);

/** The format of a file by its extension. */
export function formatOf<Format extends WrittenFormat>(path: string, among: readonly Format[]): Format {
  const format = extname(path).slice(1).toLowerCase();
  const known = among.find((name) => name === format);
  if (known) return known;
  const expected = among.map((name) => `.${name}`).join(" ");
  throw new Failure(`${path}: the extension is ${format ? `.${format}` : "missing"}; expected ${expected}`);
}

/** What the command's options say of pictures. Errors: a Failure that names the option. */
export function pictureOptions({ background, spacing }: Record<string, string | undefined>): PictureOptions {
  return {
    ...(background === undefined ? {} : { background: readColor(background) }),
    ...(spacing === undefined ? {} : { spacing: readSpacing(spacing) }),
  };
}

function readColor(text: string): NonNullable<PictureOptions["background"]> {
  if (text === "border" || text === "auto") return text;
  const [, red, green, blue] = /^#?([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(text) ?? [];
  if (red === undefined) throw new Failure(`--background is "${text}"; expected a colour as #ffffff, border or auto`);
  return [parseInt(red, 16), parseInt(green, 16), parseInt(blue, 16)];
}

function readSpacing(text: string): number {
  const pixels = Number(text);
  if (pixels > 0 && Number.isFinite(pixels)) return pixels;
  return fail(`--spacing is "${text}"; expected a number of pixels above 0`);
}

function fail(reason: string): never {
  throw new Failure(reason);
}

/** Errors: a Failure that names the file. */
export async function readShape(path: string, values: Record<string, string | undefined> = {}): Promise<ShapeFile> {
  const [format, picture] = [formatOf(path, formats), pictureOptions(values)];
  const [option] = Object.keys(picture);
  if (option !== undefined && format !== "png") {
    fail(`--${option} is given, and ${path} is no picture; expected a .png`);
  }
  const bytes = await onFile(path, () => readFile(path));
  try {
    return await files.read(bytes, path, { picture });
  } catch (error) {
    // Its message begins with the path.
    throw error instanceof PliantError ? new Failure(error.message, { cause: error }) : error;
  }
}

/** How a result is written: where its vertices are, and what there is beside. */
export interface Result extends Pick<WritableShape, "depths" | "frame"> {
  positions: Float64Array;
  refinement?: Refinement | undefined;
}

/**
 * The file with its vertices elsewhere, as the name of another says; with a refinement, what a mesh has: positions,
 * faces, texture coordinates and colours.
 */
export function written(file: ShapeFile, path: string, { refinement, ...result }: Result): Promise<Uint8Array> {
  return files.write({ ...(refinement ? refined(file, refinement) : file), ...result }, path);
}

/** One .glb that shows positions one after the other, at times in seconds. */
export async function animated(
  { source, format, dimension, texture, ...file }: ShapeFile, frames: Float64Array[], times: number[],
): Promise<Uint8Array> {
  const { animateGlb, skinOf } = await import("../io/glb.js");
  const bytes = format === "glb" ? new Uint8Array(await source.arrayBuffer()) : undefined;
  const inSpace = (positions: Float64Array) => Float64Array.from(toSpace(positions, dimension));
  const mesh = { ...file, positions: inSpace(file.positions) };
  return animateGlb(mesh, bytes, await skinOf(texture, dimension === 2), frames.map(inSpace), times);
}
