// The shape of a geometry.

import type { BufferGeometry } from "three";
import { Place } from "../boundary/check.js";
import type { ShapeInput } from "../shape/shape.js";
import { type Attribute, readAttribute } from "./attributes.js";
import { snapped } from "./weld.js";

/** Vertices closer than this part of the size are one: generated geometries close their seams only so well. */
const seam = 1e-6;

/**
 * The shape of a geometry, indexed or not, for `pliant.shape`. `points`: leave out the triangles. Errors:
 * invalid-shape.
 */
export function shapeOf(geometry: BufferGeometry, { points = false } = {}): ShapeInput & { positions: Float32Array } {
  const positions = restOf(geometry);
  return points ? { positions } : { positions, triangles: trianglesOf(geometry, positions.length / 3) };
}

/** Three numbers a vertex; vertices of a seam at one place. Errors: invalid-shape. */
export function restOf(geometry: BufferGeometry): Float32Array {
  const place = new Place("invalid-shape", "geometry");
  if (!geometry?.isBufferGeometry) place.fail(geometry, "a BufferGeometry");
  const position = geometry.getAttribute("position") as Attribute | undefined;
  if (position?.itemSize !== 3) place.reject("has no position attribute of three numbers a vertex; expected one");
  const positions = readAttribute(position!);
  return snapped(positions, seam * diagonalOf(positions));
}

function diagonalOf(positions: Float32Array): number {
  const [least, most] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let i = 0; i < positions.length; ++i) {
    const axis = i % 3;
    if (positions[i] < least[axis]) least[axis] = positions[i];
    if (positions[i] > most[axis]) most[axis] = positions[i];
  }
  return Math.hypot(most[0] - least[0], most[1] - least[1], most[2] - least[2]);
}

/** Without an index, every three vertices are a triangle. */
export function trianglesOf(geometry: BufferGeometry, vertices: number): Uint32Array {
  if (geometry.index) return Uint32Array.from(geometry.index.array);
  return new Uint32Array(vertices - (vertices % 3)).map((_, i) => i);
}
