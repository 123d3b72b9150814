// A square sheet with bumps: every distortion shows on it.
import type { ShapeData } from "./shape.ts";

/** `side` vertices a side over [-1, 1] x [-1, 1], y up; sin times sin, eight periods, amplitude 0.02 of the side. */
export function bumpyPlane(side = 161): ShapeData {
  const positions = new Float32Array(3 * side * side);
  const colors = new Uint8Array(3 * side * side);
  for (let row = 0; row < side; row++) {
    for (let column = 0; column < side; column++) {
      const [u, v] = [column / (side - 1), row / (side - 1)];
      const wave = Math.sin(16 * Math.PI * u) * Math.sin(16 * Math.PI * v);
      const id = row * side + column;
      positions.set([2 * u - 1, 0.04 * wave, 2 * v - 1], 3 * id);
      const t = (wave + 1) / 2;
      colors.set([206 + 40 * t, 150 + 62 * t, 122 + 50 * t], 3 * id);
    }
  }
  const triangles = new Uint32Array(6 * (side - 1) * (side - 1));
  let at = 0;
  for (let row = 0; row + 1 < side; row++) {
    for (let column = 0; column + 1 < side; column++) {
      const a = row * side + column;
      triangles.set([a, a + side, a + 1, a + 1, a + side, a + side + 1], at);
      at += 6;
    }
  }
  return {
    id: "plane", name: "Bumpy sheet", positions, triangles, dimension: 3, colors, viewFrom: [0.55, 0.75, 1],
    start: {
      fixed: ([x]) => x < -0.8,
      handles: [{ name: "edge", center: [1, 0, 0], radius: 0.16 }],
    },
  };
}
