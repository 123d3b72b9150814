// Files of the formats that pliant-io.wasm knows.

import { PliantError } from "../boundary/errors.js";
import type { RawDocument, RawRewriter, RawScratch } from "../boundary/raw.js";
import { accept, put } from "../boundary/core.js";
import type { TextFormat } from "./format.js";
import type { IoModule } from "./module.js";
import type { Pause } from "./pause.js";
import type { Mesh } from "./shape_file.js";

/** Of a file so many bytes pass through a rewriter at once. */
const pieceSize = 4 << 20;

/** `pause` is told the fraction that has been read. Errors: parse-error, too-large, aborted. */
export function readText(io: IoModule, format: TextFormat, bytes: Uint8Array, pause: Pause): Promise<Mesh> {
  return io.use(async ({ Document, Scratch }, free) => {
    const [document, scratch] = [free(new Document()), free(new Scratch())];
    put(scratch.bytes(bytes.length), bytes);
    accept(document.begin(format, scratch));
    for (let fraction = 0; fraction < 1;) {
      await pause(fraction);
      const advanced = document.advance();
      accept(advanced.status);
      fraction = advanced.fraction;
    }
    return meshOf(document);
  });
}

function meshOf(document: RawDocument): Mesh {
  return {
    positions: document.positions().slice(),
    triangles: document.triangles().slice(),
    faceVertices: document.faceVertices().slice(),
    faceOffsets: document.faceOffsets().slice(),
    texcoords: document.cornerTexcoords().slice(),
    colors: document.colors().slice(),
  };
}

/** A mesh as a file of its own. Errors: invalid-shape, too-large. */
export function writeText(io: IoModule, format: TextFormat, mesh: Mesh): Promise<Uint8Array<ArrayBuffer>> {
  return io.use(async ({ Document, Scratch }, free) => {
    const [document, scratch] = [free(new Document()), free(new Scratch())];
    put(scratch.doubles(mesh.positions.length), mesh.positions);
    const polygons = packPolygons(mesh);
    put(scratch.integers(polygons.length), polygons);
    accept(document.assign(scratch));
    if (mesh.texcoords.length > 0) {
      put(scratch.doubles(mesh.texcoords.length), mesh.texcoords);
      accept(document.assignTexcoords(scratch));
    }
    if (mesh.colors.length > 0) {
      put(scratch.bytes(mesh.colors.length), mesh.colors);
      accept(document.assignColors(scratch));
    }
    put(scratch.doubles(mesh.positions.length), mesh.positions);
    const { status, bytes } = document.write(format, scratch);
    accept(status);
    return bytes.slice();
  });
}

function packPolygons({ faceVertices, faceOffsets }: Mesh): Int32Array {
  const packed = new Int32Array(faceVertices.length + faceOffsets.length - 1);
  let at = 0;
  for (let face = 0; face + 1 < faceOffsets.length; ++face) {
    const [begin, end] = [faceOffsets[face], faceOffsets[face + 1]];
    packed[at++] = end - begin;
    for (let corner = begin; corner < end; ++corner) packed[at++] = faceVertices[corner];
  }
  return packed;
}

/** The same file with its vertices at other places. Errors: invalid-shape, parse-error, too-large. */
export async function rewriteText(
  io: IoModule, format: TextFormat, file: Uint8Array, positions: Float64Array,
): Promise<Uint8Array<ArrayBuffer>> {
  let done = 0;
  const move = (points: Float64Array) => {
    if (done + points.length <= positions.length) points.set(positions.subarray(done, done + points.length));
    done += points.length;
  };
  const pieces: Uint8Array[] = [];
  const taken = { largest: Infinity, normals: false };
  for await (const piece of rewritten(io, format, piecesOf(file), move, taken)) pieces.push(piece);
  if (done === positions.length) return joined(pieces);
  throw new PliantError(
    "invalid-shape",
    `positions has ${positions.length / 3} vertices; expected ${done / 3}, as the file it was read from`,
  );
}

function* piecesOf(file: Uint8Array): Generator<Uint8Array> {
  for (let at = 0; at < file.length; at += pieceSize) yield file.subarray(at, at + pieceSize);
}

function joined(pieces: Uint8Array[]): Uint8Array<ArrayBuffer> {
  const file = new Uint8Array(pieces.reduce((length, piece) => length + piece.length, 0));
  let at = 0;
  for (const piece of pieces) {
    file.set(piece, at);
    at += piece.length;
  }
  return file;
}

/**
 * Changes the coordinates of a piece of a file, three a point, in place; and the normals of its points, where the
 * format says which point each belongs to: as many, of any length.
 */
export type Move = (points: Float64Array, normals: Float64Array | undefined) => void | Promise<void>;

interface Taken {
  /** A coordinate beyond it is an error of the file. */
  largest: number;
  /** Whether normals are changed; else they are left out, as they belong to the old shape. */
  normals: boolean;
}

/**
 * A file passed through in pieces, of any size: those of the new file, in memory bounded by the size of a piece.
 * Errors: parse-error, invalid-shape, those of its arguments.
 */
export function rewritten(
  io: IoModule,
  format: TextFormat,
  pieces: Iterable<Uint8Array> | AsyncIterable<Uint8Array>,
  move: Move,
  { largest, normals }: Taken,
): AsyncGenerator<Uint8Array<ArrayBuffer>> {
  return io.stream(async function* ({ Rewriter, Scratch }, free) {
    const [rewriter, scratch] = [free(new Rewriter()), free(new Scratch())];
    accept(rewriter.open(format, largest, normals));
    for await (const given of pieces) {
      for (const piece of piecesOf(given)) yield await passed(rewriter, scratch, piece, false, move);
    }
    yield await passed(rewriter, scratch, new Uint8Array(0), true, move);
  });
}

async function passed(
  rewriter: RawRewriter, scratch: RawScratch, piece: Uint8Array, last: boolean, move: Move,
): Promise<Uint8Array<ArrayBuffer>> {
  put(scratch.bytes(piece.length), piece);
  const found = rewriter.push(scratch, last);
  accept(found.status);
  const both = new Float64Array(found.points.length + found.normals.length);
  both.set(found.points);
  both.set(found.normals, found.points.length);
  const [points, normals] = [both.subarray(0, found.points.length), both.subarray(found.points.length)];
  if (points.length > 0) await move(points, normals.length > 0 ? normals : undefined);
  put(scratch.doubles(both.length), both);
  const written = rewriter.emit(scratch);
  accept(written.status);
  return written.bytes.slice();
}
