// The energies of arap and edge-material, straight from their papers, over a saved state, the shape
// at rest and its triangles. Shares no code with Pliant.

import type { Mesh } from "./shapes.js";

type Vector = readonly number[];

interface SurfaceState {
  result: number[][];
  handles: { vertices: number[]; targets: number[][] }[];
}

export interface ArapState extends SurfaceState {
  edges: { i: number; j: number; weight: number }[];
  /** Row by row, one a vertex. */
  rotations: number[][];
}

export interface EdgeMaterialState extends SurfaceState {
  edges: {
    i: number;
    j: number;
    l: number;
    m: number;
    alpha: number;
    beta: number;
    rho: number;
    sigma: number;
    kappa: number;
  }[];
  weights: { lambda: number; mu: number; pStretch: number; pBend: number; gravity: number[] };
  /** Vertices that gravity does not act on. */
  floating: number[];
  /** Edges whose triangles cancel: their normals from before. */
  folded: { edge: number; normal: number[] }[];
}

const minus = (a: Vector, b: Vector) => a.map((x, i) => x - b[i]);
const dot = (a: Vector, b: Vector) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a: Vector, b: Vector) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];
const apply = (r: Vector, v: Vector) => [0, 3, 6].map((row) => r[row] * v[0] + r[row + 1] * v[1] + r[row + 2] * v[2]);
const squared = (v: Vector) => dot(v, v);

export const restOf = ({ positions }: Mesh): number[][] =>
  Array.from({ length: positions.length / 3 }, (_, v) => Array.from(positions.subarray(3 * v, 3 * v + 3)));

/** a, b, and the vertex across, for each edge of each triangle, in its order. */
function* sides({ triangles }: Mesh): Generator<[a: number, b: number, across: number]> {
  for (let t = 0; t < triangles.length / 3; ++t) {
    for (let c = 0; c < 3; ++c) {
      yield [triangles[3 * t + c], triangles[3 * t + ((c + 1) % 3)], triangles[3 * t + ((c + 2) % 3)]];
    }
  }
}

const key = (a: number, b: number) => `${Math.min(a, b)} ${Math.max(a, b)}`;

/** (cot a + cot b) / 2 of every edge. */
export function cotangentWeights(mesh: Mesh): Map<string, number> {
  const rest = restOf(mesh);
  const weights = new Map<string, number>();
  for (const [a, b, c] of sides(mesh)) {
    weights.set(key(a, b), (weights.get(key(a, b)) ?? 0) + cotangent(rest, a, b, c) / 2);
  }
  return weights;
}

function cotangent(rest: Vector[], a: number, b: number, c: number): number {
  const [u, v] = [minus(rest[a], rest[c]), minus(rest[b], rest[c])];
  return dot(u, v) / Math.sqrt(squared(cross(u, v)));
}

type Cell = [point: number, a: number, b: number, weight: number];

/** Which rotation has to turn which edge, and how much that counts. */
function cells(mesh: Mesh, rims: boolean): Cell[] {
  if (rims) {
    const rest = restOf(mesh);
    return Array.from(sides(mesh)).flatMap(([a, b, c]) =>
      [a, b, c].map((point): Cell => [point, a, b, cotangent(rest, a, b, c) / 2]),
    );
  }
  return Array.from(cotangentWeights(mesh)).flatMap(([edge, weight]) => {
    const [a, b] = edge.split(" ").map(Number);
    return [a, b].map((point): Cell => [point, a, b, Math.max(0, weight)]);
  });
}

/**
 * Sorkine & Alexa, eq. 7, or with rims that of Chao et al.; half its gradient at each vertex; and how far each rotation
 * is from the best.
 */
