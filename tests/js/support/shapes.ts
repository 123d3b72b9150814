// Generated shapes.

export interface Mesh {
  positions: Float64Array;
  triangles: Uint32Array;
}

/** Repeatable numbers in [0, 1): a linear congruential generator (Numerical Recipes, 32 bits). */
export function random(seed: number): () => number {
  let state = seed >>> 0;
  return () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
}

/** An open sheet over the unit square, n x n vertices, with bumps and no two edges quite alike. */
export function sheet(n: number): Mesh {
  const noise = random(7);
  const positions: number[] = [];
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < n; ++j) {
      const [x, y] = [i / (n - 1), j / (n - 1)];
      positions.push(x + 1e-3 * noise() / n, y + 1e-3 * noise() / n, 0.02 * Math.sin(9 * x) * Math.sin(11 * y) + 0);
    }
  }
  return { positions: Float64Array.from(positions), triangles: gridTriangles(n, n, false) };
}

/** A closed torus around z, nu x nv vertices, slightly rough. */
export function torus(nu: number, nv: number): Mesh {
  const noise = random(3);
  const positions: number[] = [];
  for (let i = 0; i < nu; ++i) {
    for (let j = 0; j < nv; ++j) {
      const [u, v] = [(2 * Math.PI * i) / nu, (2 * Math.PI * j) / nv];
      const r = 1 + 0.4 * Math.cos(v) + 1e-3 * noise();
      positions.push(r * Math.cos(u), r * Math.sin(u), 0.4 * Math.sin(v));
    }
  }
  return { positions: Float64Array.from(positions), triangles: gridTriangles(nu, nv, true) };
}

function gridTriangles(nu: number, nv: number, closed: boolean): Uint32Array {
  const triangles: number[] = [];
  const id = (i: number, j: number) => (i % nu) * nv + (j % nv);
  const last = closed ? 0 : 1;
  for (let i = 0; i < nu - last; ++i) {
    for (let j = 0; j < nv - last; ++j) {
      const [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
      triangles.push(a, b, c, a, c, d);
    }
  }
  return Uint32Array.from(triangles);
}

/** Points in the unit cube, no two the same. */
export function cloud(n: number): Float64Array {
  const noise = random(11);
  return Float64Array.from({ length: 3 * n }, noise);
}

/** A picture: n x n vertices of the unit square, two numbers each. */
export function picture(n: number): Mesh {
  const { positions, triangles } = sheet(n);
  return { positions: positions.filter((_, i) => i % 3 !== 2), triangles };
}

/** A bar along x made of quads, with texture coordinates that have a seam along one side. */
export function barObj(segments: number): string {
  const lines = ["# a bar", "mtllib bar.mtl", "o bar"];
  const ring = [[0, 0], [1, 0], [1, 1], [0, 1]];
  for (let i = 0; i <= segments; ++i) for (const [y, z] of ring) lines.push(`v ${i / 3} ${y} ${z}`);
  for (let i = 0; i <= segments; ++i) for (let j = 0; j <= 4; ++j) lines.push(`vt ${i / segments} ${j / 4}`);
  lines.push("usemtl skin");
  const corner = (i: number, j: number) => `${4 * i + (j % 4) + 1}/${5 * i + j + 1}`;
  for (let i = 0; i < segments; ++i) {
    for (let j = 0; j < 4; ++j) {
      lines.push(`f ${corner(i, j)} ${corner(i, j + 1)} ${corner(i + 1, j + 1)} ${corner(i + 1, j)}`);
    }
  }
  return `${lines.join("\n")}\n`;
}

/** Ids of the vertices that pass a test of their coordinates. */
export function where(positions: Float64Array, test: (x: number, y: number, z: number) => boolean): number[] {
  return Array.from({ length: positions.length / 3 }, (_, v) => v).filter((v) =>
    test(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]),
  );
}
