// Runs the sketch steps of a script.

import type { Core } from "../boundary/core.js";
import { Deformer } from "../deform/deformer.js";
import type { Shape } from "../shape/shape.js";
import { Sketch, type SketchPose } from "../deform/sketch.js";
import { located } from "./located.js";
import type { FinishPlan, PosePlan, SketchPlan } from "./sketch_read.js";
import type { StepReport } from "./types.js";

/** Largest turn of a limb that a solver is shown in one go, in radians. */
const largestTurn = Math.PI / 3;
export const iterationsOnTheWay = 5;

/** At rest. `labels`: of the sketch step before, for the region "previous". */
export function makeSketch(core: Core, shape: Shape, { place, sketch: options, region }: SketchPlan, labels: Uint32Array | undefined): Sketch {
  if (region === undefined) return new Sketch(core, shape, options);
  if (region === "previous") {
    const taken = labels ?? place.at("region").reject('is "previous", but no sketch step comes before; expected one');
    return new Sketch(core, shape, { ...options, labels: taken });
  }
  const sketch = located(place.at("region"), () => new Sketch(core, shape, { ...options, ...region }));
  try {
    sketch.redraw(options.camera, options.reference);
    return sketch;
  } catch (error) {
    sketch.dispose();
    throw error;
  }
}

/** Poses a sketch and gives the morph it shows. */
export function poseSketch(sketch: Sketch, { place, pose, toward, refine }: SketchPlan): number {
  const show = (plan: PosePlan) => {
    if (plan.bend) located(place.at("bend"), () => sketch.bend(plan.bend!));
    if (plan.degrees !== undefined) located(place.at("twist"), () => sketch.twist(plan.degrees!));
    for (const key of ["scale", "turning", "twistSpeed"] as const) {
      const profile = plan[key];
      if (profile) located(place.at(key), () => sketch[key](profile));
    }
  };
  show(pose);
  let { morph } = pose;
  if (toward) {
    const from = sketch.pose();
    sketch.reset();
    show(toward.pose);
    sketch.setPose(from, sketch.pose(), toward.share);
    morph += toward.share * (toward.pose.morph - morph);
  }
  sketch.morph(morph);
  if (refine) sketch.refine(refine);
  return morph;
}

/** What a sketch has done, as a step of the report. It has no energy; its one solve is that of the smoothing. */
export function sketchReport(sketch: Sketch, { sketch: { smooth = true, mirror } }: SketchPlan, setupMs: number, ms: number): StepReport {
  const systems = smooth ? (mirror ? 2 : 1) : 0;
  const region = sketch.labels().reduce((count, label) => count + Number(label === 1), 0);
  return {
    method: "sketch", unknowns: smooth ? region : 0, factorizations: systems, analyses: systems, setupMs,
    start: 0, iterations: [{ energy: 0, ms }], converged: true, energy: { total: 0 },
    ...(sketch.refinement ? { added: sketch.refinement.parents.length / 2 } : {}),
  };
}

/** A solver over the sketch's shape. `reach`: its handle goes to the seeds of a share of the pose shown. */
export function seedSolver(core: Core, sketch: Sketch, { options, spacing }: FinishPlan, morph: number): { deformer: Deformer; reach(share: number): void } {
  const deformer = new Deformer(core, sketch.shape, options);
  try {
    const seed = () => sketch.seed(spacing === undefined ? {} : { spacing });
    const { fixed, vertices } = seed();
    deformer.setFixed(fixed);
    const handle = deformer.addHandle(vertices);
    const reach = (share: number) => {
      sketch.morph(share * morph);
      handle.moveTo(seed().targets);
    };
    return { deformer, reach };
  } catch (error) {
    deformer.dispose();
    throw error;
  }
}

/** Shares of the pose on the way to it, without the last: in one go a limb may turn so far that a solver takes the short way round. */
export function wayTo({ heading, turns, twist }: SketchPose): number[] {
  let angle = heading;
  let largest = Math.abs(heading);
  for (const turn of turns) largest = Math.max(largest, Math.abs((angle += turn)));
  for (const [, twisted] of twist) largest = Math.max(largest, Math.abs(twisted));
  const parts = Math.ceil(largest / largestTurn);
  return Array.from({ length: Math.max(0, parts - 1) }, (_, i) => (i + 1) / parts);
}
