// Shapes of several parts that nothing joins.

import type { Mesh } from "./shapes.js";

/** A ball as a grid of n x n vertices, open at its poles. */
export function orb(n: number, radius: number, [cx, cy, cz]: readonly number[]): Mesh {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < n; ++j) {
      const [u, v] = [(2 * Math.PI * j) / n, Math.PI * (0.02 + (0.96 * i) / (n - 1))];
      const [ring, height] = [radius * Math.sin(v), radius * Math.cos(v)];
      positions.push(cx + ring * Math.cos(u), cy + ring * Math.sin(u), cz + height);
      if (i + 1 === n) continue;
      const [a, b] = [n * i + j, n * i + ((j + 1) % n)];
      triangles.push(a, a + n, b + n, a, b + n, b);
    }
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

export function joined(...meshes: Mesh[]): Mesh {
  let first = 0;
  const triangles = meshes.flatMap((mesh) => {
    const ids = Array.from(mesh.triangles, (v) => v + first);
    first += mesh.positions.length / 3;
    return ids;
  });
  const positions = meshes.flatMap((mesh) => [...mesh.positions]);
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}
