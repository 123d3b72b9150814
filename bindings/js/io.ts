// pliant/io: shape files in and out, in pages, in workers and in Node; pliant-io.wasm is loaded with the first file.

import { fields, flag, Place } from "./boundary/check.js";
import { fetchBinary, type InitOptions, readInitOptions } from "./boundary/wasm.js";
import { Files, type FileSource, type FileStream } from "./io/files.js";
import { IoModule } from "./io/module.js";
import type { PictureCodec } from "./picture/codec.js";
import type { ReadOptions, RewriteOptions, ShapeFile, WritableShape } from "./io/shape_file.js";
import type { Move } from "./io/text.js";

export { PliantError, type ErrorCode } from "./boundary/errors.js";
export type { InitOptions } from "./boundary/wasm.js";
export type { Files, FileSource, FileStream } from "./io/files.js";
export { type FileFormat, formats, type WrittenFormat, writtenFormats } from "./io/format.js";
export { refined } from "./io/refined.js";
export type {
  Frame, Mesh, PictureOptions, ReadOptions, ReadProgress, RewriteOptions, ShapeFile, WritableShape,
} from "./io/shape_file.js";
export type { Move } from "./io/text.js";
export type { PictureCodec } from "./picture/codec.js";

export interface FilesOptions extends InitOptions {
  /**
   * Takes the WASM from inside the script instead of from a file beside it: the default for a page opened from a file.
   */
  inline?: boolean;
  /** Reads and writes the pixels of pictures. Left out: the browser does; Node has nothing for it. */
  pictures?: PictureCodec;
}

let current: Files | undefined;

/**
 * Says where pliant-io.wasm comes from, before the first file; `read` and `write` then use it. Nothing is loaded yet.
 * Options left out: `pliant-io.wasm` beside this script. Errors: invalid-option.
 */
export function init(options?: FilesOptions): Files {
  const place = new Place("invalid-option", "options");
  const known = ["wasmUrl", "wasmBinary", "wasmModule", "inline", "pictures"];
  const { inline, pictures, ...rest } = fields(place, options ?? {}, known, "option of init");
  const source = readInitOptions(rest);
  const inside = inline === undefined ? globalThis.location?.protocol === "file:" : flag(place.at("inline"), inline);
  const codec = pictures === undefined ? undefined : readCodec(place.at("pictures"), pictures);
  const unpacked = async () => (await import("./io/unpack.js")).unpackIo();
  const beside = () => fetchBinary(new URL("./pliant-io.wasm", import.meta.url));
  current ??= new Files(new IoModule(source, inside ? unpacked : beside), codec);
  return current;
}

function readCodec(place: Place, value: unknown): PictureCodec {
  const { decode, encode } = fields(place, value, ["decode", "encode"]);
  if (typeof decode === "function" && typeof encode === "function") return value as PictureCodec;
  return place.reject("lacks a function; expected decode and encode");
}

/** See {@link Files.read}. */
export async function read(source: FileSource, name: string, options?: ReadOptions): Promise<ShapeFile> {
  return init().read(source, name, options);
}

/** See {@link Files.write}. */
export async function write(shape: WritableShape, name: string): Promise<Uint8Array<ArrayBuffer>> {
  return init().write(shape, name);
}

/** See {@link Files.rewrite}. */
export function rewrite(
  source: FileSource | FileStream, name: string, move: Move, options?: RewriteOptions,
): AsyncGenerator<Uint8Array<ArrayBuffer>> {
  return init().rewrite(source, name, move, options);
}
