// Sumner, Schmid, Pauly 2007, straight from the paper's equations, over a saved state. Shares no code
// with Pliant.

export interface GraphState {
  nodes: number[][];
  /** Row by row. */
  rotations: number[][];
  translations: number[][];
  edges: number[][];
  frozen: number[];
  influences: { k: number; indices: number[]; weights: number[] };
  handles: { vertices: number[]; targets: number[][] }[];
  lengthUnit: number;
}

export interface Terms {
  rotation: number;
  regularization: number;
  constraint: number;
}

type Vector = readonly number[];

const minus = (a: Vector, b: Vector) => a.map((x, i) => x - b[i]);
const plus = (a: Vector, b: Vector) => a.map((x, i) => x + b[i]);
const times = (a: Vector, s: number) => a.map((x) => x * s);
const dot = (a: Vector, b: Vector) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const apply = (r: Vector, v: Vector) => [0, 3, 6].map((row) => r[row] * v[0] + r[row + 1] * v[1] + r[row + 2] * v[2]);
const column = (r: Vector, c: number) => [r[c], r[c + 3], r[c + 6]];
const vertexOf = (positions: ArrayLike<number>, v: number) => [
  positions[3 * v], positions[3 * v + 1], positions[3 * v + 2],
];

/** Eq. 4: the weight of every node on a vertex, by node; nodes without influence are left out. */
export function weights(state: GraphState, vertex: Vector): Map<number, number> {
  const order = state.nodes
    .map((g, j) => ({ j, distance: Math.hypot(...minus(vertex, g)) }))
    .sort((a, b) => a.distance - b.distance);
  const { k } = state.influences;
  const farthest = order[k].distance;
  const raw = order.slice(0, k).map(({ j, distance }) => [j, (1 - distance / farthest) ** 2] as const);
  const sum = raw.reduce((total, [, w]) => total + w, 0);
  return new Map(raw.map(([j, w]) => [j, w / sum] as const).filter(([, w]) => w > 0));
}

/** The weights a state holds for a vertex. */
export function savedWeights({ influences: { k, indices, weights } }: GraphState, vertex: number): Map<number, number> {
  const row = Array.from({ length: k }, (_, s) => [indices[vertex * k + s], weights[vertex * k + s]] as const);
  return new Map(row.filter(([, w]) => w > 0));
}

/** Eq. 2: where a vertex goes. */
export function carried(state: GraphState, vertex: Vector, influence: Map<number, number>): number[] {
  let sum: number[] = [0, 0, 0];
  for (const [j, w] of influence) {
    const g = state.nodes[j];
    const moved = plus(plus(apply(state.rotations[j], minus(vertex, g)), g), state.translations[j]);
    sum = plus(sum, times(moved, w));
  }
  return sum;
}

/** Nodes that influence a common vertex (section 3), as "j k" with j < k. */
export function edges(state: GraphState, rest: ArrayLike<number>): Set<string> {
  const found = new Set<string>();
  for (let v = 0; v < rest.length / 3; ++v) {
    const nodes = [...weights(state, vertexOf(rest, v)).keys()].sort((a, b) => a - b);
    nodes.forEach((j, i) => nodes.slice(i + 1).forEach((k) => found.add(`${j} ${k}`)));
  }
  return found;
}

/** Gradient with respect to the nine entries of R_j and to t_j. */
interface NodeGradient {
  rotation: number[];
  translation: number[];
}

/** Eq. 5 to 8 in the state's length unit, and the gradient of their weighted sum. */
export function evaluate(
  state: GraphState, rest: ArrayLike<number>, w: Terms,
): { terms: Terms; gradient: NodeGradient[] } {
  const unit = 1 / state.lengthUnit;
  const g = state.nodes.map((node) => times(node, unit));
  const t = state.translations.map((translation) => times(translation, unit));
  const r = state.rotations;
  const terms = { rotation: 0, regularization: 0, constraint: 0 };
  const gradient = g.map(() => ({ rotation: Array<number>(9).fill(0), translation: [0, 0, 0] }));
  const outer = (j: number, a: Vector, b: Vector, s: number) => {
    for (let row = 0; row < 3; ++row) {
      for (let c = 0; c < 3; ++c) gradient[j].rotation[3 * row + c] += s * a[row] * b[c];
    }
  };
  const shift = (j: number, a: Vector, s: number) =>
    (gradient[j].translation = plus(gradient[j].translation, times(a, s)));

  for (const j of g.keys()) {
    for (let a = 0; a < 3; ++a) {
      for (let b = a; b < 3; ++b) {
        const [ca, cb] = [column(r[j], a), column(r[j], b)];
        const residual = dot(ca, cb) - (a === b ? 1 : 0);
        terms.rotation += residual ** 2;
        for (let row = 0; row < 3; ++row) {
          gradient[j].rotation[3 * row + a] += w.rotation * 2 * residual * cb[row];
          gradient[j].rotation[3 * row + b] += w.rotation * 2 * residual * ca[row];
        }
      }
    }
  }
  for (const [one, other] of state.edges) {
    for (const [j, k] of [[one, other], [other, one]]) {
      const d = minus(g[k], g[j]);
      const residual = minus(plus(plus(apply(r[j], d), g[j]), t[j]), plus(g[k], t[k]));
      terms.regularization += dot(residual, residual);
      outer(j, residual, d, 2 * w.regularization);
      shift(j, residual, 2 * w.regularization);
      shift(k, residual, -2 * w.regularization);
    }
  }
  for (const { vertices, targets } of state.handles) {
    vertices.forEach((vertex, i) => {
      const v = vertexOf(rest, vertex);
      const influence = savedWeights(state, vertex);
      const residual = times(minus(carried(state, v, influence), targets[i]), unit);
      terms.constraint += dot(residual, residual);
      for (const [j, weight] of influence) {
        outer(j, residual, times(minus(v, state.nodes[j]), unit), 2 * w.constraint * weight);
        shift(j, residual, 2 * w.constraint * weight);
      }
    });
  }
  return { terms, gradient };
}

export function determinant(r: Vector): number {
  const [a, b, c] = [column(r, 0), column(r, 1), column(r, 2)];
  return dot(a, [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]]);
}
