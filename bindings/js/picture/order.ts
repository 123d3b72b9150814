// Which part of a picture lies over which, where it overlaps itself.

import { EdgePaths } from "./paths.js";

/**
 * Triangles so that each lies over those before it: from the middle of each part, the vertex deepest inside, outwards,
 * so
 * that limbs lie over the body; smaller parts over larger ones.
 */
export function outwardOrder(positions: ArrayLike<number>, triangles: Uint32Array): Uint32Array {
  const paths = new EdgePaths(positions, 2, triangles);
  const depth = paths.from(paths.boundary());
  const parts = paths.parts();
  const middles = new Map<number, number>();
  const sizes = new Map<number, number>();
  for (let v = 0; v < depth.length; ++v) {
    const middle = middles.get(parts[v]);
    if (middle === undefined || depth[v] > depth[middle]) middles.set(parts[v], v);
    sizes.set(parts[v], (sizes.get(parts[v]) ?? 0) + 1);
  }
  const out = paths.from([...middles.values()]);
  const far = (t: number) => out[triangles[3 * t]] + out[triangles[3 * t + 1]] + out[triangles[3 * t + 2]];
  const size = (t: number) => sizes.get(parts[triangles[3 * t]])!;
  const part = (t: number) => parts[triangles[3 * t]];
  const order = [...Array(triangles.length / 3).keys()];
  return permuted(
    triangles,
    order.sort((a, b) => size(b) - size(a) || part(a) - part(b) || far(a) - far(b)),
  );
}

/**
 * Triangles from back to front by the depths of their vertices, larger ones in front; those of one depth in the order
 * they
 * are in.
 */
export function backToFront(triangles: Uint32Array, depths: ArrayLike<number>): Uint32Array {
  return permuted(triangles, depthOrder(triangles, depths));
}

/** Which triangle comes first, and which next. */
export function depthOrder(triangles: Uint32Array, depths: ArrayLike<number>): number[] {
  const key = Float64Array.from(
    { length: triangles.length / 3 },
    (_, t) => depths[triangles[3 * t]] + depths[triangles[3 * t + 1]] + depths[triangles[3 * t + 2]],
  );
  return [...key.keys()].sort((a, b) => key[a] - key[b]);
}

function permuted(triangles: Uint32Array, order: readonly number[]): Uint32Array {
  const sorted = new Uint32Array(triangles.length);
  order.forEach((t, i) => sorted.set(triangles.subarray(3 * t, 3 * t + 3), 3 * i));
  return sorted;
}

/** What holds a shape, or moves it, and how far in front that is: 0 where it is left out. */
export interface Pin {
  vertices: Iterable<number>;
  depth?: number;
}

/**
 * A depth for each vertex of a mesh at rest: that of the pins, the more the closer they are, by the inverse square of
 * the
 * distance along edges. Parts without a pin have depth 0. `dimension` numbers a vertex.
 */
export function spreadDepths(
  positions: ArrayLike<number>,
  dimension: 2 | 3,
  triangles: ArrayLike<number>,
  pins: readonly Pin[],
): Float64Array {
  const paths = new EdgePaths(positions, dimension, triangles);
  const [sums, weights] = [new Float64Array(paths.count), new Float64Array(paths.count)];
  const held = new Map<number, number>();
  for (const { vertices, depth = 0 } of pins) {
    const ids = [...vertices];
    ids.forEach((v) => held.set(v, depth));
    const distances = paths.from(ids);
    for (let v = 0; v < paths.count; ++v) {
      if (distances[v] === Infinity || distances[v] === 0) continue;
      sums[v] += depth / distances[v] ** 2;
      weights[v] += 1 / distances[v] ** 2;
    }
  }
  return sums.map((sum, v) => held.get(v) ?? (weights[v] > 0 ? sum / weights[v] : 0));
}
