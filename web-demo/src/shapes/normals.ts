// Normals of positions that come without.
import type { Topology } from "./topology.ts";

/** Unit normals, the triangles' by their areas; vertices at one place at rest share one. */
export function normalsOf(positions: Float32Array, triangles: Uint32Array, { pointOf, points }: Topology): Float32Array {
  const sums = new Float64Array(3 * points);
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [triangles[t]!, triangles[t + 1]!, triangles[t + 2]!];
    const [a, b, c] = corners.map((v) => 3 * v) as [number, number, number];
    const [ux, uy, uz] = [positions[b]! - positions[a]!, positions[b + 1]! - positions[a + 1]!, positions[b + 2]! - positions[a + 2]!];
    const [vx, vy, vz] = [positions[c]! - positions[a]!, positions[c + 1]! - positions[a + 1]!, positions[c + 2]! - positions[a + 2]!];
    const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const v of corners) for (let k = 0; k < 3; k++) sums[3 * pointOf[v]! + k]! += normal[k]!;
  }
  const out = new Float32Array(positions.length);
  for (let v = 0; v < out.length / 3; v++) {
    const p = 3 * pointOf[v]!;
    const length = Math.hypot(sums[p]!, sums[p + 1]!, sums[p + 2]!) || 1;
    for (let k = 0; k < 3; k++) out[3 * v + k] = sums[p + k]! / length;
  }
  return out;
}
