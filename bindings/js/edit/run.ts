// Runs an edit script over a shape, step by step, and reports what came of it.

import type { FloatArray, Place } from "../boundary/check.js";
import type { Core } from "../boundary/core.js";
import { Deformer, type Step, throwIfAborted } from "../deform/deformer.js";
import { PliantError } from "../boundary/errors.js";
import type { Handle } from "../deform/handle.js";
import { measure } from "../shape/quality.js";
import { selectedIds } from "../shape/selection.js";
import { insideOf, Shape } from "../shape/shape.js";
import type { Refinement, Sketch } from "../deform/sketch.js";
import type { HandleState, State } from "../boundary/state.js";
import { extended, extendedLabels, grown, rows } from "./growth.js";
import { framesOf } from "./keyframes.js";
import { locatedAsync } from "./located.js";
import type { DragPlan, Goal, ScriptPlan, SolverPlan, StepPlan } from "./read.js";
import type { FinishPlan, SketchPlan } from "./sketch_read.js";
import { iterationsOnTheWay, makeSketch, poseSketch, seedSolver, sketchReport, wayTo } from "./sketch_run.js";
import type { SolvePlan } from "./solve.js";
import type { EditOptions, EditProgress, EditQuality, EditReport, EditResult, IterationReport, StepReport } from "./types.js";

/** A finished edit. Its deformers live until `dispose`: other points can still be carried. */
export interface FinishedEdit {
  time: number;
  positions: Float64Array;
  steps: StepReport[];
  quality: EditQuality;
  state: State;
  /** What refinement added to the shape. */
  refinement: Refinement | undefined;
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
  let refinement: Refinement | undefined;
  for await (const edit of runFrames(core, shape, plan, options)) {
    frames.push(insideOf(shape).single ? Float32Array.from(edit.positions) : edit.positions);
    reports.push({ time: edit.time, steps: edit.steps, quality: edit.quality });
    ({ state, refinement } = edit);
  }
  const positions = frames[frames.length - 1];
  const report = reportOf(shape, reports, plan);
  return { positions, report, state: state!, ...(refinement ? { refinement } : {}), ...(plan.frames === undefined ? {} : { frames }) };
}

/** The report of a script from those of its frames. */
export function reportOf(shape: Shape, frames: NonNullable<EditReport["frames"]>, plan: ScriptPlan): EditReport {
  const { steps, quality } = frames[frames.length - 1];
  const report: EditReport = { format: "pliant-report", version: 1, shape: { ...shape.report }, steps, quality };
  return plan.frames === undefined ? report : { ...report, frames };
}

type Report = (progress: Omit<EditProgress, "frame" | "frames">) => void;
type OnStep = (step: Pick<Step, "iteration" | "energy">) => void;

/** What a step has left. */
interface Done {
  /** At rest in this step. */
  shape: Shape;
  positions: Float64Array;
  state(): State;
}

/** One pass over the steps. Each starts from the result of the one before. */
class Run {
  readonly #objects: { dispose(): void }[] = [];
  readonly #carriers: ((points: Float64Array) => void)[] = [];
  #last: Done | undefined;
  #growth: Refinement | undefined;
  /** Of the last sketch step, one a vertex. */
  #labels: Uint32Array | undefined;

  constructor(readonly core: Core, readonly shape: Shape, readonly signal: AbortSignal | undefined, readonly onStep: Report) {}

