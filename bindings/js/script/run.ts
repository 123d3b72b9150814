// Runs an edit script over a shape, step by step, and reports what came of it.

import type { FloatArray, Place } from "../check.js";
import type { Core } from "../core.js";
import { Deformer, type Step, throwIfAborted } from "../deformer.js";
import { PliantError } from "../errors.js";
import type { Handle } from "../handle.js";
import { measure } from "../quality.js";
import { selectedIds } from "../selection.js";
import { insideOf, Shape } from "../shape.js";
import type { HandleState, State } from "../state.js";
import { framesOf } from "./keyframes.js";
import type { DragPlan, Goal, ScriptPlan, StepPlan } from "./read.js";
import type { EditOptions, EditProgress, EditQuality, EditReport, EditResult, IterationReport, StepReport } from "./types.js";

/** A finished edit. Its deformers live until `dispose`: other points can still be carried. */
export interface FinishedEdit {
  time: number;
  positions: Float64Array;
  steps: StepReport[];
  quality: EditQuality;
  state: State;
  /** Carries points, in coordinates of the shape at rest, through all steps; in place. */
  carry(points: Float64Array): void;
  dispose(): void;
}

/** The edits of a script, one a frame, each finished before the next begins. */
export async function* runFrames(core: Core, shape: Shape, plan: ScriptPlan, options: EditOptions): AsyncGenerator<FinishedEdit> {
  const frames = plan.frames ?? 1;
  let frame = 0;
  for (const { time, steps } of framesOf(plan)) {
    const onStep: Report = (progress) => options.onProgress?.({ frame, frames, ...progress });
    const run = new Run(core, shape, options.signal, onStep);
    try {
      yield { time, ...(await run.steps(steps)), dispose: () => run.dispose() };
    } finally {
      run.dispose();
    }
    ++frame;
  }
}

/** Everything at once, as `pliant.edit` gives it. */
export async function runScript(core: Core, shape: Shape, plan: ScriptPlan, options: EditOptions): Promise<EditResult> {
  const frames: FloatArray[] = [];
  const reports: NonNullable<EditReport["frames"]> = [];
  let state: State | undefined;
  for await (const edit of runFrames(core, shape, plan, options)) {
    frames.push(insideOf(shape).single ? Float32Array.from(edit.positions) : edit.positions);
    reports.push({ time: edit.time, steps: edit.steps, quality: edit.quality });
    state = edit.state;
  }
  const positions = frames[frames.length - 1];
  const report = reportOf(shape, reports, plan);
  return { positions, report, state: state!, ...(plan.frames === undefined ? {} : { frames }) };
}

/** The report of a script from those of its frames. */
export function reportOf(shape: Shape, frames: NonNullable<EditReport["frames"]>, plan: ScriptPlan): EditReport {
  const { steps, quality } = frames[frames.length - 1];
  const report: EditReport = { format: "pliant-report", version: 1, shape: { ...shape.report }, steps, quality };
  return plan.frames === undefined ? report : { ...report, frames };
}

type Report = (progress: Omit<EditProgress, "frame" | "frames">) => void;

/** One pass over the steps. Each makes a deformer over the result of the one before. */
class Run {
  readonly #shapes: Shape[] = [];
  readonly #deformers: Deformer[] = [];

  constructor(readonly core: Core, readonly shape: Shape, readonly signal: AbortSignal | undefined, readonly onStep: Report) {}

