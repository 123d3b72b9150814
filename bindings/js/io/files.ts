// Reading and writing shape files: one meaning in pages, workers and the command.

import { choice, coordinates, fields, integer, largest, list, Place, toSpace, vector } from "../boundary/check.js";
import { PliantError } from "../boundary/errors.js";
import { readCallback, readSignal, throwIfAborted } from "../boundary/task.js";
import { browserCodec, type PictureCodec } from "../picture/codec.js";
import { formatOf, formats, textFormats, writtenFormats } from "./format.js";
import type { IoModule } from "./module.js";
import { pauses } from "./pause.js";
import type {
  Frame, Mesh, PictureOptions, ReadOptions, RewriteOptions, ShapeFile, WritableShape,
} from "./shape_file.js";
import { type Move, readText, rewriteText, rewritten, writeText } from "./text.js";

/** A file: its bytes, or a Blob, as a file of the visitor is one. */
export type FileSource = Blob | ArrayBuffer | ArrayBufferView;

/** A file in pieces of any size. */
export type FileStream = ReadableStream<Uint8Array> | AsyncIterable<Uint8Array> | Iterable<Uint8Array>;

/** Readers and writers over one module. */
export class Files {
  /** @internal */
  constructor(readonly io: IoModule, readonly codec: PictureCodec = browserCodec) {}

  /**
   * Reads a shape. The ending of `name` tells the format; messages begin with it.
   * Errors: parse-error (with the line or byte, and the reason), too-large, invalid-option, aborted; of pictures also
   * invalid-shape, where nothing is to be seen.
   */
  async read(source: FileSource, name: string, options: ReadOptions = {}): Promise<ShapeFile> {
    const place = new Place("invalid-option", "options");
    const given = fields(place, options, ["signal", "onProgress", "picture"]);
    const signal = readSignal(place.at("signal"), given.signal);
    const onProgress = readCallback<ReadOptions["onProgress"]>(place.at("onProgress"), given.onProgress);
    const format = formatOf(new Place("invalid-option", "name"), name, formats);
    throwIfAborted(signal);
    return named(name, async () => {
      const bytes = await bytesOf(source);
      if (format === "png") {
        const { readPng } = await import("./png.js");
        const file = await readPng(this.codec, bytes, given.picture as PictureOptions);
        return { format, ...file, source: new Blob([bytes]) };
      }
      const pause = pauses({ signal, onProgress });
      const read =
        format === "glb" ? (await import("./glb.js")).readGlb(bytes) : readText(this.io, format, bytes, pause);
      return { format, dimension: 3, ...(await read), source: new Blob([bytes]) };
    });
  }

  /**
   * Writes a shape; the ending of `name` tells the format. A file that was read and goes back to its own format keeps
   * all but its coordinates (and normals, which they leave behind); in another format it keeps what that has room for.
   * A .png or .svg shows a shape in the plane with its `texture`. Errors: invalid-shape, invalid-option, too-large.
   */
  async write(shape: WritableShape, name: string): Promise<Uint8Array<ArrayBuffer>> {
    const format = formatOf(new Place("invalid-option", "name"), name, writtenFormats);
    const mesh = readMesh(shape);
    if (format === "png" || format === "svg") return this.#draw(shape, mesh, format);
    if (shape.source && shape.format === format) {
      const bytes = await bytesOf(shape.source);
      if (format === "glb") return (await import("./glb.js")).rewriteGlb(bytes, mesh.positions);
      return rewriteText(this.io, format, bytes, mesh.positions);
    }
    if (format === "glb") {
      const { writeGlb } = await import("./glb.js");
      return writeGlb(await inLayers(shape, mesh), shape.texture, shape.dimension === 2);
    }
    return writeText(this.io, format, mesh);
  }

