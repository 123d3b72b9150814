// Small loose parts, like the eyes on a head: methods that follow the surface leave them behind, so
// they ride on what lies beside them, each by the rigid motion of its surroundings.
import { Quaternion, Vector3 } from "three";
import { bestMotion, centroid, quaternionOf } from "../edit/motion.ts";
import { boundingBox, type ShapeData } from "./shape.ts";
import type { Topology } from "./topology.ts";

export interface Rider {
  readonly vertices: Uint32Array;
  /** Vertices of the large parts: the nearest to it at rest, and two rings around them. */
  readonly anchors: Uint32Array;
}

type Floats = Float32Array | Float64Array;

/** Largest share of the diagonal of a part that rides. */
const largest = 0.3;
/** With more loose parts than this none rides. */
export const mostRiders = 64;
/** Vertices of a rider whose nearest neighbours are its anchors. */
const feelers = 48;

/** The joined parts: lists of vertices, most first. */
function partsOf({ pointOf, points, nextStart, next }: Topology): Uint32Array[] {
  const part = new Int32Array(points).fill(-1);
  let count = 0;
  for (let seed = 0; seed < points; seed++) {
    if (part[seed] !== -1) continue;
    const open = [seed];
    part[seed] = count;
    for (let p = open.pop(); p !== undefined; p = open.pop()) {
      for (let i = nextStart[p]!; i < nextStart[p + 1]!; i++) {
        if (part[next[i]!] !== -1) continue;
        part[next[i]!] = count;
        open.push(next[i]!);
      }
    }
    count++;
  }
  const lists = Array.from({ length: count }, (): number[] => []);
  pointOf.forEach((p, v) => lists[part[p]!]!.push(v));
  return lists.map((list) => Uint32Array.from(list)).sort((a, b) => b.length - a.length);
}

export function ridersOf(shape: ShapeData, topology: Topology): Rider[] {
  if (shape.dimension === 2 || topology.scattered) return [];
  const { positions } = shape;
  const { diagonal } = boundingBox(positions);
  const parts = partsOf(topology);
  const size = (part: Uint32Array) =>
    boundingBox(
      Float32Array.from(part, (v) => positions[3 * v]!).reduce<number[]>(
        (all, x, i) => (all.push(x, positions[3 * part[i]! + 1]!, positions[3 * part[i]! + 2]!), all), [],
      ),
    ).diagonal;
  const small = parts.filter(
    (part, i) => i > 0 && part.length < parts[0]!.length / 5 && size(part) < largest * diagonal,
  );
  if (small.length === 0 || small.length > mostRiders) return [];
  const body = parts.filter((part) => !small.includes(part)).flatMap((part) => [...part]);
  const nearest = (v: number) => {
    let [best, least] = [0, Infinity];
    for (const b of body) {
      const d =
        (positions[3 * b]! - positions[3 * v]!) ** 2 +
        (positions[3 * b + 1]! - positions[3 * v + 1]!) ** 2 +
        (positions[3 * b + 2]! - positions[3 * v + 2]!) ** 2;
      if (d < least) [best, least] = [b, d];
    }
    return best;
  };
  return small.map((vertices) => {
    const every = Math.ceil(vertices.length / feelers);
    const anchors = new Set(vertices.filter((_, i) => i % every === 0).map(nearest));
    for (let ring = 0; ring < 2; ring++) {
      for (const v of [...anchors]) for (const w of beside(topology, v)) anchors.add(w);
    }
    return { vertices, anchors: Uint32Array.from(anchors).sort() };
  });
}

/** One vertex for each point that an edge joins to that of `v`. */
function* beside({ pointOf, nextStart, next, vertexStart, vertices }: Topology, v: number): Generator<number> {
  const p = pointOf[v]!;
  for (let i = nextStart[p]!; i < nextStart[p + 1]!; i++) yield vertices[vertexStart[next[i]!]!]!;
}

/** Moves riders, in place, to where their surroundings have gone; which of them moved. */
export function carry(riders: readonly Rider[], rest: Floats, positions: Floats, normals?: Float32Array): Rider[] {
  return riders.filter(({ vertices, anchors }) => {
    if (anchors.every((v) => [0, 1, 2].every((k) => positions[3 * v + k] === rest[3 * v + k]))) {
      for (const v of vertices) positions.set(rest.subarray(3 * v, 3 * v + 3), 3 * v);
      return false;
    }
    const { translate, rotation } = bestMotion(rest, positions, anchors);
    place(
      vertices, new Vector3(...centroid(rest, anchors)), new Vector3(...translate), quaternionOf(rotation), rest,
      positions, normals,
    );
    return true;
  });
}

function place(
  vertices: Uint32Array, center: Vector3, shift: Vector3, turn: Quaternion, rest: Floats, positions: Floats,
  normals?: Float32Array,
): void {
  const p = new Vector3();
  for (const v of vertices) {
    p.fromArray(rest, 3 * v).sub(center).applyQuaternion(turn).add(center).add(shift).toArray(positions, 3 * v);
    if (normals) p.fromArray(normals, 3 * v).applyQuaternion(turn).toArray(normals, 3 * v);
  }
}
