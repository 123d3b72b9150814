// The two figures of the readout that need every vertex, stretch and volume: measured by the library in its worker, the
// newest positions after those before, never faster than a reader of the figures can follow.
import type { WorkerShape } from "pliant/worker";
import { connect } from "../solver/pliant.ts";
import type { ShapeData } from "./shape.ts";

export interface Measures {
  /** Mean |l'/l - 1| over the edges; undefined for points. */
  stretch?: number;
  /** Signed volume over that at rest; undefined unless closed. */
  volume?: number;
}

/** Milliseconds between two measurements, so that the solver has the worker most of the time. */
const breath = 250;

const flat = (positions: ArrayLike<number>, dimension: 2 | 3) =>
  dimension === 3
    ? positions
    : Float64Array.from({ length: (2 * positions.length) / 3 }, (_, i) => positions[3 * (i >> 1) + (i & 1)]!);

/** Measures deformed positions against the rest. */
export class Meter {
  private last: Measures = {};
  private measured: ArrayLike<number> | undefined;
  private wanted: ArrayLike<number> | undefined;
  private running = false;
  private shape: Promise<WorkerShape> | undefined;

  /** `tell`: there are new figures. */
  constructor(private readonly rest: ShapeData, private readonly tell: () => void) {}

  /** The newest figures there are; those of these positions follow. */
  measure(positions: ArrayLike<number>): Measures {
    const fits = positions.length === this.rest.positions.length; // not so with what refinement added
    if (this.rest.triangles.length > 0 && fits && positions !== this.measured) {
      this.wanted = positions;
      if (!this.running) void this.run();
    }
    return this.last;
  }

  /** Frees what the worker holds for it. */
  async dispose(): Promise<void> {
    this.wanted = undefined;
    await (await this.shape?.catch(() => undefined))?.dispose();
  }

  private async run(): Promise<void> {
    this.running = true;
    while (this.wanted) {
      this.measured = this.wanted;
      this.wanted = undefined;
      try {
        this.last = await this.ask(this.measured);
        this.tell();
      } catch {
        this.last = {}; // it cannot be measured: no figure is shown
      }
      await new Promise((resolve) => setTimeout(resolve, breath));
    }
    this.running = false;
  }

  private async ask(positions: ArrayLike<number>): Promise<Measures> {
    const pliant = await connect();
    const { exact, positions: rest, triangles, dimension } = this.rest;
    this.shape ??= pliant.shape({ positions: flat(exact ?? rest, dimension), triangles, dimension });
    const { stretch, volume } = await pliant.measure(await this.shape, flat(positions, dimension), {
      intersections: false,
    });
    return { stretch: stretch.mean, ...(volume === null ? {} : { volume }) };
  }
}

/** Of a closed surface: positive where its triangles look outwards. */
export function signedVolume({ positions, triangles }: Pick<ShapeData, "positions" | "triangles">): number {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t]!, 3 * triangles[t + 1]!, 3 * triangles[t + 2]!];
    const [ax, ay, az] = [positions[a]!, positions[a + 1]!, positions[a + 2]!];
    const [bx, by, bz] = [positions[b]!, positions[b + 1]!, positions[b + 2]!];
    const [cx, cy, cz] = [positions[c]!, positions[c + 1]!, positions[c + 2]!];
    sum += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return sum / 6;
}
