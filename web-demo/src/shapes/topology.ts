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
  const seen = new Map<string, number>();
  for (let v = 0; v < pointOf.length; v++) {
    const key = `${positions[3 * v]! + 0},${positions[3 * v + 1]! + 0},${positions[3 * v + 2]! + 0}`;
    const point = seen.get(key) ?? seen.size;
    seen.set(key, point);
    pointOf[v] = point;
  }
  return { pointOf, points: seen.size };
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
  const beside = group(points, 2 * corners, (i) => corner(i % corners), (i) => around(i % corners, i < corners ? 1 : 2));
  return {
    pointOf, points, vertexStart: own.start, vertices: own.values,
    nextStart: beside.start, next: beside.values, scattered: corners < points,
  };
}

/** The distinct edges as pairs of vertices (one of each point), flat. */
export function distinctEdges(shape: ShapeData, topology: Topology): Uint32Array {
  const keys = new Float64Array(shape.triangles.length);
  for (let i = 0; i < keys.length; i++) {
    const a = topology.pointOf[shape.triangles[i]!]!;
    const b = topology.pointOf[shape.triangles[i % 3 === 2 ? i - 2 : i + 1]!]!;
    keys[i] = Math.min(a, b) * topology.points + Math.max(a, b);
  }
  keys.sort();
  const edges: number[] = [];
  for (let i = 0; i < keys.length; i++) {
    if (i > 0 && keys[i] === keys[i - 1]) continue;
    const a = Math.floor(keys[i]! / topology.points);
    const b = keys[i]! % topology.points;
    if (a !== b) edges.push(topology.vertices[topology.vertexStart[a]!]!, topology.vertices[topology.vertexStart[b]!]!);
  }
  return Uint32Array.from(edges);
}

/**
 * The vertices of a patch: within `radius` of `center` in the given positions and, on a joined
 * surface, reachable from `seed` without leaving that ball. Ascending; always holds the seed.
 */
export function patchAround(
  topology: Topology, positions: Float32Array, seed: number, center: ArrayLike<number>, radius: number,
): Uint32Array {
  const inside = (v: number) =>
    Math.hypot(positions[3 * v]! - center[0]!, positions[3 * v + 1]! - center[1]!, positions[3 * v + 2]! - center[2]!) <= radius;
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
  for (const p of points) list.push(...topology.vertices.subarray(topology.vertexStart[p]!, topology.vertexStart[p + 1]!));
  return Uint32Array.from(list).sort();
}
