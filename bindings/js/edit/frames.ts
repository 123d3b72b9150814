// The edits of a script, frame by frame, over one living edit.

import type { FloatArray } from "../boundary/check.js";
import type { Core } from "../boundary/core.js";
import type { State } from "../boundary/state.js";
import type { Refinement } from "../deform/sketch.js";
import type { Pin } from "../picture/order.js";
import { insideOf, type Shape } from "../shape/shape.js";
import { framesOf } from "./keyframes.js";
import { Edit } from "./living.js";
import type { ScriptPlan } from "./plan.js";
import type { EditOptions, EditQuality, EditReport, EditResult, StepReport } from "./types.js";

/** A finished edit, until the next frame is asked for. */
export interface FinishedEdit {
  time: number;
  positions: Float64Array;
  steps: StepReport[];
  quality: EditQuality;
  state: State;
  /** What refinement added to the shape. */
  refinement: Refinement | undefined;
  /** How far in front each vertex lies, where handles say so. */
  depths: Float64Array | undefined;
  /** Carries points, in coordinates of the shape at rest, and turns their normals through all steps; in place. */
  carry(points: Float64Array, normals?: Float64Array): void;
}

/**
 * Each frame is finished before the next begins, and begins at rest over what is built already: it is what its steps
 * alone give, whatever the frames before it were, to the last bit.
 */
export async function* runFrames(
  core: Core, shape: Shape, plan: ScriptPlan, { signal, onProgress }: EditOptions,
): AsyncGenerator<FinishedEdit> {
  const frames = plan.frames ?? 1;
  const edit = new Edit(core, shape);
  try {
    let [frame, before]: [number, StepReport[]] = [0, []];
    for (const { time, steps } of framesOf(plan)) {
      edit.reset();
      edit.applyPlans(steps);
      await edit.settle({ signal, onProgress: (progress) => onProgress?.({ frame, frames, ...progress }) });
      const report = edit.report();
      const positions = edit.positions(new Float64Array(shape.dimension * edit.vertices));
      yield {
        time, positions, steps: report.steps.map((step, i) => since(before[i], step)), quality: report.quality,
        state: edit.state(), refinement: edit.refinement(), depths: await depthsOf(shape, edit.pins()),
        carry: (points, normals) => edit.carry(points, normals),
      };
      [frame, before] = [frame + 1, report.steps];
    }
  } finally {
    edit.dispose();
  }
}

/** Of every vertex of a shape in the plane; undefined without pins. */
async function depthsOf(shape: Shape, pins: readonly Pin[]): Promise<Float64Array | undefined> {
  if (pins.length === 0) return undefined;
  const { rest, triangles } = insideOf(shape);
  const { spreadDepths } = await import("../picture/order.js");
  return spreadDepths(rest, shape.dimension, triangles, pins);
}

/** A report of one frame: costs count from the one before on. */
function since(before: StepReport | undefined, step: StepReport): StepReport {
  if (!before) return step;
  const { factorizations, analyses, setupMs } = before;
  const own = {
    ...step,
    factorizations: step.factorizations - factorizations,
    analyses: step.analyses - analyses,
    setupMs: step.setupMs - setupMs,
  };
  return step.finish && before.finish ? { ...own, finish: since(before.finish, step.finish) } : own;
}

/** Everything at once, as `pliant.edit` gives it. */
export async function runScript(core: Core, shape: Shape, plan: ScriptPlan, options: EditOptions): Promise<EditResult> {
  const frames: FloatArray[] = [];
  const reports: NonNullable<EditReport["frames"]> = [];
  let last: FinishedEdit | undefined;
  for await (const edit of runFrames(core, shape, plan, options)) {
    frames.push(insideOf(shape).single ? Float32Array.from(edit.positions) : edit.positions);
    reports.push({ time: edit.time, steps: edit.steps, quality: edit.quality });
    last = edit;
  }
  const { state, refinement, depths } = last!;
  return {
    positions: frames[frames.length - 1], report: reportOf(shape, reports, plan), state,
    ...(refinement ? { refinement } : {}), ...(depths ? { depths } : {}),
    ...(plan.frames === undefined ? {} : { frames }),
  };
}

/** The report of a script from those of its frames. */
export function reportOf(shape: Shape, frames: NonNullable<EditReport["frames"]>, plan: ScriptPlan): EditReport {
  const { steps, quality } = frames[frames.length - 1];
  const report: EditReport = { format: "pliant-report", version: 1, shape: { ...shape.report }, steps, quality };
  return plan.frames === undefined ? report : { ...report, frames };
}
