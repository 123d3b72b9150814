// What is read from a shape file, as plain data: it travels to workers and back as it is.

import type { FloatArray } from "../boundary/check.js";
import type { PictureInput } from "../picture/image.js";
import type { FileFormat } from "./format.js";

/** Faces of a shape and what lies on them, as files know it. Where a file has none of something, its array is empty. */
export interface Mesh {
  /** Three numbers a vertex, in the file's order; of a picture, which lies in the plane, two. */
  positions: Float64Array;
  /** The polygons cut into triangles, three vertex ids each, a polygon of k corners into k - 2. */
  triangles: Uint32Array;
  /** Polygons: vertex ids, and where each begins (one more than there are faces). */
  faceVertices: Uint32Array;
  faceOffsets: Uint32Array;
  /** Two a corner, in the order of `faceVertices`; v points up. */
  texcoords: Float64Array;
  /** Three bytes a vertex: red, green, blue in sRGB. */
  colors: Uint8Array;
}

/** A shape file that was read. `write` gives it back with its vertices elsewhere. */
export interface ShapeFile extends Mesh {
  format: FileFormat;
  dimension: 2 | 3;
  /** The picture on the whole shape, as a .png or .jpg, where a .glb has one; a .png itself, without its background. */
  texture?: Blob;
  /** The file as it was: in its own format all but the coordinates is written as it stood. */
  source: Blob;
}

/** A shape to be written: a file that was read, or what a file is made of. */
export interface WritableShape extends Partial<Omit<ShapeFile, "positions" | "dimension">> {
  /** `dimension` numbers a vertex; of a file that was read, as many as it has. */
  positions: FloatArray;
  /** 3, or 2 for the plane. */
  dimension?: 2 | 3;
  /** A picture: how far in front each vertex lies, where it overlaps itself. */
  depths?: FloatArray;
  /** A picture as .png or .svg: what is to be seen; "fit": all of it. Left out: the frame of the picture before. */
  frame?: Frame | "fit";
}

/** Pixels, and where the bottom left corner is. */
export interface Frame {
  width: number;
  height: number;
  origin: readonly [x: number, y: number];
}

/** How a picture becomes a shape. */
export type PictureOptions = Omit<PictureInput, "width" | "height" | "data">;

/** How far reading is, from 0 to 1. */
export interface ReadProgress {
  fraction: number;
}

export interface ReadOptions {
  /** Stops the reading. */
  signal?: AbortSignal;
  onProgress?: (progress: ReadProgress) => void;
  /** Of a .png: what is background, how finely it is triangulated. */
  picture?: PictureOptions;
}

export interface RewriteOptions {
  /** Stops the rewriting. */
  signal?: AbortSignal;
}