  async steps(plans: StepPlan[]): Promise<Omit<FinishedEdit, "time" | "dispose">> {
    const reports: StepReport[] = [];
    for (const [step, plan] of plans.entries()) {
      throwIfAborted(this.signal);
      const onStep = ({ iteration, energy }: Step) => this.onStep({ step, steps: plans.length, iteration, energy });
      reports.push(await located(plan.place, () => this.#step(plan, onStep)));
    }
    const last = this.#deformers[this.#deformers.length - 1];
    const positions = this.#positions(last);
    const state = last.state();
    const quality: EditQuality = {
      ...measure(this.core, this.shape, positions),
      constraintError: constraintError(state.handles, positions, this.shape),
    };
    const carry = (points: Float64Array) => this.#deformers.forEach((deformer) => deformer.transformPoints(points, points));
    return { positions, steps: reports, quality, state, carry };
  }

  dispose(): void {
    for (const object of [...this.#deformers.splice(0), ...this.#shapes.splice(0)]) object.dispose();
  }

  async #step(plan: StepPlan, onStep: (step: Step) => void): Promise<StepReport> {
    const begin = performance.now();
    const shape = this.#restShape();
    const { fixed, handles: lists } = resolve(plan, insideOf(shape).rest);
    const deformer = new Deformer(this.core, shape, plan.options);
    this.#deformers.push(deformer);
    deformer.setFixed(fixed);
    const handles = lists.map((ids) => deformer.addHandle(ids));
    handles.forEach((handle, i) => reach(handle, plan.handles[i].goal, shape.dimension));
    const setupMs = performance.now() - begin;
    const start = deformer.energy().total;
    const solve = await this.#solve(deformer, plan, plan.iterations, onStep);
    const { unknowns, factorizations, analyses } = deformer.counters();
    const drag = [];
    for (const entry of plan.drag) drag.push(await this.#drag(deformer, handles, plan, entry, onStep));
    const { total, terms } = deformer.energy();
    const report: StepReport = {
      method: deformer.method, unknowns, factorizations, analyses, setupMs, start, ...solve, energy: { total, ...terms },
    };
    return drag.length > 0 ? { ...report, drag } : report;
  }

  async #solve(deformer: Deformer, { tolerance }: StepPlan, maxIterations: number, onStep: (step: Step) => void) {
    const iterations: IterationReport[] = [];
    const onProgress = (step: Step) => {
      if (step.accepted) iterations.push({ energy: step.energy, ms: step.milliseconds });
      onStep(step);
    };
    const { converged } = await deformer.solve({ maxIterations, tolerance, signal: this.signal, onProgress });
    return { iterations, converged };
  }

  async #drag(deformer: Deformer, handles: Handle[], plan: StepPlan, entry: DragPlan, onStep: (step: Step) => void) {
    const before = deformer.counters();
    for (const { handle, goal } of entry.goals) reach(handles[handle], goal, this.shape.dimension);
    const { iterations } = await this.#solve(deformer, plan, entry.iterations, onStep);
    const after = deformer.counters();
    return {
      factorizations: after.factorizations - before.factorizations,
      analyses: after.analyses - before.analyses,
      iterations,
    };
  }

  /** The result so far, as a shape at rest. */
  #restShape(): Shape {
    const last = this.#deformers[this.#deformers.length - 1];
    if (!last) return this.shape;
    const { triangles } = insideOf(this.shape);
    const shape = new Shape(this.core, { positions: this.#positions(last), triangles, dimension: this.shape.dimension });
    this.#shapes.push(shape);
    return shape;
  }

  #positions(deformer: Deformer): Float64Array {
    return deformer.positions(new Float64Array(this.shape.report.vertices * this.shape.dimension));
  }
}

/** The vertices of a step: fixed ones, and those of each handle, ascending; none in two roles. */
function resolve(plan: StepPlan, rest: Float64Array): { fixed: number[]; handles: Int32Array[] } {
  const roles = new Map<number, Place>();
  for (const { place, select } of plan.fixed) {
    for (const id of selectedIds(place, select, rest)) roles.set(id, place);
  }
  const fixed = [...roles.keys()].sort((a, b) => a - b);
  const handles = plan.handles.map(({ place, select }) => {
    const ids = selectedIds(place.at("select"), select, rest);
    for (const id of ids) {
      const other = roles.get(id);
      if (other) place.at("select").reject(`holds vertex ${id}, as ${other.path} does; expected a vertex to be fixed or moved by one handle`);
      roles.set(id, place.at("select"));
    }
    return ids;
  });
  return { fixed, handles };
}

function reach(handle: Handle, goal: Goal | undefined, dimension: number): void {
  if (!goal) return;
  if ("move" in goal) {
    handle.move(goal.move);
    return;
  }
  const vertices = handle.vertices.length;
  const given = goal.targets.length / dimension;
  if (given !== vertices) goal.place.reject(`has ${given} points; expected ${vertices}, one a selected vertex`);
  handle.moveTo(goal.targets);
}

/** Errors that a script's values bring out in the deformer, as errors of the script. */
async function located<T>(place: Place, work: () => Promise<T>): Promise<T> {
  try {
    return await work();
  } catch (error) {
    const ofValues = error instanceof PliantError && ["invalid-option", "invalid-handle", "invalid-shape"].includes(error.code);
    if (!ofValues) throw error;
    throw new PliantError("invalid-script", `${place.path}: ${error.message}`, { cause: error });
  }
}

/** Largest distance of a handle's vertex from its target over the diagonal. */
function constraintError(handles: HandleState[], positions: Float64Array, { dimension, diagonal }: Shape): number {
  let largest = 0;
  for (const { vertices, targets } of handles) {
    vertices.forEach((vertex, i) => {
      const apart = targets[i].slice(0, dimension).map((x, axis) => x - positions[vertex * dimension + axis]);
      largest = Math.max(largest, Math.hypot(...apart));
    });
  }
  return diagonal > 0 ? largest / diagonal : largest;
}
