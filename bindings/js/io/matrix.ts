// Affine 4 x 4 matrices, column by column, on points and directions.

import type { mat4 } from "@gltf-transform/core";

type Vector = ArrayLike<number>;

export function applyTo(m: mat4, p: Vector): number[] {
  return [0, 1, 2].map((i) => m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i]);
}

/** The way back, or undefined where there is none. */
export function applyInverse(m: mat4): ((p: Vector) => number[]) | undefined {
  const rows = cofactors(m);
  const scale = 1 / determinant(m);
  if (!Number.isFinite(scale)) return undefined;
  return (p) => rows.map((row) => scale * row.reduce((sum, r, i) => sum + r * (p[i] - m[12 + i]), 0));
}

/** A normal, from the mesh to the scene: as the cross product of two edges goes, by the cofactors. */
export function directionOut(m: mat4, n: Vector): number[] {
  const c = cofactors(m);
  return unit([0, 1, 2].map((i) => c[0][i] * n[0] + c[1][i] * n[1] + c[2][i] * n[2]));
}

/** A normal, from the scene to the mesh: the transpose undoes the cofactors up to their determinant. */
export function directionBack(m: mat4, n: Vector): number[] {
  const sign = Math.sign(determinant(m));
  return unit([0, 4, 8].map((at) => sign * (m[at] * n[0] + m[at + 1] * n[1] + m[at + 2] * n[2])));
}

function determinant(m: mat4): number {
  return cofactors(m)[0].reduce((sum, c, i) => sum + m[i] * c, 0);
}

/** Cross products of the columns: row i of the inverse times the determinant. */
function cofactors(m: mat4): number[][] {
  const column = (i: number) => [m[4 * i], m[4 * i + 1], m[4 * i + 2]];
  return [0, 1, 2].map((i) => cross(column((i + 1) % 3), column((i + 2) % 3)));
}

function cross([a, b, c]: number[], [x, y, z]: number[]): number[] {
  return [b * z - c * y, c * x - a * z, a * y - b * x];
}

function unit(v: number[]): number[] {
  const length = Math.hypot(...v);
  return length > 0 ? v.map((x) => x / length) : v;
}
