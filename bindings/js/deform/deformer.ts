// Deformers: a shape, constraints on it, and a method that finds the deformation.

import { fields, integer, Place, positive, vertexIds } from "../boundary/check.js";
import { accept, build, type Core } from "../boundary/core.js";
import { PliantError } from "../boundary/errors.js";
import type { State, StateHatch } from "../boundary/state.js";
import { Deformation } from "./deformation.js";
import { eventLoopTurn, readCallback, readSignal, throwIfAborted } from "../boundary/task.js";
import { Handle } from "./handle.js";
import {
  type DeformerOptions, drawing, type LiveOptions, type Method, type MethodName, methodsThat, readLive, readMethod,
  readOptions,
} from "../methods/index.js";
import type { RawDeformer } from "../boundary/raw.js";
import { extentOf, insideOf, type Shape, shapeFor } from "../shape/shape.js";

/** What one iteration did. */
export interface Step {
  /** Accepted iterations since the constraints last changed. */
  iteration: number;
  /** The weighted sum of the terms, after the step. */
  energy: number;
  /** Each term, unweighted. */
  terms: Record<string, number>;
  /** Whether the method's own test holds. */
  converged: boolean;
  /** False when no step lowers the energy any more. */
  accepted: boolean;
  milliseconds: number;
}

/** What a solve did: its last step, and how many it took in all. */
export interface Solution extends Step {
  iterations: number;
}

export interface StepOptions {
  /** Of the method's own test: 1e-6. */
  tolerance?: number;
}

export interface SolveOptions extends StepOptions {
  /** 100. */
  maxIterations?: number;
  signal?: AbortSignal;
  /** Called after every iteration. */
  onProgress?: (step: Step) => void;
}

/** What solving has cost so far. */
export interface Counters {
  unknowns: number;
  factorizations: number;
  analyses: number;
}

/** What a living edit knows of a deformer beside its calls; not for callers of the package. */
export let drive: (deformer: Deformer) => {
  readonly method: Method;
  /** Whether nothing is left to do after a step. */
  settled(step: Step): boolean;
  /** Whether refinement has changed the model. */
  refined(): boolean;
};

/**
 * A shape, constraints on it, and a method that finds the deformation. Made by `pliant.deformer`. `reset` keeps handles
 * and the fixed region, targets return to rest; `restore` brings targets back, too, of handles with the same vertices.
 */
export class Deformer<M extends MethodName = MethodName> extends Deformation<State, RawDeformer> {
  readonly method: M;
  readonly #method: Method;
  readonly #handles = new Map<number, Handle>();
  #refined = false;

  static {
    drive = (deformer) => ({
      method: deformer.#method, settled: (step) => deformer.#settled(step), refined: () => deformer.#refined,
    });
  }

  /** @internal */
  constructor(core: Core, shape: Shape, options: DeformerOptions<M>) {
    const place = new Place("invalid-option", "options");
    shapeFor(core, shape);
    if (typeof options !== "object" || options === null) place.fail(options, "an object with a method");
    const method = readMethod(place.at("method"), options.method);
    const read = readOptions(place, options, method, extentOf(shape), ["method"]);
    const raw = build(
      core,
      () => new core.raw.Deformer(),
      (unbuilt) => {
        const packed = method.pack(read, place, shape);
        return insideOf(shape).owned.call((rawShape) =>
          unbuilt.build(rawShape, method.name, ...core.stageValues(packed)),
        );
      },
    );
    super(core, shape, raw, "deformer");
    this.#method = method;
    this.method = method.name as M;
  }

  // -- On grab: the next step factorises. -----------------------------------------------------------

