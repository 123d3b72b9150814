// A solver that goes on from the pose of a sketch, in parts where the pose turns far.

import type { Core } from "../boundary/core.js";
import { Deformer } from "../deform/deformer.js";
import type { Handle } from "../deform/handle.js";
import type { Sketch, SketchPose, SketchSeed } from "../deform/sketch.js";
import type { FinishPlan } from "./plan.js";
import { type Phase, solvedReport, Solving } from "./solving.js";
import type { StageMoment, StepReport } from "./types.js";

/** Largest turn of a limb that a solver is shown in one go, in radians. */
const largestTurn = Math.PI / 3;
const iterationsOnTheWay = 5;

export class Finisher {
  readonly deformer: Deformer;
  readonly #handle: Handle;
  readonly #setupMs: number;
  solving: Solving;

  /** `morph`: of the pose that the sketch shows. */
  constructor(core: Core, readonly sketch: Sketch, public plan: FinishPlan, morph: number) {
    const begin = performance.now();
    this.deformer = new Deformer(core, sketch.shape, plan.options);
    try {
      const { fixed, vertices } = this.#seed();
      this.deformer.setFixed(fixed);
      this.#handle = this.deformer.addHandle(vertices);
    } catch (error) {
      this.deformer.dispose();
      throw error;
    }
    this.solving = new Solving(this.deformer, this.#phases(morph));
    this.#setupMs = performance.now() - begin;
  }

  /** Another pose, from rest: which way round a limb has turned does not depend on poses before. */
  begin(plan: FinishPlan, morph: number): void {
    this.deformer.reset();
    this.plan = plan;
    this.solving = new Solving(this.deformer, this.#phases(morph));
  }

  /** As it was at a moment of the pose that the sketch shows. */
  bringBack(morph: number, { progress, state }: Pick<StageMoment, "progress" | "state">): void {
    const phases = this.#phases(morph);
    if (progress.length > 0) phases[progress.length - 1].begin();
    if (state) this.deformer.restore(state);
    this.solving = new Solving(this.deformer, phases, progress);
  }

  #seed(): SketchSeed {
    const { spacing } = this.plan;
    return this.sketch.seed(spacing === undefined ? {} : { spacing });
  }

  #phases(morph: number): Phase[] {
    const { tolerance, iterations } = this.plan;
    const spent = (before: number) =>
      this.solving.progress.slice(0, before).reduce((sum, phase) => sum + phase.iterations.length, 0);
    const begin = (t: number) => () => {
      this.sketch.morph(t * morph);
      this.#handle.moveTo(this.#seed().targets);
    };
    const way = wayTo(this.sketch.pose());
    const left = (at: number) => Math.max(1, iterations - spent(at));
    const parts = way.map((t, i) => ({
      tolerance, begin: begin(t), get iterations() { return Math.min(iterationsOnTheWay, left(i)); },
    }));
    return [...parts, { tolerance, begin: begin(1), get iterations() { return left(way.length); } }];
  }

  /** Of the pose itself; the way to it counts as setting up. */
  report(): StepReport {
    const { progress, phases } = this.solving;
    const way = progress.slice(0, phases.length - 1).flatMap(({ iterations }) => iterations);
    const ms = way.reduce((sum, iteration) => sum + iteration.ms, this.#setupMs);
    return solvedReport(this.solving, progress[phases.length - 1], ms);
  }
}

/**
 * Shares of the pose on the way to it, but the last: in one go a limb may turn so far that a solver takes the short
 * way.
 */
function wayTo({ heading, turns, twist }: SketchPose): number[] {
  let angle = heading;
  let largest = Math.abs(heading);
  for (const turn of turns) largest = Math.max(largest, Math.abs((angle += turn)));
  for (const [, twisted] of twist) largest = Math.max(largest, Math.abs(twisted));
  const parts = Math.ceil(largest / largestTurn);
  return Array.from({ length: Math.max(0, parts - 1) }, (_, i) => (i + 1) / parts);
}
