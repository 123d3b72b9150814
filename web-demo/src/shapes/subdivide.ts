// One round of Loop subdivision of a closed mesh, colours included: each triangle becomes four.
import type { PlainMesh } from "./decode.ts";

/** Midpoint of each edge: its two ends and the two corners across it (Loop's 3/8, 1/8 mask). */
interface Edge {
  ends: [number, number];
  across: number[];
  id: number;
}

function edgesOf(triangles: Uint32Array, points: number): Map<number, Edge> {
  const edges = new Map<number, Edge>();
  for (let t = 0; t < triangles.length; t += 3) {
    for (let i = 0; i < 3; i++) {
      const a = triangles[t + i]!;
      const b = triangles[t + ((i + 1) % 3)]!;
      const key = Math.min(a, b) * points + Math.max(a, b);
      const edge = edges.get(key) ?? { ends: [a, b], across: [], id: points + edges.size };
      edge.across.push(triangles[t + ((i + 2) % 3)]!);
      edges.set(key, edge);
    }
  }
  return edges;
}

/** The masks applied to one kind of value, 3 a point. */
function refine(
  values: ArrayLike<number>, points: number, edges: Map<number, Edge>, out: Float32Array | Uint8Array,
): void {
  const ring = new Float64Array(3 * points);
  const valence = new Uint32Array(points);
  for (const { ends: [a, b], across, id } of edges.values()) {
    valence[a]!++;
    valence[b]!++;
    for (let k = 0; k < 3; k++) {
      ring[3 * a + k]! += values[3 * b + k]!;
      ring[3 * b + k]! += values[3 * a + k]!;
      const sides = across.reduce((sum, c) => sum + values[3 * c + k]!, 0) / across.length;
      out[3 * id + k] = 0.375 * (values[3 * a + k]! + values[3 * b + k]!) + 0.25 * sides;
    }
  }
  for (let v = 0; v < points; v++) {
    const n = valence[v]!;
    const beta = (0.625 - (0.375 + 0.25 * Math.cos((2 * Math.PI) / n)) ** 2) / n;
    for (let k = 0; k < 3; k++) out[3 * v + k] = (1 - n * beta) * values[3 * v + k]! + beta * ring[3 * v + k]!;
  }
}

export function subdivide(mesh: PlainMesh): PlainMesh {
  const points = mesh.positions.length / 3;
  const edges = edgesOf(mesh.triangles, points);
  const total = points + edges.size;
  const triangles = new Uint32Array(4 * mesh.triangles.length);
  const middle = (a: number, b: number) => edges.get(Math.min(a, b) * points + Math.max(a, b))!.id;
  for (let t = 0; t < mesh.triangles.length; t += 3) {
    const [a, b, c] = [mesh.triangles[t]!, mesh.triangles[t + 1]!, mesh.triangles[t + 2]!];
    const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
    triangles.set([a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca], 4 * t);
  }
  const positions = new Float32Array(3 * total);
  refine(mesh.positions, points, edges, positions);
  if (!mesh.colors) return { positions, triangles };
  const colors = new Uint8Array(3 * total);
  refine(mesh.colors, points, edges, colors);
  return { positions, triangles, colors };
}
