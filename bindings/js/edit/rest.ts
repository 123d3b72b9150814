// The rest shape of a step: the input, or what the step before has made of it.

import type { Core } from "../boundary/core.js";
import type { Refinement } from "../deform/sketch.js";
import { insideOf, Shape } from "../shape/shape.js";

export class Rest {
  #shape: Shape | undefined;

  /** `growth`: what earlier steps have added to the input; `labels`: of the last sketch step, one a vertex. */
  constructor(
    readonly core: Core, readonly input: Shape, readonly positions: Float64Array,
    readonly growth?: Refinement, readonly labels?: Uint32Array,
  ) {
    if (positions === insideOf(input).rest) this.#shape = input;
  }

  static ofInput(core: Core, input: Shape): Rest {
    return new Rest(core, input, insideOf(input).rest);
  }

  get dimension(): 2 | 3 {
    return this.input.dimension;
  }

  get triangles(): Uint32Array {
    return this.growth?.triangles ?? insideOf(this.input).triangles;
  }

  /** Built when it is first asked for. */
  get shape(): Shape {
    const { positions, triangles, dimension } = this;
    return (this.#shape ??= new Shape(this.core, { positions, triangles, dimension }));
  }

  /** Frees the shape, until it is asked for again; what is built over it lives on. */
  dispose(): void {
    if (this.#shape === this.input) return;
    this.#shape?.dispose();
    this.#shape = undefined;
  }
}
