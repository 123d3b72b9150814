// pliant-io.wasm: the readers and writers of text and binary shape files.

import { readFile } from "node:fs/promises";
import createModule from "#wasm/pliant-io.mjs";
import { accept, put } from "../boundary/core.js";
import type { RawDocument, RawIoModule, RawRewriter, RawScratch } from "../boundary/raw.js";
import { instantiate } from "../boundary/wasm.js";

let started: Promise<RawIoModule> | undefined;

function start(): Promise<RawIoModule> {
  const load = async () => instantiate(createModule, await WebAssembly.compile(await readFile(new URL("./pliant-io.wasm", import.meta.url))));
  return (started ??= load());
}

/** What a file holds; positions are in double. */
export interface Mesh {
  positions: Float64Array;
  triangles: Uint32Array;
  /** Polygons: vertex ids, and where each begins (one more than there are faces). */
  faceVertices: Uint32Array;
  faceOffsets: Uint32Array;
  /** Two a corner, in the order of `faceVertices`; empty where there are none. */
  texcoords: Float64Array;
}

/** A document in WASM memory: read from bytes, or made from a mesh; written with new positions. */
export class ShapeDocument {
  readonly #raw: RawDocument;
  readonly #scratch: RawScratch;

  private constructor(module: RawIoModule) {
    this.#raw = new module.Document();
    this.#scratch = new module.Scratch();
  }

  /** Errors: parse-error, too-large. */
  static async read(format: string, bytes: Uint8Array): Promise<ShapeDocument> {
    const document = new ShapeDocument(await start());
    put(document.#scratch.bytes(bytes.length), bytes);
    accept(document.#raw.read(format, document.#scratch));
    document.#scratch.bytes(0);
    return document;
  }

  /** Errors: invalid-shape, too-large. */
  static async from(mesh: Mesh): Promise<ShapeDocument> {
    const document = new ShapeDocument(await start());
    const scratch = document.#scratch;
    put(scratch.doubles(mesh.positions.length), mesh.positions);
    const polygons = packPolygons(mesh);
    put(scratch.integers(polygons.length), polygons);
    accept(document.#raw.assign(scratch));
    if (mesh.texcoords.length === 0) return document;
    put(scratch.doubles(mesh.texcoords.length), mesh.texcoords);
    accept(document.#raw.assignTexcoords(scratch));
    return document;
  }

  get mesh(): Mesh {
    const raw = this.#raw;
    return {
      positions: raw.positions().slice(),
      triangles: raw.triangles().slice(),
      faceVertices: raw.faceVertices().slice(),
      faceOffsets: raw.faceOffsets().slice(),
      texcoords: raw.cornerTexcoords().slice(),
    };
  }

  /** Errors: invalid-shape. */
  write(format: string, positions: Float64Array): Uint8Array {
    put(this.#scratch.doubles(positions.length), positions);
    const { status, bytes } = this.#raw.write(format, this.#scratch);
    accept(status);
    return bytes.slice();
  }
}

function packPolygons({ faceVertices, faceOffsets }: Mesh): Int32Array {
  const packed = new Int32Array(faceVertices.length + faceOffsets.length - 1);
  let at = 0;
  for (let face = 0; face + 1 < faceOffsets.length; ++face) {
    const corners = faceVertices.subarray(faceOffsets[face], faceOffsets[face + 1]);
    packed[at++] = corners.length;
    packed.set(corners, at);
    at += corners.length;
  }
  return packed;
}

/** A file passed through in pieces with its coordinates changed. */
export class ShapeRewriter {
  readonly #raw: RawRewriter;
  readonly #scratch: RawScratch;

  private constructor(module: RawIoModule) {
    this.#raw = new module.Rewriter();
    this.#scratch = new module.Scratch();
  }

  static async open(format: string): Promise<ShapeRewriter> {
    const rewriter = new ShapeRewriter(await start());
    accept(rewriter.#raw.open(format));
    return rewriter;
  }

  /** The next piece of the file, none at the end; `change` gets the coordinates in it, three a point. Errors: parse-error, invalid-shape. */
  push(piece: Uint8Array, last: boolean, change: (points: Float64Array) => void): Uint8Array {
    put(this.#scratch.bytes(piece.length), piece);
    const { status, points } = this.#raw.push(this.#scratch, last);
    accept(status);
    const moved = points.slice();
    if (moved.length > 0) change(moved);
    put(this.#scratch.doubles(moved.length), moved);
    const written = this.#raw.emit(this.#scratch);
    accept(written.status);
    return written.bytes.slice();
  }
}