  /** Replaces the fixed region; no vertices: none. Errors: invalid-handle. */
  setFixed(vertices: Iterable<number>): void {
    const ids = vertexIds(new Place("invalid-handle", "fixed"), vertices, this.shape.report.vertices);
    this.owned.accept((raw) => raw.setFixed(this.#core.stage([], ids)));
  }

  /**
   * Adds a handle, at rest until it is moved. Errors: invalid-handle, also for a vertex that is fixed or of another
   * handle.
   */
  addHandle(vertices: Iterable<number>): Handle {
    const place = new Place("invalid-handle", "vertices");
    const ids = vertexIds(place, vertices, this.shape.report.vertices);
    if (ids.length === 0) place.reject("is empty; expected at least one vertex id");
    const { status, id } = this.owned.call((raw) => raw.addHandle(this.#core.stage([], ids)));
    accept(status);
    const handle = new Handle(this.owned, this.shape, id, ids, () => this.#handles.delete(id));
    this.#handles.set(id, handle);
    return handle;
  }

  /** The handles there are, oldest first. */
  get handles(): Handle[] {
    return [...this.#handles.values()];
  }

  // -- Options that are live. -----------------------------------------------------------------------

  /** The options in use: what `pliant.deformer` takes beside the method. */
  options(): Omit<DeformerOptions<M>, "method"> {
    const values = this.owned.call((raw) => this.#core.stagedValues((scratch) => raw.options(scratch)));
    return this.#method.unpack(values, this.shape.dimension) as Omit<DeformerOptions<M>, "method">;
  }

  /**
   * Changes options of a living deformer, those that `pliant.methods` calls live; handles, targets, the deformation and
   * options left out stay. Errors: invalid-option; then nothing has changed.
   */
  setOptions(options: LiveOptions[M]): void {
    const place = new Place("invalid-option", "options");
    const given = readLive(place, options, this.#method, extentOf(this.shape));
    const packed = this.#method.pack(given, place, this.shape);
    this.owned.accept((raw) => raw.setOptions(...this.#core.stageValues(packed)));
  }

  // -- Solving. -------------------------------------------------------------------------------------

  /** One iteration. Errors: not-solvable, too-large; the deformation is then as before. */
  step(options: StepOptions = {}): Step {
    const place = new Place("invalid-option", "options");
    return this.#step(readTolerance(place, fields(place, options, ["tolerance"])));
  }

  /**
   * Iterates until the method's test holds, and yields to the event loop in between. Errors: as `step`, aborted,
   * disposed.
   */
  async solve(options: SolveOptions = {}): Promise<Solution> {
    const { tolerance, maxIterations, signal, onProgress } = readSolveOptions(options);
    let iterations = 0;
    for (;;) {
      await eventLoopTurn();
      throwIfAborted(signal);
      const step = this.#step(tolerance);
      if (step.accepted) ++iterations;
      onProgress?.(step);
      if (iterations >= maxIterations || this.#settled(step)) return { ...step, iterations };
    }
  }

  #step(tolerance: number): Step {
    const start = performance.now();
    const { status, ...report } = this.owned.call((raw) => raw.step(tolerance));
    accept(status);
    const milliseconds = performance.now() - start;
    return { ...report, terms: this.#terms("value"), milliseconds };
  }

  /** Whether nothing is left to do after a step: the last refines the model, where the options ask for it. */
  #settled({ converged, accepted }: Step): boolean {
    return (converged || !accepted) && !this.#refine();
  }

  /** Whether refinement has added something to solve. */
  #refine(): boolean {
    const { status, added } = this.owned.call((raw) => raw.refine());
    accept(status);
    this.#refined ||= added > 0;
    return added > 0;
  }

  /** At the current deformation and targets: the weighted sum, each term unweighted, and the weights. */
  energy(): { total: number; terms: Record<string, number>; weights: Record<string, number> } {
    const total = this.owned.call((raw) => raw.energyTotal());
    return { total, terms: this.#terms("value"), weights: this.#terms("weight") };
  }

  #terms(part: "value" | "weight"): Record<string, number> {
    const terms = this.owned.call((raw) => raw.energyTerms());
    return Object.fromEntries(terms.map((term) => [term.name, term[part]]));
  }

  counters(): Counters {
    return this.owned.call((raw) => raw.counters());
  }

  protected override get stateHatch(): StateHatch | undefined {
    return this.#method.state;
  }

  /**
   * Directions that the material has, 3 numbers a vertex: a unit vector along the surface, its sign without meaning, or
   * zero. Errors: not-solvable.
   */
  field(): Float32Array {
    if (!this.#method.draws.includes("field")) {
      throw new PliantError(
        "not-solvable", `${this.method} has no directions; expected ${methodsThat(drawing("field"))}`,
      );
    }
    const { status, points } = this.owned.call((raw) => raw.field());
    accept(status);
    return Float32Array.from(points);
  }

  get #core(): Core {
    return this.owned.core;
  }
}

function readTolerance(place: Place, { tolerance = 1e-6 }: Readonly<Record<string, unknown>>): number {
  return positive(place.at("tolerance"), tolerance);
}

function readSolveOptions(value: SolveOptions) {
  const place = new Place("invalid-option", "options");
  const options = fields(place, value, ["maxIterations", "tolerance", "signal", "onProgress"]);
  const { maxIterations = 100, signal, onProgress } = options;
  return {
    tolerance: readTolerance(place, options),
    maxIterations: integer(place.at("maxIterations"), maxIterations, 1, Number.MAX_SAFE_INTEGER),
    signal: readSignal(place.at("signal"), signal),
    onProgress: readCallback<SolveOptions["onProgress"]>(place.at("onProgress"), onProgress),
  };
}
