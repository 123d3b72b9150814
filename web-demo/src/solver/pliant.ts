// MOCK
import { Quaternion, Vector3 } from "three";
export interface ShapeReport { vertices: number; triangles: number; components: number; boundaryEdges: number; nonManifoldEdges: number; degenerateTriangles: number; weldedVertices: number }
export interface StepReport { iteration: number; energy: number; terms: Record<string, number>; converged: boolean; milliseconds: number }
export type State = Record<string, any>;
export interface Shape { report: ShapeReport }
export interface Handle { move(t: any): Promise<void>; remove(): Promise<void> }
export interface Deformer {
  setFixed(v: Iterable<number>): Promise<void>; addHandle(v: Iterable<number>): Promise<Handle>;
  step(): Promise<StepReport>; positions(): Promise<Float32Array>; normals(): Promise<Float32Array>;
  state(): Promise<State>; restore(s: State): Promise<void>; reset(): Promise<void>; dispose(): Promise<void>;
}
export interface Pliant { shape(d: any): Promise<Shape & { data: any }>; deformer(s: Shape, o: any): Promise<Deformer> }
export async function connect(): Promise<Pliant> {
  return {
    async shape(d) { const e = new Map<string, number>(); for (let t = 0; t < d.triangles.length; t += 3) for (let i = 0; i < 3; i++) { const a = d.triangles[t + i], b = d.triangles[t + (i + 1) % 3]; const k = a < b ? a + "," + b : b + "," + a; e.set(k, (e.get(k) ?? 0) + 1); }
      return { data: d, report: { vertices: d.positions.length / (d.dimension ?? 3), triangles: d.triangles.length / 3, components: 1, boundaryEdges: [...e.values()].filter((c) => c === 1).length, nonManifoldEdges: 0, degenerateTriangles: 0, weldedVertices: 0 } }; },
    async deformer(s: any, o: any) { return new Mock(s.data, o); },
  };
}
class Mock implements Deformer {
  rest: Float32Array; now: Float32Array; handles: any[] = []; fixed: number[] = []; it = 0;
  constructor(public d: any, public o: any) { const n = d.positions.length / (d.dimension ?? 3); this.rest = new Float32Array(3 * n); for (let v = 0; v < n; v++) for (let k = 0; k < (d.dimension ?? 3); k++) this.rest[3 * v + k] = d.positions[(d.dimension ?? 3) * v + k]; this.now = this.rest.slice(); }
  async setFixed(v: Iterable<number>) { this.fixed = [...v]; }
  async addHandle(v: Iterable<number>) { const ids = [...v]; const c = new Vector3(); ids.forEach((i) => c.add(new Vector3().fromArray(this.rest, 3 * i))); c.divideScalar(ids.length); const h = { ids, c, t: { translate: [0, 0, 0] } as any }; this.handles.push(h); return { move: async (t: any) => { h.t = t; this.it = 0; }, remove: async () => { this.handles = this.handles.filter((x) => x !== h); } }; }
  async step() {
    const fc = new Vector3(); this.fixed.forEach((i) => fc.add(new Vector3().fromArray(this.rest, 3 * i))); fc.divideScalar(this.fixed.length || 1);
    const p = new Vector3(), q = new Vector3(), acc = new Vector3();
    for (let v = 0; v < this.rest.length / 3; v++) { p.fromArray(this.rest, 3 * v); let w = this.fixed.length ? 1 / p.distanceTo(fc) ** 3 : 0; acc.copy(p).multiplyScalar(w); for (const h of this.handles) { const wh = 1 / (p.distanceTo(h.c) ** 3 + 1e-6); q.copy(p); if (h.t.rotate) q.sub(h.c).applyQuaternion(new Quaternion().setFromAxisAngle(new Vector3(...h.t.rotate.axis), h.t.rotate.degrees * Math.PI / 180)).add(h.c); q.add(new Vector3(...h.t.translate)); acc.addScaledVector(q, wh); w += wh; } acc.divideScalar(w || 1); for (let k = 0; k < 3; k++) this.now[3 * v + k] += 0.4 * (acc.getComponent(k) - this.now[3 * v + k]); }
    this.it++; return { iteration: this.it, energy: 1 / this.it, terms: {}, converged: this.it > 12, milliseconds: 3 };
  }
  async positions() { return this.now.slice(); }
  async normals() { const n = new Float32Array(this.now.length), t = this.d.triangles, P = this.now; const a = new Vector3(), b = new Vector3(), c = new Vector3(); for (let i = 0; i < t.length; i += 3) { a.fromArray(P, 3 * t[i]); b.fromArray(P, 3 * t[i + 1]); c.fromArray(P, 3 * t[i + 2]); b.sub(a); c.sub(a); b.cross(c); for (let j = 0; j < 3; j++) { n[3 * t[i + j]] += b.x; n[3 * t[i + j] + 1] += b.y; n[3 * t[i + j] + 2] += b.z; } } for (let v = 0; v < n.length; v += 3) { const l = Math.hypot(n[v], n[v + 1], n[v + 2]) || 1; n[v] /= l; n[v + 1] /= l; n[v + 2] /= l; } return n; }
  async state() { const nodes = [], tr = [], edges = [], rot = []; const N = this.o.nodeCount, S = Math.floor(this.rest.length / 3 / N); for (let j = 0; j < N; j++) { const v = j * S; nodes.push([...this.rest.slice(3 * v, 3 * v + 3)]); tr.push([0, 1, 2].map((k) => this.now[3 * v + k] - this.rest[3 * v + k])); rot.push([1, 0, 0, 0, 1, 0, 0, 0, 1]); if (j) edges.push([j - 1, j]); } return { nodes, translations: tr, edges, rotations: rot, now: this.now.slice() }; }
  async restore(s: State) { this.now = s.now.slice(); this.it = 20; }
  async reset() { this.now = this.rest.slice(); this.it = 20; this.handles.forEach((h) => (h.t = { translate: [0, 0, 0] })); }
  async dispose() {}
}