  async steps(plans: StepPlan[]): Promise<Omit<FinishedEdit, "time" | "dispose">> {
    const reports: StepReport[] = [];
    for (const [step, plan] of plans.entries()) {
      throwIfAborted(this.signal);
      const onStep: OnStep = ({ iteration, energy }) => this.onStep({ step, steps: plans.length, iteration, energy });
      reports.push(await locatedAsync(plan.place, () => ("sketch" in plan ? this.#sketch(plan, onStep) : this.#solver(plan, onStep))));
    }
    const { shape, positions, state: save } = this.#last!;
    const state = this.#grownState(save(), shape);
    const quality: EditQuality = {
      ...measure(this.core, this.#measured(), positions),
      constraintError: constraintError(state.handles, positions, this.shape),
    };
    const carry = (points: Float64Array) => this.#carriers.forEach((carrier) => carrier(points));
    return { positions, steps: reports, quality, state, refinement: this.#growth, carry };
  }

  dispose(): void {
    for (const object of this.#objects.splice(0)) object.dispose();
  }

  async #solver(plan: SolverPlan, onStep: OnStep): Promise<StepReport> {
    const begin = performance.now();
    const shape = this.#restShape();
    const { fixed, handles: lists } = resolve(plan, insideOf(shape).rest);
    const deformer = this.#own(new Deformer(this.core, shape, plan.options));
    deformer.setFixed(fixed);
    const handles = lists.map((ids) => deformer.addHandle(ids));
    handles.forEach((handle, i) => reach(handle, plan.handles[i].goal, shape.dimension));
    const report = await this.#solved(deformer, plan, plan.iterations, performance.now() - begin, onStep);
    const drag = [];
    for (const entry of plan.drag) drag.push(await this.#drag(deformer, handles, plan, entry, onStep));
    this.#finished(deformer);
    const { total, terms } = deformer.energy();
    return drag.length > 0 ? { ...report, energy: { total, ...terms }, drag } : report;
  }

  async #solved(deformer: Deformer, plan: SolvePlan, maxIterations: number, setupMs: number, onStep: OnStep): Promise<StepReport> {
    const start = deformer.energy().total;
    const solve = await this.#solve(deformer, plan, maxIterations, onStep);
    const { total, terms } = deformer.energy();
    return { method: deformer.method, ...deformer.counters(), setupMs, start, ...solve, energy: { total, ...terms } };
  }

  async #solve(deformer: Deformer, { tolerance }: SolvePlan, maxIterations: number, onStep: OnStep) {
    const iterations: IterationReport[] = [];
    const onProgress = (step: Step) => {
      if (step.accepted) iterations.push({ energy: step.energy, ms: step.milliseconds });
      onStep(step);
    };
    const { converged } = await deformer.solve({ maxIterations, tolerance, signal: this.signal, onProgress });
    return { iterations, converged };
  }

  async #drag(deformer: Deformer, handles: Handle[], plan: SolverPlan, entry: DragPlan, onStep: OnStep) {
    const before = deformer.counters();
    deformer.setOptions(entry.options);
    for (const { handle, goal } of entry.goals) reach(handles[handle], goal, this.shape.dimension);
    const { iterations } = await this.#solve(deformer, plan, entry.iterations, onStep);
    const after = deformer.counters();
    return {
      factorizations: after.factorizations - before.factorizations,
      analyses: after.analyses - before.analyses,
      iterations,
    };
  }

  /** What a deformer over the current shape came to. */
  #finished(deformer: Deformer): void {
    const { shape } = deformer;
    this.#carriers.push((points) => deformer.transformPoints(points, points));
    this.#last = { shape, positions: deformer.positions(new Float64Array(insideOf(shape).rest.length)), state: () => deformer.state() };
  }

  async #sketch(plan: SketchPlan, onStep: OnStep): Promise<StepReport> {
    const begin = performance.now();
    const shape = this.#restShape();
    const sketch = this.#own(makeSketch(this.core, shape, plan, this.#labels));
    const posing = performance.now();
    const morph = poseSketch(sketch, plan);
    const end = performance.now();
    this.#labels = sketch.labels();
    const report = sketchReport(sketch, plan, posing - begin, end - posing);
    if (plan.finish) return { ...report, finish: await this.#finish(sketch, plan.finish, morph, onStep) };
    onStep({ iteration: 1, energy: 0 });
    const { refinement } = sketch;
    if (refinement) {
      this.#growth = grown(this.#growth, refinement);
      this.#labels = extendedLabels(this.#labels, refinement.parents);
    }
    this.#carriers.push(refuseToCarry);
    const positions = sketch.positions(new Float64Array(3 * sketch.vertices));
    this.#last = { shape, positions, state: () => ({ handles: [], ...sketch.state() }) };
    return report;
  }

  /** A solver goes on from the pose, in parts where it turns far. */
  async #finish(sketch: Sketch, plan: FinishPlan, morph: number, onStep: OnStep): Promise<StepReport> {
    const begin = performance.now();
    const { deformer, reach: reachShare } = seedSolver(this.core, sketch, plan, morph);
    this.#own(deformer);
    let left = plan.iterations;
    for (const share of wayTo(sketch.pose())) {
      reachShare(share);
      const { iterations } = await this.#solve(deformer, plan, Math.min(iterationsOnTheWay, left), onStep);
      left = Math.max(1, left - iterations.length);
    }
    reachShare(1);
    const report = await this.#solved(deformer, plan, left, performance.now() - begin, onStep);
    this.#finished(deformer);
    const solved = this.#last!.state;
    this.#last!.state = () => ({ ...sketch.state(), finish: { method: deformer.method, ...solved() }, handles: solved().handles });
    return report;
  }

  #own<T extends { dispose(): void }>(object: T): T {
    this.#objects.push(object);
    return object;
  }

  /** The result so far, as a shape at rest. */
  #restShape(): Shape {
    return this.#last ? this.#shapeOf(this.#last.positions) : this.shape;
  }

  /** The input at rest, with the vertices that were added. */
  #measured(): Shape {
    return this.#growth ? this.#shapeOf(extended(insideOf(this.shape).rest, 3, this.#growth.parents)) : this.shape;
  }

  #shapeOf(positions: Float64Array): Shape {
    const triangles = this.#growth?.triangles ?? insideOf(this.shape).triangles;
    return this.#own(new Shape(this.core, { positions, triangles, dimension: this.shape.dimension }));
  }

  /** A state that says where all added vertices come from, and where they are at rest in its step. */
  #grownState(state: State, shape: Shape): State {
    if (!this.#growth) return state;
    const { parents } = this.#growth;
    const added = extended(insideOf(shape).rest, 3, parents.subarray(2 * (shape.report.vertices - this.shape.report.vertices)));
    return { ...state, parents: rows(parents, 2), rest: rows(added.subarray(3 * this.shape.report.vertices), 3) };
  }
}

function refuseToCarry(): never {
  throw new PliantError("not-solvable", "sketch moves a surface, not the space around it; expected embedded-graph or another method that carries points");
}

/** The vertices of a step: fixed ones, and those of each handle, ascending; none in two roles. */
function resolve(plan: SolverPlan, rest: Float64Array): { fixed: number[]; handles: Int32Array[] } {
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