export function evaluateArap(
  state: ArapState, mesh: Mesh, rims: boolean,
): { energy: number; gradient: number[][]; turning: number } {
  const rest = restOf(mesh);
  const gradient = rest.map(() => [0, 0, 0]);
  const torques = rest.map(() => [0, 0, 0]);
  let energy = 0;
  for (const [point, a, b, weight] of cells(mesh, rims)) {
    const turned = apply(state.rotations[point], minus(rest[a], rest[b]));
    const now = minus(state.result[a], state.result[b]);
    const apart = minus(now, turned);
    energy += weight * squared(apart);
    // A rotation is best where turning it a little does not help.
    cross(turned, now).forEach((x, i) => (torques[point][i] += weight * x));
    apart.forEach((x, i) => {
      gradient[a][i] += weight * x;
      gradient[b][i] -= weight * x;
    });
  }
  return { energy, gradient, turning: Math.max(...torques.flat().map(Math.abs)) };
}

/** The normal of eq. 4 at every edge of two triangles: the direction of the sum of their areas. */
function edgeNormals(mesh: Mesh, points: Vector[]): Map<string, number[]> {
  const normals = new Map<string, number[]>();
  for (const [a, b, c] of sides(mesh)) {
    const area = cross(minus(points[b], points[a]), minus(points[c], points[a]));
    const before = normals.get(key(a, b)) ?? [0, 0, 0];
    normals.set(key(a, b), area.map((x, i) => x + before[i]));
  }
  for (const [edge, sum] of normals) normals.set(edge, sum.map((x) => x / Math.sqrt(squared(sum))));
  return normals;
}

type Hinge = EdgeMaterialState["edges"][number];

const across = ({ i, j, l, m, alpha, beta }: Hinge, points: Vector[]) =>
  points[i].map((x, k) => alpha * x + (1 - alpha) * points[j][k] - beta * points[l][k] - (1 - beta) * points[m][k]);

/** Eq. 5-9, each term without its weight, and their weighted sum. */
export function evaluateEdgeMaterial({ edges, weights, floating, folded, result }: EdgeMaterialState, mesh: Mesh) {
  const rest = restOf(mesh);
  const normals = edgeNormals(mesh, result);
  for (const { edge, normal } of folded) normals.set(key(edges[edge].i, edges[edge].j), normal);
  let [stretch, bend] = [0, 0];
  for (const edge of edges) {
    const { i, j, l, rho, sigma, kappa } = edge;
    stretch += kappa * (Math.sqrt(squared(minus(result[i], result[j]))) - rho) ** 2;
    if (l < 0) continue;
    bend += kappa * squared(minus(across(edge, result), normals.get(key(i, j))!.map((n) => sigma * n)));
  }
  const free = new Set(floating);
  const gravity = -rest.reduce((sum, p, v) => sum + (free.has(v) ? 0 : dot(weights.gravity, minus(result[v], p))), 0);
  const { lambda, mu, pStretch, pBend } = weights;
  return { stretch, bend, gravity, constraint: 0, total: lambda * pStretch * stretch + mu * pBend * bend + gravity };
}

/** How far rho and sigma of a state are from eq. 5 at rest, where sigma lies along the normal. */
export function restErrors({ edges }: EdgeMaterialState, mesh: Mesh): { rho: number; sigma: number } {
  const rest = restOf(mesh);
  const normals = edgeNormals(mesh, rest);
  const hinges = edges.filter(({ l }) => l >= 0);
  return {
    rho: Math.max(...edges.map(({ i, j, rho }) => Math.abs(Math.sqrt(squared(minus(rest[i], rest[j]))) - rho))),
    sigma: Math.max(
      ...hinges.map((edge) =>
        Math.sqrt(squared(minus(across(edge, rest), normals.get(key(edge.i, edge.j))!.map((n) => edge.sigma * n)))),
      ),
    ),
  };
}

/** Mean edge length over the diagonal of the box around. */
export function meanEdge(mesh: Mesh): number {
  const rest = restOf(mesh);
  const lengths = Array.from(cotangentWeights(mesh).keys(), (edge) => {
    const [a, b] = edge.split(" ").map(Number);
    return Math.sqrt(squared(minus(rest[a], rest[b])));
  });
  const size = [0, 1, 2].map((axis) => Math.max(...rest.map((p) => p[axis])) - Math.min(...rest.map((p) => p[axis])));
  return lengths.reduce((sum, length) => sum + length, 0) / lengths.length / Math.sqrt(squared(size));
}
