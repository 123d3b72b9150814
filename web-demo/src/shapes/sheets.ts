// A cloth and a tube: what materials show on.
import type { ShapeData } from "./shape.ts";

const weave = (column: number, row: number): [number, number, number] =>
  (Math.floor(column / 5) + Math.floor(row / 5)) % 2 === 0 ? [196, 84, 74] : [243, 226, 205];

/** `side` vertices a side over [-1, 1] x [-1, 1], alternating diagonals, held at its centre, falling. */
export function cloth(side = 61): ShapeData {
  const positions: number[] = [];
  const colors: number[] = [];
  const triangles: number[] = [];
  for (let row = 0; row < side; row++) {
    for (let column = 0; column < side; column++) {
      positions.push((2 * column) / (side - 1) - 1, 0, (2 * row) / (side - 1) - 1);
      colors.push(...weave(column, row));
    }
  }
  for (let row = 0; row + 1 < side; row++) {
    for (let column = 0; column + 1 < side; column++) {
      const a = row * side + column;
      const [b, c, d] = [a + 1, a + side, a + side + 1];
      triangles.push(...((row + column) % 2 === 0 ? [a, c, d, a, d, b] : [a, c, b, b, c, d]));
    }
  }
  return {
    id: "cloth", name: "Cloth", dimension: 3, viewFrom: [0.5, 0.35, 1], hangs: 0.16,
    positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles), colors: Uint8Array.from(colors),
    start: {
      fixed: ([x, , z]) => Math.hypot(x, z) < 0.05, handles: [],
      method: "edge-material", options: { stretch: 7, gravity: 1 },
    },
  };
}

/** `rings` of `around` vertices along y, alternating diagonals: uniform ones would favour one way of twisting. */
export function tube(rings = 47, around = 30): ShapeData {
  const positions: number[] = [];
  const colors: number[] = [];
  const triangles: number[] = [];
  const at = (ring: number, k: number) => ring * around + ((k + around) % around);
  for (let ring = 0; ring < rings; ring++) {
    for (let k = 0; k < around; k++) {
      const angle = (2 * Math.PI * k) / around;
      positions.push(0.35 * Math.cos(angle), (2.6 * ring) / (rings - 1), 0.35 * Math.sin(angle));
      colors.push(...(k % 6 < 3 ? [88, 148, 170] : [228, 224, 210]));
    }
  }
  for (let ring = 0; ring + 1 < rings; ring++) {
    for (let k = 0; k < around; k++) {
      const [a, b, c, d] = [at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)];
      triangles.push(...((ring + k) % 2 === 0 ? [a, c, d, a, d, b] : [a, c, b, b, c, d]));
    }
  }
  return {
    id: "tube", name: "Tube", dimension: 3, viewFrom: [0.5, 0.3, 1],
    positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles), colors: Uint8Array.from(colors),
    start: {
      fixed: ([, y]) => y < 0.12, handles: [{ name: "end", center: [0, 2.6, 0], radius: 0.37 }],
      method: "edge-material", options: { stretch: 1, bend: 1 },
    },
  };
}