  /**
   * A file of any size with its vertices at other places, in bounded memory: the pieces of the new file, in the format
   * of the old one. `move` changes the coordinates of a piece in place, and the normals that a PLY file has of
   * vertices; all else stays as it is, byte for byte, but for normals that say not whose they are (OBJ, OFF), which
   * are left out. Coordinates become double. Not for .glb. Errors: as `read`, and those of `move`.
   */
  async *rewrite(
    source: FileSource | FileStream, name: string, move: Move, options: RewriteOptions = {},
  ): AsyncGenerator<Uint8Array<ArrayBuffer>> {
    const place = new Place("invalid-option", "options");
    const signal = readSignal(place.at("signal"), fields(place, options, ["signal"]).signal);
    if (typeof move !== "function") new Place("invalid-option", "move").fail(move, "a function");
    const format = formatOf(new Place("invalid-option", "name"), name, textFormats);
    throwIfAborted(signal);
    try {
      for await (const piece of rewritten(this.io, format, streamOf(source), move, { largest, normals: true })) {
        throwIfAborted(signal);
        yield piece;
      }
    } catch (error) {
      throw namedError(name, error);
    }
  }

  /** Errors: invalid-shape. */
  async #draw(shape: WritableShape, mesh: Mesh, format: "png" | "svg"): Promise<Uint8Array<ArrayBuffer>> {
    const place = new Place("invalid-shape", "dimension");
    if (shape.dimension !== 2) place.fail(shape.dimension ?? 3, `2: a .${format} shows a shape in the plane`);
    const { writePng, writeSvg } = await import("./png.js");
    const frame = readFrame(new Place("invalid-shape", "frame"), shape.frame);
    const shown = { mesh, texture: shape.texture, depths: depthsOf(shape, mesh), frame };
    return format === "png" ? writePng(this.codec, shown) : writeSvg(this.codec, shown);
  }
}

/** Errors begin with the name of the file. */
async function named<T>(name: string, work: () => Promise<T>): Promise<T> {
  try {
    return await work();
  } catch (error) {
    throw namedError(name, error);
  }
}

function namedError(name: string, error: unknown): unknown {
  if (!(error instanceof PliantError) || error.code === "aborted") return error;
  return new PliantError(error.code, `${name}: ${error.message}`, { cause: error });
}

/** Not every engine iterates streams yet. */
async function* streamOf(source: unknown): AsyncGenerator<Uint8Array> {
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return yield bytesOf(source);
  const stream = source instanceof Blob ? source.stream() : source;
  if (typeof ReadableStream !== "function" || !(stream instanceof ReadableStream)) return yield* chunks(stream);
  const reader = stream.getReader() as ReadableStreamDefaultReader<unknown>;
  try {
    for (let next = await reader.read(); !next.done; next = await reader.read()) yield chunk(next.value);
  } finally {
    await reader.cancel();
  }
}

async function* chunks(source: unknown): AsyncGenerator<Uint8Array> {
  const given = typeof source === "object" && source !== null ? source : {};
  if (!(Symbol.asyncIterator in given || Symbol.iterator in given)) {
    const expected = "a Blob, an ArrayBuffer, a typed array or a stream of bytes";
    new Place("invalid-option", "source").fail(source, expected);
  }
  for await (const piece of source as AsyncIterable<unknown>) yield chunk(piece);
}

function chunk(piece: unknown): Uint8Array {
  if (piece instanceof Uint8Array) return piece;
  return new Place("invalid-option", "source").reject("gives something else than bytes; expected Uint8Arrays");
}

async function bytesOf(source: unknown): Promise<Uint8Array<ArrayBuffer>> {
  if (source instanceof Blob) return new Uint8Array(await source.arrayBuffer());
  if (source instanceof ArrayBuffer) return new Uint8Array(source);
  if (ArrayBuffer.isView(source)) {
    return new Uint8Array(source.buffer as ArrayBuffer, source.byteOffset, source.byteLength);
  }
  return new Place("invalid-option", "source").fail(source, "a Blob, an ArrayBuffer or a typed array");
}

const keys = [
  "positions", "triangles", "dimension", "faceVertices", "faceOffsets", "texcoords", "colors", "texture", "format",
  "source", "depths", "frame",
];

