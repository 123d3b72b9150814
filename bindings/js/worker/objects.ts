// The objects of pliant/worker: as those of the package, but every call is a promise.

import { type FloatArray, Place, vertexIds } from "../boundary/check.js";
import type { Counters, Deformer, Solution, SolveOptions, Step, StepOptions } from "../deform/deformer.js";
import type { DeformerOptions, LiveOptions, MethodName } from "../methods/index.js";
import type { MeasureOptions, Quality } from "../shape/quality.js";
import type { EditOptions, EditResult, EditScript } from "../edit/types.js";
import type { Selection } from "../shape/selection.js";
import type { ShapeInput, ShapeReport } from "../shape/shape.js";
import type { SketchOptions } from "../deform/sketch.js";
import type { State } from "../boundary/state.js";
import type { Transform } from "../shape/transform.js";
import { disposeSymbol } from "../boundary/core.js";
import { Remote } from "./remote.js";
import { WorkerSketch } from "./sketch.js";
import type { Line } from "./line.js";
import type { Reference } from "./protocol.js";

/** See {@link Pliant}. */
export class WorkerPliant extends Remote {
  async shape(input: ShapeInput): Promise<WorkerShape> {
    return new WorkerShape(this.line, await this.call<Reference>("shape", input));
  }

  async deformer<M extends MethodName>(shape: WorkerShape, options: { method: M } & DeformerOptions<M>): Promise<WorkerDeformer<M>> {
    return new WorkerDeformer(this.line, await this.call<Reference>("deformer", shape, options), shape);
  }

  async sketch(shape: WorkerShape, options: SketchOptions): Promise<WorkerSketch> {
    return new WorkerSketch(this.line, await this.call<Reference>("sketch", shape, options), shape);
  }

  measure(shape: WorkerShape, positions: ArrayLike<number>, options?: MeasureOptions): Promise<Quality> {
    return this.call("measure", shape, positions, options);
  }

  edit(shape: WorkerShape, script: EditScript, options: EditOptions = {}): Promise<EditResult> {
    return this.callWith("edit", options, shape, script);
  }

  /** Ends the worker. Every later call, on any object of it, is a `disposed` error. */
  dispose(): void {
    this.line.close("the worker is disposed; expected a live one");
  }

  [disposeSymbol](): void {
    this.dispose();
  }
}

/** See {@link Shape}. */
export class WorkerShape extends Remote {
  readonly report: Readonly<ShapeReport>;
  readonly dimension: 2 | 3;
  readonly diagonal: number;

  /** @internal */
  constructor(line: Line, reference: Reference) {
    super(line, reference);
    const { report, dimension, diagonal } = reference.shape!;
    this.report = Object.freeze(report);
    this.dimension = dimension;
    this.diagonal = diagonal;
  }

  select(selection: Selection): Promise<Uint32Array> {
    return this.call("select", selection);
  }

  dispose(): Promise<void> {
    return this.call("dispose");
  }
}

/** See {@link Deformer}. */
export class WorkerDeformer<M extends MethodName = MethodName> extends Remote {
  readonly shape: WorkerShape;
  readonly method: M;

  /** @internal */
  constructor(line: Line, reference: Reference, shape: WorkerShape) {
    super(line, reference);
    this.shape = shape;
    this.method = reference.method as M;
  }

  async setFixed(vertices: Iterable<number>): Promise<void> {
    return this.call("setFixed", this.#ids("fixed", vertices));
  }

  async addHandle(vertices: Iterable<number>): Promise<WorkerHandle> {
    const ids = this.#ids("vertices", vertices);
    return new WorkerHandle(this.line, await this.call<Reference>("addHandle", ids), ids);
  }

  setOptions(options: LiveOptions[M]): Promise<void> {
    return this.call("setOptions", options);
  }

  step(options: StepOptions = {}): Promise<Step> {
    return this.call("step", options);
  }

  solve(options: SolveOptions = {}): Promise<Solution> {
    return this.callWith("solve", options);
  }

  energy(): Promise<ReturnType<Deformer["energy"]>> {
    return this.call("energy");
  }

  counters(): Promise<Counters> {
    return this.call("counters");
  }

  positions(): Promise<Float32Array>;
  positions<T extends FloatArray>(out: T): Promise<T>;
  positions(out?: FloatArray): Promise<FloatArray> {
    return this.callInto(out, "positions");
  }

  normals(): Promise<Float32Array>;
  normals<T extends FloatArray>(out: T): Promise<T>;
  normals(out?: FloatArray): Promise<FloatArray> {
    return this.callInto(out, "normals");
  }

  field(): Promise<Float32Array> {
    return this.call("field");
  }

  transformPoints(points: Float32Array): Promise<Float32Array>;
  transformPoints(points: ArrayLike<number>): Promise<Float64Array>;
  transformPoints<T extends FloatArray>(points: ArrayLike<number>, out: T): Promise<T>;
  transformPoints(points: ArrayLike<number>, out?: FloatArray): Promise<FloatArray> {
    return this.callInto(out, "transformPoints", points);
  }

  state(): Promise<State> {
    return this.call("state");
  }

  restore(state: State): Promise<void> {
    return this.call("restore", state);
  }

  reset(): Promise<void> {
    return this.call("reset");
  }

  dispose(): Promise<void> {
    return this.call("dispose");
  }

  /** An iterable does not travel. */
  #ids(name: string, vertices: Iterable<number>): Int32Array {
    return vertexIds(new Place("invalid-handle", name), vertices, this.shape.report.vertices);
  }
}

/** See {@link Handle}. */
export class WorkerHandle extends Remote {
  readonly #vertices: Int32Array;

  /** @internal */
  constructor(line: Line, reference: Reference, vertices: Int32Array) {
    super(line, reference);
    this.#vertices = vertices;
  }

  get vertices(): Uint32Array {
    return Uint32Array.from(this.#vertices);
  }

  move(transform: Transform): Promise<void> {
    return this.call("move", transform);
  }

  moveTo(targets: ArrayLike<number>): Promise<void> {
    return this.call("moveTo", targets);
  }

  remove(): Promise<void> {
    return this.call("remove");
  }
}
