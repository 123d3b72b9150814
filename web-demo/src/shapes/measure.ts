// The two figures of the readout that need every vertex, stretch and volume: measured by the library in its worker, the
// newest positions after those before, never faster than a reader of the figures can follow.
import type { Quality } from "../solver/pliant.ts";
import { turn } from "../files/turn.ts";
import { vertexCount, type ShapeData } from "./shape.ts";

export interface Measures {
  /** Mean |l'/l - 1| over the edges; undefined for points. */
  stretch?: number;
  /** Signed volume over that at rest; undefined unless closed. */
  volume?: number;
}

/** Milliseconds between two measurements, so that the solver has the worker most of the time. */
const breath = 250;

/** Measures deformed positions of one shape against its rest. */
export class Meter {
  private last: Measures = {};
  private measured: Float32Array | undefined;
  private wanted: Float32Array | undefined;
  private running = false;

  /** `ask`: the library; `tell`: there are new figures. */
  constructor(
    private readonly rest: ShapeData, private readonly ask: (positions: Float32Array) => Promise<Quality>,
    private readonly tell: () => void,
  ) {}

  /** The newest figures there are; those of these positions follow. */
  measure(positions: Float32Array): Measures {
    const fits = positions.length === 3 * vertexCount(this.rest); // not so with what refinement added
    if (this.rest.triangles.length > 0 && fits && positions !== this.measured) {
      this.wanted = positions;
      if (!this.running) void this.run();
    }
    return this.last;
  }

  /** Asks for nothing more. */
  end(): void {
    this.wanted = undefined;
  }

  private async run(): Promise<void> {
    this.running = true;
    await turn(); // drawing comes first
    while (this.wanted) {
      this.measured = this.wanted;
      this.wanted = undefined;
      try {
        const { stretch, volume } = await this.ask(this.measured);
        this.last = { stretch: stretch.mean, ...(volume === null ? {} : { volume }) };
        this.tell();
      } catch {
        this.last = {}; // it cannot be measured: no figure is shown
      }
      await new Promise((resolve) => setTimeout(resolve, breath));
    }
    this.running = false;
  }
}
