// Which vertices lie next to each other: vertices at one position are one point, triangles join points.
import type { ShapeData } from "./shape.ts";

export interface Topology {
  /** Vertex -> point. */
  pointOf: Uint32Array;
  points: number;
  /** Vertices of a point: `vertices.subarray(vertexStart[p], vertexStart[p + 1])`. */
  vertexStart: Uint32Array;
  vertices: Uint32Array;
  /** Points beside a point (repeats possible), laid out the same way. */
  nextStart: Uint32Array;
  next: Uint32Array;
  /** Too little is joined for "beside" to mean anything: points or a polygon soup. */
  scattered: boolean;
}

function weld(positions: Float32Array): { pointOf: Uint32Array; points: number } {
  const pointOf = new Uint32Array(positions.length / 3);
  let size = 4;
  while (size < 2 * pointOf.length) size *= 2;
  const table = new Int32Array(size).fill(-1); // vertices, by what their coordinates hash to
  let points = 0;
  for (let v = 0; v < pointOf.length; v++) {
    const [x, y, z] = [positions[3 * v]! + 0, positions[3 * v + 1]! + 0, positions[3 * v + 2]! + 0];
    let slot = hashOf(x, y, z) & (size - 1);
    for (
      let other = table[slot]!;
      other >= 0 && !(positions[3 * other] === x && positions[3 * other + 1] === y && positions[3 * other + 2] === z);
    ) {
      slot = (slot + 1) & (size - 1);
      other = table[slot]!;
    }
    if (table[slot]! < 0) {
      table[slot] = v;
      pointOf[v] = points++;
    } else {
      pointOf[v] = pointOf[table[slot]!]!;
    }
  }
  return { pointOf, points };
}

const bits = new Uint32Array(new Float32Array(3).buffer);
const floats = new Float32Array(bits.buffer);

function hashOf(x: number, y: number, z: number): number {
  floats[0] = x;
  floats[1] = y;
  floats[2] = z;
  let hash = Math.imul(bits[0]!, 0x9e3779b1) ^ Math.imul(bits[1]!, 0x85ebca6b) ^ Math.imul(bits[2]!, 0xc2b2ae35);
  hash ^= hash >>> 15;
  return Math.imul(hash, 0x2c1b3c6d) >>> 7;
}

/** Lists of values grouped by a key 0..count-1. */
function group(count: number, size: number, key: (i: number) => number, value: (i: number) => number) {
  const start = new Uint32Array(count + 1);
  for (let i = 0; i < size; i++) start[key(i) + 1]!++;
  for (let k = 0; k < count; k++) start[k + 1]! += start[k]!;
  const cursor = start.slice();
  const values = new Uint32Array(size);
  for (let i = 0; i < size; i++) values[cursor[key(i)]!++] = value(i);
  return { start, values };
}

export function topologyOf(shape: ShapeData): Topology {
  const { pointOf, points } = weld(shape.positions);
  const own = group(points, pointOf.length, (v) => pointOf[v]!, (v) => v);
  const corner = (i: number) => pointOf[shape.triangles[i]!]!;
  const around = (i: number, step: number) => corner(3 * Math.floor(i / 3) + ((i + step) % 3));
  const corners = shape.triangles.length;
  const beside = group(
    points, 2 * corners, (i) => corner(i % corners), (i) => around(i % corners, i < corners ? 1 : 2),
  );
  return {
    pointOf, points, vertexStart: own.start, vertices: own.values,
    nextStart: beside.start, next: beside.values, scattered: corners < points,
  };
}

/**
 * The vertices of a patch: within `radius` of `center` in the given positions and, on a joined
 * surface, reachable from `seed` without leaving that ball. Ascending; always holds the seed.
 */
export function patchAround(
  topology: Topology, positions: Float32Array, seed: number, center: ArrayLike<number>, radius: number,
): Uint32Array {
  const inside = (v: number) =>
    Math.hypot(
      positions[3 * v]! - center[0]!, positions[3 * v + 1]! - center[1]!, positions[3 * v + 2]! - center[2]!,
    ) <= radius;
  const chosen = new Set([topology.pointOf[seed]!]);
  if (topology.scattered) {
    for (let v = 0; v < topology.pointOf.length; v++) if (inside(v)) chosen.add(topology.pointOf[v]!);
  } else {
    for (const p of chosen) {
      for (let i = topology.nextStart[p]!; i < topology.nextStart[p + 1]!; i++) {
        const q = topology.next[i]!;
        if (!chosen.has(q) && inside(topology.vertices[topology.vertexStart[q]!]!)) chosen.add(q);
      }
    }
  }
  return verticesOf(topology, chosen);
}

/** All the vertices at the given points, ascending. */
function verticesOf(topology: Topology, points: Iterable<number>): Uint32Array {
  const list: number[] = [];
  for (const p of points) {
    list.push(...topology.vertices.subarray(topology.vertexStart[p]!, topology.vertexStart[p + 1]!));
  }
  return Uint32Array.from(list).sort();
}
