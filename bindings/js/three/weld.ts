// Vertices that are meant to be one but differ by rounding: a seam at 0 and 360 degrees.

import { mixed } from "../shape/groups.js";

/** The positions, three numbers a vertex, with every vertex at the place of the first one closer than `tolerance`. */
export function snapped(positions: Float32Array, tolerance: number): Float32Array {
  const result = positions.slice();
  if (tolerance > 0) {
    const grid = new Grid(result, tolerance);
    for (let at = 0; at < result.length; at += 3) grid.snap(at);
  }
  return result;
}

/**
 * Buckets of the vertices that others snap to, by cells four tolerances wide: what is near lies in one to eight of
 * them.
 */
class Grid {
  readonly #p: Float32Array;
  readonly #tolerance: number;
  readonly #mask: number;
  /** The last vertex of a bucket, and of each vertex the one before it; -1: none. */
  readonly #last: Int32Array;
  readonly #before: Int32Array;

  constructor(positions: Float32Array, tolerance: number) {
    const vertices = positions.length / 3;
    this.#p = positions;
    this.#tolerance = tolerance;
    this.#mask = (2 << Math.ceil(Math.log2(Math.max(2, vertices)))) - 1;
    this.#last = new Int32Array(this.#mask + 1).fill(-1);
    this.#before = new Int32Array(vertices).fill(-1);
  }

  /** Moves a vertex to the first one near it, or lets later ones come to it. */
  snap(at: number): void {
    const p = this.#p;
    const first = this.#firstNear(at);
    if (first >= 0) {
      for (let axis = 0; axis < 3; ++axis) p[at + axis] = p[3 * first + axis];
      return;
    }
    const home = this.#bucket(this.#cell(p[at]), this.#cell(p[at + 1]), this.#cell(p[at + 2]));
    this.#before[at / 3] = this.#last[home];
    this.#last[home] = at / 3;
  }

  #cell(x: number): number {
    return Math.floor(x / (4 * this.#tolerance));
  }

  #bucket(x: number, y: number, z: number): number {
    const hash = mixed(mixed(mixed(0, x), y), z);
    return (hash ^ (hash >>> 15)) & this.#mask;
  }

  #firstNear(at: number): number {
    const [p, r] = [this.#p, this.#tolerance];
    const [x1, y1, z1] = [this.#cell(p[at] + r), this.#cell(p[at + 1] + r), this.#cell(p[at + 2] + r)];
    let first = -1;
    for (let x = this.#cell(p[at] - r); x <= x1; ++x) {
      for (let y = this.#cell(p[at + 1] - r); y <= y1; ++y) {
        for (let z = this.#cell(p[at + 2] - r); z <= z1; ++z) {
          const near = this.#firstIn(this.#bucket(x, y, z), at);
          if (near >= 0 && (first < 0 || near < first)) first = near;
        }
      }
    }
    return first;
  }

  #firstIn(bucket: number, at: number): number {
    const p = this.#p;
    let first = -1;
    for (let other = this.#last[bucket]; other >= 0; other = this.#before[other]) {
      const [x, y, z] = [p[at] - p[3 * other], p[at + 1] - p[3 * other + 1], p[at + 2] - p[3 * other + 2]];
      if (x * x + y * y + z * z < this.#tolerance * this.#tolerance) first = other;
    }
    return first;
  }
}
