// The living edit: an immutable document, and what stands of it. The one interpreter of edit scripts.

import { type Fields, fields, type FloatArray, integer, list, notNegative, output, Place } from "../boundary/check.js";
import { type Core, disposeSymbol } from "../boundary/core.js";
import { PliantError } from "../boundary/errors.js";
import type { HandleState, State } from "../boundary/state.js";
import { eventLoopTurn, readCallback, readSignal, throwIfAborted } from "../boundary/task.js";
import { readNormals, readPoints } from "../deform/carried.js";
import type { Refinement } from "../deform/sketch.js";
import type { Pin } from "../picture/order.js";
import { surfaceNormals } from "../shape/normals.js";
import { measure } from "../shape/quality.js";
import { extentOf, insideOf, Shape } from "../shape/shape.js";
import { Followers } from "./follow.js";
import { extended, rows } from "./growth.js";
import { located } from "./located.js";
import type { StepPlan } from "./plan.js";
import { type Plans, readDocument } from "./read.js";
import type { Rest } from "./rest.js";
import { checkedParts, checkedRoles } from "./roles.js";
import { same } from "./same.js";
import { SketchStage } from "./sketch_stage.js";
import { PutAway } from "./stage.js";
import type { StageMoment } from "./types.js";
import { Stages } from "./stages.js";
import type {
  EditDocument, EditMoment, EditQuality, EditReport, EditRun, EditStep, RunOptions, SettleOptions, SketchView,
} from "./types.js";

const momentFormat = "pliant-moment";
const place = new Place("invalid-option", "options");
const runKeys = ["milliseconds", "iterations"];

/** What has been asked for. */
interface Asked extends Plans {
  document: EditDocument | undefined;
}

const nothing: Asked = { document: undefined, plans: [], seed: undefined };

/**
 * Made by `pliant.open`. A document is a value: hand over another one to get another result. What differs from
 * what stands decides what it costs; the newest document wins over one that has not been carried out yet.
 */
export class Edit {
  readonly shape: Shape;
  readonly #core: Core;
  #stages: Stages | undefined;
  #asked = nothing;

  /** @internal */
  constructor(core: Core, shape: Shape) {
    this.#core = core;
    this.shape = shape;
    this.#stages = new Stages(core, shape);
  }

  get #live(): Stages {
    if (this.#stages) return this.#stages;
    throw new PliantError("disposed", "this edit is disposed; expected a live one");
  }

  // -- What is asked for. ---------------------------------------------------------------------------

