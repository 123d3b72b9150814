// A tree as a scanner would see it: points without faces, grown from a seeded random walk.
import type { ShapeData } from "./shape.ts";

type Vec = [number, number, number];

/** Mulberry32: the same numbers on every machine. */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

class Cloud {
  readonly positions: number[] = [];
  readonly colors: number[] = [];
  constructor(private readonly next: () => number) {}

  private push(p: Vec, color: Vec, light: number): void {
    this.positions.push(...p);
    this.colors.push(...color.map((c) => Math.max(0, Math.min(255, c * light))));
  }

  /** Points on the bark of a limb from a to b, radius ra to rb. */
  bark(a: Vec, b: Vec, ra: number, rb: number, count: number): void {
    for (let i = 0; i < count; i++) {
      const t = this.next();
      const angle = 2 * Math.PI * this.next();
      const r = (ra + t * (rb - ra)) * (0.94 + 0.12 * this.next());
      const [dx, dz] = [Math.cos(angle), Math.sin(angle)];
      const p: Vec = [a[0] + t * (b[0] - a[0]) + r * dx, a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) + r * dz];
      this.push(p, [139, 99, 72], 0.72 + 0.22 * (dx * 0.5 + dz * 0.6) + 0.12 * this.next());
    }
  }

  /** Leaves on and just inside a ball, darker below. */
  leaves(center: Vec, radius: number, count: number): void {
    for (let i = 0; i < count; i++) {
      const z = 2 * this.next() - 1;
      const angle = 2 * Math.PI * this.next();
      const s = Math.sqrt(1 - z * z);
      const depth = radius * (1 - 0.22 * this.next() ** 2);
      const n: Vec = [s * Math.cos(angle), z, s * Math.sin(angle)];
      const p: Vec = [center[0] + depth * n[0], center[1] + 0.86 * depth * n[1], center[2] + depth * n[2]];
      const autumn = this.next() < 0.08;
      this.push(
        p, autumn ? [236, 170, 74] : [116, 168, 82], 0.78 + 0.24 * n[1] + 0.16 * n[0] + 0.2 * (this.next() - 0.5),
      );
    }
  }
}

export function tree(): ShapeData {
  const cloud = new Cloud(random(7));
  cloud.bark([0, 0, 0], [0.03, 0.55, 0], 0.15, 0.095, 2600);
  cloud.bark([0.03, 0.55, 0], [0, 1.2, 0], 0.095, 0.05, 1500);
  const crowns: [Vec, number][] = [
    [[0, 1.62, 0], 0.4], [[0.44, 1.3, 0.1], 0.32], [[-0.42, 1.34, 0.08], 0.34],
    [[0.08, 1.26, 0.42], 0.3], [[-0.05, 1.32, -0.42], 0.32],
  ];
  for (const [center, radius] of crowns) {
    cloud.bark([0.02, 0.72, 0], center, 0.055, 0.02, 420);
    cloud.leaves(center, radius, Math.round(30000 * radius * radius));
  }
  return {
    id: "tree", name: "Tree (points)", positions: Float32Array.from(cloud.positions), triangles: new Uint32Array(0),
    dimension: 3, colors: Uint8Array.from(cloud.colors), dotSize: 0.018, viewFrom: [0.35, 0.25, 1],
    start: {
      fixed: ([, y]) => y < 0.2,
      handles: [{ name: "crown", center: [0, 1.95, 0.1], radius: 0.24 }],
    },
  };
}