/** A checked shape with all that a mesh has; without polygons the triangles are the faces. */
function readMesh(value: unknown): Mesh {
  const place = new Place("invalid-shape", "shape");
  const shape = fields(place, value, keys) as unknown as WritableShape;
  if (shape.format !== undefined) choice(place.at("format"), shape.format, formats);
  for (const key of ["source", "texture"] as const) {
    if (shape[key] !== undefined && !(shape[key] instanceof Blob)) place.at(key).fail(shape[key], "a Blob");
  }
  const dimension = shape.dimension === undefined ? 3 : integer(place.at("dimension"), shape.dimension, 2, 3);
  const positions = Float64Array.from(
    toSpace(coordinates(place.at("positions"), shape.positions, dimension), dimension),
  );
  const triangles = vertexIds(place.at("triangles"), shape.triangles, positions.length / 3);
  if (triangles.length % 3 !== 0) place.at("triangles").fail(triangles, "three vertex ids a triangle");
  const polygons = shape.faceVertices && shape.faceOffsets && shape.faceOffsets.length > 0;
  const faceVertices = polygons
    ? vertexIds(place.at("faceVertices"), shape.faceVertices, positions.length / 3)
    : triangles;
  const faceOffsets = polygons
    ? offsets(place.at("faceOffsets"), shape.faceOffsets, faceVertices.length)
    : triplets(triangles.length / 3);
  return {
    positions, triangles, faceVertices, faceOffsets,
    texcoords: Float64Array.from(sized(place.at("texcoords"), shape.texcoords, 2 * faceVertices.length)),
    colors: Uint8Array.from(sized(place.at("colors"), shape.colors, positions.length)),
  };
}

/** No viewer knows of depths: the order of triangles has to do. */
async function inLayers(shape: WritableShape, mesh: Mesh): Promise<Mesh> {
  const depths = depthsOf(shape, mesh);
  return depths ? (await import("./png.js")).layered(mesh, depths) : mesh;
}

function depthsOf({ depths }: WritableShape, { positions }: Mesh): Float64Array | undefined {
  return depths && Float64Array.from(sized(new Place("invalid-shape", "depths"), depths, positions.length / 3));
}

function readFrame(place: Place, value: unknown): Frame | "fit" | undefined {
  if (value === undefined || value === "fit") return value;
  const { width, height, origin } = fields(place, value, ["width", "height", "origin"]);
  const side = (key: string, given: unknown) => integer(place.at(key), given, 1, 16384, "pixels");
  const [x, y] = vector(place.at("origin"), origin, 2);
  return { width: side("width", width), height: side("height", height), origin: [x, y] };
}

function numbers(place: Place, value: unknown): ArrayLike<number> {
  return value === undefined ? [] : (list(place, value, "an array of numbers") as ArrayLike<number>);
}

/** None, or so many numbers. */
function sized(place: Place, value: unknown, length: number): ArrayLike<number> {
  const given = numbers(place, value);
  return given.length === 0 || given.length === length ? given : place.fail(value, `${length} numbers, or none`);
}

function vertexIds(place: Place, value: unknown, count: number): Uint32Array {
  const ids = numbers(place, value);
  for (let i = 0; i < ids.length; ++i) {
    if (!(ids[i] >= 0 && ids[i] < count && Number.isInteger(ids[i]))) {
      integer(place.item(i), ids[i], 0, count - 1, "a vertex id");
    }
  }
  return Uint32Array.from(ids);
}

/** Where each polygon begins, and where the last one ends. */
function offsets(place: Place, value: unknown, corners: number): Uint32Array {
  const given = numbers(place, value);
  for (let i = 0; i < given.length; ++i) {
    const least = i === 0 ? 0 : given[i - 1] + 3;
    const most = i === 0 ? 0 : corners;
    if (!(given[i] >= least && given[i] <= most)) {
      integer(place.item(i), given[i], least, most, "where a polygon of three corners or more begins");
    }
  }
  return given[given.length - 1] === corners
    ? Uint32Array.from(given)
    : place.reject(`ends at ${given[given.length - 1]}; expected ${corners}, the corners there are`);
}

/** Where triangles begin. */
const triplets = (count: number): Uint32Array => Uint32Array.from({ length: count + 1 }, (_, i) => 3 * i);
