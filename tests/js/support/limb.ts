// A limb to sketch on: a closed tube along z from 0 to 1, seen from the front, 1000 pixels high and wide.

import type { Mesh } from "./shapes.js";

export const radius = 0.05;

/** Rings of `around` vertices, `along` of them; the ends are closed. `x`: of its axis. */
export function limb(around = 24, along = 61, x = 0): Mesh {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (let j = 0; j < along; ++j) {
    for (let i = 0; i < around; ++i) {
      const a = (2 * Math.PI * (i + 0.5)) / around;
      positions.push(x + radius * Math.cos(a), radius * Math.sin(a), j / (along - 1));
    }
  }
  const id = (i: number, j: number) => (i % around) + around * j;
  for (let j = 0; j + 1 < along; ++j) {
    for (let i = 0; i < around; ++i) {
      triangles.push(id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j), id(i + 1, j + 1), id(i, j + 1));
    }
  }
  const bottom = positions.length / 3;
  positions.push(x, 0, 0, x, 0, 1);
  for (let i = 0; i < around; ++i) {
    triangles.push(bottom, id(i + 1, 0), id(i, 0), bottom + 1, id(i, along - 1), id(i + 1, along - 1));
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** Two limbs side by side, mirrored in x = 0. */
export function twoLimbs(): Mesh {
  const [a, b] = [limb(24, 61, 0.2), limb(24, 61, -0.2)];
  const shift = a.positions.length / 3;
  return {
    positions: Float64Array.of(...a.positions, ...b.positions),
    triangles: Uint32Array.of(...a.triangles, ...b.triangles.map((v) => v + shift)),
  };
}

export const camera = {
  eye: [0, -5, 0.5], target: [0, 0, 0.5], up: [0, 0, 1], orthographicHeight: 2, width: 1000, height: 1000,
};

export const pixel = (x: number, z: number): number[] => [500 + 500 * x, 750 - 500 * z];

/**
 * Pixels along a curve that starts upwards and turns to the left by `curvature(t)` radians over its length, t from 0 to
 * 1.
 */
export function curved(
  x: number, z: number, length: number, curvature: (t: number) => number, samples = 81,
): number[][] {
  const pixels = [pixel(x, z)];
  let heading = Math.PI / 2;
  for (let i = 0; i + 1 < samples; ++i) {
    const turn = curvature((i + 0.5) / (samples - 1)) / (samples - 1);
    const step = length / (samples - 1);
    pixels.push(pixel((x += step * Math.cos(heading + turn / 2)), (z += step * Math.sin(heading + turn / 2))));
    heading += turn;
  }
  return pixels;
}

/** From z = 0.2 to 0.8 along the axis, and bent to the left by 90 degrees. */
export const straight = curved(0, 0.2, 0.6, () => 0);
export const arc = curved(0, 0.2, 0.6, () => Math.PI / 2);
/** The arc twice as long. */
export const longArc = curved(0, 0.2, 1.5, () => Math.PI);