  /**
   * The document to carry out; or a moment, which comes back at once and exactly. Errors: invalid-script, by all that
   * can be told without solving; then nothing has changed.
   */
  apply(document: EditDocument | EditMoment): void {
    const stages = this.#live;
    if (isMoment(document)) return this.#goTo(document);
    if (same(document, this.#asked.document)) return;
    const asked = this.#read(document);
    judge(asked.plans[0], stages.input);
    this.#asked = asked;
  }

  /** Steps that are read already. @internal */
  applyPlans(plans: readonly StepPlan[]): void {
    judge(plans[0], this.#live.input);
    this.#asked = { document: undefined, plans, seed: undefined };
  }

  /** Back to rest, with everything that is built; `run` carries the document out again from there. */
  reset(): void {
    this.#live.reset();
  }

  /** The document and how far it has been carried out: plain data. Moments of one edit share what has not changed. */
  moment(): EditMoment {
    const stages = this.#live.moments().map(({ moment }) => moment);
    return { format: momentFormat, version: 1, document: this.#asked.document, stages };
  }

  #read(document: EditDocument): Asked {
    return { document, ...readDocument(document, extentOf(this.shape), this.#asked) };
  }

  #goTo(moment: EditMoment): void {
    const { asked, stood, stages } = this.#readMoment(moment);
    const before = this.#live.moments();
    try {
      this.#live.bringBack(stages.map((stage, at) => ({ plan: stood[at], moment: stage })));
    } catch (error) {
      this.#live.bringBack(before);
      throw error;
    }
    this.#asked = asked;
  }

  #readMoment(value: EditMoment): { asked: Asked; stood: readonly StepPlan[]; stages: readonly StageMoment[] } {
    const here = new Place("invalid-script", "moment");
    const known = ["format", "version", "document", "stages"];
    const { version, document, stages } = fields(here, value, known) as Partial<EditMoment>;
    if (version !== 1) here.at("version").fail(version, "1");
    const moments = Array.from(list(here.at("stages"), stages), (stage, i) =>
      readStage(here.at("stages").item(i), stage),
    );
    if (document === undefined && moments.length === 0) return { asked: nothing, stood: [], stages: moments };
    const asked = this.#read(document as EditDocument);
    const sources = moments.map(({ source }) => source);
    const standing = sources.every((source, at) => same(source, asked.plans[at]?.source));
    if (standing) return { asked, stood: asked.plans, stages: moments };
    const stood = this.#read({ ...(document as EditDocument), steps: sources as EditDocument["steps"] }).plans;
    return { asked, stood, stages: moments };
  }

  // -- Carrying it out. -----------------------------------------------------------------------------

  /**
   * Solves on: for so long, so many iterations, or to the end. At least one iteration, and no more than one beyond the
   * time; building a step that takes all the time is a run of its own, with no iteration. Errors: invalid-script for
   * what only the result of earlier steps brings out, not-solvable, too-large; the last good result stays.
   */
  run(options: RunOptions = {}): EditRun {
    return this.#run(readRun(fields(place, options, runKeys)));
  }

  #run({ milliseconds, iterations }: Required<RunOptions>): EditRun {
    const begin = performance.now();
    const late = (more = 0) => performance.now() - begin + more > milliseconds;
    let [last, count]: [EditStep | undefined, number] = [undefined, 0];
    for (let more = true; more && count < iterations; ) {
      const step = this.#advance(late);
      if (step) [last, count] = [step, count + 1];
      more = step !== undefined && !late(step.milliseconds);
    }
    const converged = this.#live.done(this.#asked.plans);
    return { ...(last ?? this.#standing()), iterations: count, converged, milliseconds: performance.now() - begin };
  }

  /**
   * One iteration of the first step that has something to do; undefined: none has, or building it took all the time.
   */
  #advance(late: () => boolean): EditStep | undefined {
    const stages = this.#live;
    for (const [at, plan] of this.#asked.plans.entries()) {
      const { stage, changed } = located(plan.place, () => stages.prepared(at, plan));
      if (stage instanceof PutAway || stage.done) continue;
      if (changed && late()) return undefined;
      const step = located(plan.place, () => stage.advance());
      stages.show(at);
      return { ...step, step: at };
    }
    stages.end(this.#asked.plans.length);
    return undefined;
  }

  /** Where nothing is left to do. */
  #standing(): EditStep {
    const { last } = this.#live;
    const { total = 0, ...terms } = last?.energy() ?? {};
    const step = Math.max(0, this.#asked.plans.length - 1);
    const nothing = { iteration: 0, converged: true, accepted: false, milliseconds: 0, entry: -1, done: 0 };
    return { step, energy: total, terms, ...nothing };
  }

  /** Runs to the end and lets the event loop turn after each iteration. Errors: as `run`, aborted. */
  async settle(options: SettleOptions = {}): Promise<EditRun> {
    const given = fields(place, options, ["signal", "onProgress"]);
    const signal = readSignal(place.at("signal"), given.signal);
    const onProgress = readCallback<SettleOptions["onProgress"]>(place.at("onProgress"), given.onProgress);
    for (;;) {
      await eventLoopTurn();
      throwIfAborted(signal);
      const run = this.run({ iterations: 1 });
      if (run.iterations === 0) return run;
      onProgress?.({ step: run.step, steps: this.#asked.plans.length, iteration: run.iteration, energy: run.energy });
    }
  }

  // -- Results. -------------------------------------------------------------------------------------

  /** Vertices of the result: the input's, then those that refinement added. */
  get vertices(): number {
    return this.#live.last?.vertices ?? this.shape.report.vertices;
  }

  /** `shape.dimension` numbers a vertex; a Float64Array for `out` gets them in double. */
  positions(): Float32Array;
  positions<T extends FloatArray>(out: T): T;
  positions(out?: FloatArray): FloatArray {
    const result = this.#output(out, this.shape.dimension);
    const { last } = this.#live;
    if (last) return last.positions(result);
    result.set(insideOf(this.shape).rest);
    return result;
  }

  /** Unit normals, three numbers a vertex. */
  normals(): Float32Array;
  normals<T extends FloatArray>(out: T): T;
  normals(out?: FloatArray): FloatArray {
    const result = this.#output(out, 3);
    const { last, input } = this.#live;
    if (last) return last.normals(result);
    return surfaceNormals(input.positions, input.triangles, input.positions, input.dimension, result);
  }

  #output(out: FloatArray | undefined, width: number): FloatArray {
    const length = width * this.vertices;
    return output(new Place("invalid-option", "out"), out, length, () => new Float32Array(length));
  }

  /** What lies how far in front, by the last step that says so. @internal */
  pins(): Pin[] {
    return this.#live.pins();
  }

  /**
   * Other points, in coordinates of the shape at rest, carried through all steps that stand; single precision in,
   * single out. `out` may be `points`. Errors: not-solvable where a step moves a surface and not the space around it.
   */
  transformPoints(points: Float32Array): Float32Array;
  transformPoints(points: ArrayLike<number>): Float64Array;
  transformPoints<T extends FloatArray>(points: ArrayLike<number>, out: T): T;
  transformPoints(points: ArrayLike<number>, out?: FloatArray): FloatArray {
    const { given, result } = readPoints(points, out, this.shape.dimension);
    const carried = Float64Array.from(given);
    this.carry(carried);
    result.set(carried);
    return result;
  }

  /**
   * Normals of a surface at such points, turned through all steps that stand: see {@link Deformation.transformNormals}.
   */
  transformNormals(points: ArrayLike<number>, normals: Float32Array): Float32Array;
  transformNormals(points: ArrayLike<number>, normals: ArrayLike<number>): Float64Array;
  transformNormals<T extends FloatArray>(points: ArrayLike<number>, normals: ArrayLike<number>, out: T): T;
  transformNormals(points: ArrayLike<number>, normals: ArrayLike<number>, out?: FloatArray): FloatArray {
    const { at, given, result } = readNormals(points, normals, out, this.shape.dimension);
    const turned = Float64Array.from(given);
    this.carry(Float64Array.from(at), turned);
    result.set(turned);
    return result;
  }

  /** Both at once, in place. @internal */
  carry(points: Float64Array, normals?: Float64Array): void {
    this.#live.carry(points, normals);
  }

  /** Of the last step, as in `EditResult`. */
  state(): State {
    const { last } = this.#live;
    if (!last) return { handles: [] };
    const { growth } = last;
    const follow = last.followed();
    const state = { ...last.state(), ...(follow.length > 0 ? { follow } : {}) };
    if (!growth) return state;
    // Where all added vertices come from, and where they are at rest in their step.
    const count = this.shape.report.vertices;
    const rest = extended(last.restPositions, 3, growth.parents.subarray(2 * (last.restPositions.length / 3 - count)));
    return { ...state, parents: rows(growth.parents, 2), rest: rows(rest.subarray(3 * count), 3) };
  }

  /** The limb of the last step, where that is a sketch. */
  sketch(): SketchView | undefined {
    const { last } = this.#live;
    return last instanceof SketchStage ? last.view() : undefined;
  }

  /** What steps have added to the input in all. */
  refinement(): Refinement | undefined {
    return this.#live.last?.growth;
  }

  /** What the steps have done: their costs count from `open` on, their iterations since they last began anew. */
  report(): EditReport {
    const shape = { ...this.shape.report };
    return { format: "pliant-report", version: 1, shape, steps: this.#live.reports(), quality: this.#quality() };
  }

  #quality(): EditQuality {
    const positions = this.positions(new Float64Array(this.shape.dimension * this.vertices));
    const growth = this.refinement();
    const { rest } = insideOf(this.shape);
    const grown = growth && { positions: extended(rest, 3, growth.parents), triangles: growth.triangles };
    const measured = grown ? new Shape(this.#core, grown) : this.shape;
    try {
      const constraintError = errorOf(this.#live.last?.state().handles ?? [], positions, this.shape);
      return { ...measure(this.#core, measured, positions), constraintError };
    } finally {
      if (measured !== this.shape) measured.dispose();
    }
  }

  // -- Life. ----------------------------------------------------------------------------------------

  /** Frees everything that was built; the shape stays. Every later call is a `disposed` error. */
  dispose(): void {
    this.#stages?.end(0);
    this.#stages = undefined;
  }

  [disposeSymbol](): void {
    this.dispose();
  }
}

function readRun({ milliseconds, iterations }: Fields): Required<RunOptions> {
  return {
    milliseconds: milliseconds === undefined ? Infinity : notNegative(place.at("milliseconds"), milliseconds),
    iterations:
      iterations === undefined ? Infinity : integer(place.at("iterations"), iterations, 1, Number.MAX_SAFE_INTEGER),
  };
}

function isMoment(value: unknown): value is EditMoment {
  return typeof value === "object" && value !== null && (value as Fields).format === momentFormat;
}

function readStage(here: Place, value: unknown): StageMoment {
  const { progress } = fields(here, value, ["source", "progress", "shown", "state"]);
  list(here.at("progress"), progress);
  return value as StageMoment;
}

/** What can be told of the first step without building it. */
function judge(plan: StepPlan, rest: Rest): void {
  Followers.of(plan, rest);
  if (plan.kind === "solver") checkedRoles(plan, rest);
  if (plan.kind === "place") checkedParts(plan, rest);
}

/** Largest distance of a handle's vertex from its target over the diagonal. */
function errorOf(handles: HandleState[], positions: Float64Array, { dimension, diagonal }: Shape): number {
  let largest = 0;
  for (const { vertices, targets } of handles) {
    vertices.forEach((vertex, i) => {
      const apart = targets[i].slice(0, dimension).map((x, axis) => x - positions[vertex * dimension + axis]);
      largest = Math.max(largest, Math.hypot(...apart));
    });
  }
  return diagonal > 0 ? largest / diagonal : largest;
}
