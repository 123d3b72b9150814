// Normals of a surface whose vertices are repeated along seams: vertices that share position and
// normal at rest keep sharing it, so that smooth stays smooth and hard edges stay hard.

import { toSpace } from "../boundary/check.js";
import { equalRows } from "./groups.js";

/** Which vertices share a normal, and the triangles around them. */
export class NormalGroups {
  readonly #group: Uint32Array;
  readonly #size: number;
  readonly #triangles: ArrayLike<number>;

  /** positions, normals: three numbers a vertex, at rest. triangles: three vertex ids each. */
  constructor(positions: ArrayLike<number>, normals: ArrayLike<number>, triangles: ArrayLike<number>) {
    const rows = new Float64Array(2 * positions.length);
    for (let at = 0; at < positions.length; at += 3) {
      for (let axis = 0; axis < 3; ++axis) {
        rows[2 * at + axis] = positions[at + axis] + 0; // -0 is 0
        // Normals of one smooth vertex may differ by rounding.
        rows[2 * at + 3 + axis] = Math.round(normals[at + axis] * 1000) + 0;
      }
    }
    const { group, count } = equalRows(rows, 6);
    this.#group = group;
    this.#size = count;
    this.#triangles = triangles;
  }

  /** Unit normals of the moved vertices, weighted by area; vertices without a triangle keep what `out` holds. */
  compute(positions: ArrayLike<number>, out: Float32Array): void {
    const sums = this.#sums(positions);
    for (let v = 0; v < this.#group.length; ++v) {
      const at = 3 * this.#group[v];
      const length = Math.hypot(sums[at], sums[at + 1], sums[at + 2]);
      if (length === 0) continue;
      for (let axis = 0; axis < 3; ++axis) out[3 * v + axis] = sums[at + axis] / length;
    }
  }

  /** Of each group, the cross products of the triangles around it. */
  #sums(p: ArrayLike<number>): Float64Array {
    const sums = new Float64Array(3 * this.#size);
    const t = this.#triangles;
    for (let i = 0; i < t.length; i += 3) {
      const [a, b, c] = [3 * t[i], 3 * t[i + 1], 3 * t[i + 2]];
      const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
      const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      for (let corner = 0; corner < 3; ++corner) {
        const at = 3 * this.#group[t[i + corner]];
        sums[at] += x;
        sums[at + 1] += y;
        sums[at + 2] += z;
      }
    }
    return sums;
  }
}

/**
 * Unit normals of a surface, three numbers a vertex: weighted by area, one for all vertices that share a place at rest;
 * zero where no triangle has an area. `dimension` numbers a position; the plane's normals point along z.
 */
export function surfaceNormals<T extends Float32Array | Float64Array>(
  positions: Float64Array, triangles: ArrayLike<number>, rest: Float64Array, dimension: number, out: T,
): T {
  const space = (points: Float64Array) => (dimension === 3 ? points : Float64Array.from(toSpace(points, 2)));
  const [now, before] = [space(positions), space(rest)];
  const groups = new NormalGroups(before, new Float64Array(before.length), triangles);
  const normals = new Float32Array(now.length);
  groups.compute(now, normals);
  out.set(normals);
  return out;
}
