// Isotropic remeshing of a closed triangle mesh over an implicit surface: split, collapse, flip,
// relax, project, as in Botsch & Kobbelt, "A remeshing approach to multiresolution modeling" (2004).
import { gradient, project } from "./sdf.mjs";

const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const distance = (a, b) => Math.hypot(...sub(a, b));
const middle = (a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2];

/** A triangle mesh that can change: points, triangles (null when gone), triangles around a point. */
class Surface {
  constructor(points, triangles) {
    this.points = points;
    this.triangles = triangles.map((t) => [...t]);
    this.around = points.map(() => new Set());
    this.triangles.forEach((t, id) => t.forEach((v) => this.around[v].add(id)));
  }
  neighbours(v) {
    const ring = new Set();
    for (const id of this.around[v]) for (const w of this.triangles[id]) if (w !== v) ring.add(w);
    return ring;
  }
  sharing(a, b) {
    return [...this.around[a]].filter((id) => this.around[b].has(id));
  }
  edges() {
    const list = [];
    this.points.forEach((_, a) => this.neighbours(a).forEach((b) => a < b && list.push([a, b])));
    return list;
  }
  set(id, triangle) {
    for (const v of this.triangles[id] ?? []) this.around[v].delete(id);
    this.triangles[id] = triangle;
    for (const v of triangle ?? []) this.around[v].add(id);
  }
  opposite(id, a, b) {
    return this.triangles[id].find((v) => v !== a && v !== b);
  }
  normal(triangle) {
    const [a, b, c] = triangle.map((v) => this.points[v]);
    return cross(sub(b, a), sub(c, a));
  }
  /** Would replacing v by `point` in the triangles of v, but those in `gone`, turn one over? */
  flipsOver(v, point, gone) {
    const old = this.points[v];
    for (const id of this.around[v]) {
      if (gone.includes(id)) continue;
      const before = this.normal(this.triangles[id]);
      this.points[v] = point;
      const after = this.normal(this.triangles[id]);
      this.points[v] = old;
      if (dot(before, after) < 0.2 * Math.sqrt(dot(before, before) * dot(after, after))) return true;
    }
    return false;
  }
}

function splitLong(s, length) {
  for (const [a, b] of s.edges()) {
    if (distance(s.points[a], s.points[b]) < (4 / 3) * length) continue;
    const m = s.points.push(middle(s.points[a], s.points[b])) - 1;
    s.around.push(new Set());
    for (const id of s.sharing(a, b)) {
      const t = s.triangles[id];
      s.triangles.push(null);
      s.set(s.triangles.length - 1, t.map((v) => (v === a ? m : v)));
      s.set(id, t.map((v) => (v === b ? m : v)));
    }
  }
}

function collapseShort(s, length) {
  for (const [a, b] of s.edges()) {
    if (distance(s.points[a], s.points[b]) > (4 / 5) * length) continue;
    const gone = s.sharing(a, b);
    if (gone.length !== 2) continue; // collapsed meanwhile
    const ringB = s.neighbours(b);
    const common = [...s.neighbours(a)].filter((v) => ringB.has(v));
    const m = middle(s.points[a], s.points[b]);
    const tooLong = [...s.neighbours(a), ...ringB].some((v) => distance(s.points[v], m) > (4 / 3) * length);
    if (common.length !== 2 || tooLong || s.flipsOver(a, m, gone) || s.flipsOver(b, m, gone)) continue;
    for (const id of gone) s.set(id, null);
    for (const id of [...s.around[b]]) s.set(id, s.triangles[id].map((v) => (v === b ? a : v)));
    s.points[a] = m;
  }
}

/** Turns an edge where that brings the four valences nearer to six and keeps the surface smooth. */
function flipForValence(s) {
  const excess = (v, change) => Math.abs(s.around[v].size + change - 6);
  for (const [a, b] of s.edges()) {
    const shared = s.sharing(a, b);
    if (shared.length !== 2) continue;
    const [c, d] = shared.map((id) => s.opposite(id, a, b));
    const gain = excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0) -
      excess(a, -1) - excess(b, -1) - excess(c, 1) - excess(d, 1);
    if (gain <= 0 || c === d || s.neighbours(c).has(d)) continue;
    const [t0, t1] = shared.map((id) => s.triangles[id]);
    const n0 = t0.map((v) => (v === a ? d : v)); // a, b, c with a -> d: d, b, c
    const n1 = t1.map((v) => (v === b ? c : v));
    const before = s.normal(t0);
    if ([n0, n1].some((t) => dot(s.normal(t), before) <= 0.5 * Math.hypot(...s.normal(t)) * Math.hypot(...before))) {
      continue;
    }
    s.set(shared[0], n0);
    s.set(shared[1], n1);
  }
}

/** Moves every point to the middle of its ring within the tangent plane, then onto the surface. */
function relax(s, field) {
  const moved = s.points.map((p, v) => {
    const ring = [...s.neighbours(v)];
    if (ring.length === 0) return p;
    const mean = [0, 1, 2].map((k) => ring.reduce((sum, w) => sum + s.points[w][k], 0) / ring.length);
    const g = gradient(field, p);
    const along = dot(sub(mean, p), g) / Math.max(dot(g, g), 1e-9);
    return project(field, mean.map((x, k) => x - along * g[k]));
  });
  moved.forEach((p, v) => (s.points[v] = p));
}

/** points: [[x, y, z]], triangles: [[a, b, c]]; both are returned anew, without unused points. */
export function remesh(points, triangles, field, length, rounds = 12) {
  const s = new Surface(points, triangles);
  for (let i = 0; i < rounds; i++) {
    splitLong(s, length);
    collapseShort(s, length);
    flipForValence(s);
    relax(s, field);
  }
  const kept = s.triangles.filter(Boolean);
  const ids = new Map();
  const id = (v) => ids.get(v) ?? (ids.set(v, ids.size), ids.size - 1);
  const renumbered = kept.map((t) => t.map(id));
  return { points: [...ids.keys()].map((v) => s.points[v]), triangles: renumbered };
}
