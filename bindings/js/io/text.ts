// Files of the formats that pliant-io.wasm knows.

import { PliantError } from "../boundary/errors.js";
import type { RawDocument, RawRewriter, RawScratch } from "../boundary/raw.js";
import { accept, put } from "../boundary/core.js";
import type { TextFormat } from "./format.js";
import type { IoModule } from "./module.js";
import type { Pause } from "./pause.js";
import type { Mesh } from "./shape_file.js";

/** A file of which the next bytes pass through a rewriter at once. */
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
  const pieces = await rewritten(io, format, piecesOf(file), move);
  if (done === positions.length) return joined(pieces);
  throw new PliantError(
    "invalid-shape",
    `positions has ${positions.length / 3} vertices; expected ${done / 3}, as the file it was read from`,
  );
}

function* piecesOf(file: Uint8Array): Generator<Uint8Array> {
  for (let at = 0; at < file.length; at += pieceSize) yield file.subarray(at, at + pieceSize);
}

async function rewritten(
  io: IoModule, format: TextFormat, file: Iterable<Uint8Array>, move: (points: Float64Array) => void,
): Promise<Uint8Array[]> {
  const pieces: Uint8Array[] = [];
  await rewriteStream(io, format, file, move, (piece) => void pieces.push(piece));
  return pieces;
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
 * Passes a file through in pieces. `move` changes the coordinates of a piece, three a point, in place; `emit` gets what
 * is to be written. Memory is bounded by the size of a piece. Errors: parse-error, invalid-shape, those of its
 * arguments.
 */
export function rewriteStream(
  io: IoModule,
  format: TextFormat,
  pieces: Iterable<Uint8Array> | AsyncIterable<Uint8Array>,
  move: (points: Float64Array) => void,
  emit: (piece: Uint8Array) => void | Promise<void>,
): Promise<void> {
  return io.use(async ({ Rewriter, Scratch }, free) => {
    const [rewriter, scratch] = [free(new Rewriter()), free(new Scratch())];
    accept(rewriter.open(format));
    for await (const piece of pieces) await emit(passed(rewriter, scratch, piece, false, move));
    await emit(passed(rewriter, scratch, new Uint8Array(0), true, move));
  });
}

function passed(
  rewriter: RawRewriter, scratch: RawScratch, piece: Uint8Array, last: boolean, move: (points: Float64Array) => void,
): Uint8Array {
  put(scratch.bytes(piece.length), piece);
  const { status, points } = rewriter.push(scratch, last);
  accept(status);
  const moved = points.slice();
  if (moved.length > 0) move(moved);
  put(scratch.doubles(moved.length), moved);
  const written = rewriter.emit(scratch);
  accept(written.status);
  return written.bytes.slice();
}
