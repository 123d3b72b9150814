// Vertices that are meant to be one but differ by rounding: a seam at 0 and 360 degrees.

/** The positions, three numbers a vertex, with every vertex at the place of the first one closer than `tolerance`. */
export function snapped(positions: Float32Array, tolerance: number): Float32Array {
  const result = positions.slice();
  if (!(tolerance > 0)) return result;
  const grid = new Map<string, number[]>();
  const cell = 4 * tolerance;
  for (let at = 0; at < result.length; at += 3) {
    const p = result.subarray(at, at + 3);
    const near = nearby(p, tolerance, cell).flatMap((key) => grid.get(key) ?? []);
    const first = near.find((other) => Math.hypot(p[0] - result[other], p[1] - result[other + 1], p[2] - result[other + 2]) < tolerance);
    if (first !== undefined) {
      p.set(result.subarray(first, first + 3));
      continue;
    }
    const home = keyOf(p, 0, 0, 0, cell);
    grid.set(home, [...(grid.get(home) ?? []), at]);
  }
  return result;
}

/** The cells that a ball of this radius can reach: one, or up to eight at a corner of the grid. */
function nearby(p: Float32Array, radius: number, cell: number): string[] {
  const keys = new Set<string>();
  for (const x of [-radius, radius]) for (const y of [-radius, radius]) for (const z of [-radius, radius]) keys.add(keyOf(p, x, y, z, cell));
  return [...keys];
}

function keyOf(p: Float32Array, x: number, y: number, z: number, cell: number): string {
  return `${Math.floor((p[0] + x) / cell)} ${Math.floor((p[1] + y) / cell)} ${Math.floor((p[2] + z) / cell)}`;
}
