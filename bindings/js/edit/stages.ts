// The stages of a living edit: which one stands for a step, and which shows the result.

import type { Core } from "../boundary/core.js";
import type { Shape } from "../shape/shape.js";
import type { PlacePlan, SketchPlan, SolverPlan, StepPlan } from "./plan.js";
import { PlaceStage } from "./place_stage.js";
import { Rest } from "./rest.js";
import { SketchStage } from "./sketch_stage.js";
import { SolverStage } from "./solver_stage.js";
import type { Stage, StageMoment } from "./stage.js";

const makers = {
  solver: (plan: SolverPlan, rest: Rest): Stage => new SolverStage(plan, rest) as Stage,
  sketch: (plan: SketchPlan, rest: Rest): Stage => new SketchStage(plan, rest) as Stage,
  place: (plan: PlacePlan, rest: Rest): Stage => new PlaceStage(plan, rest) as Stage,
};

export class Stages {
  readonly input: Rest;
  readonly #stages: Stage[] = [];
  #front = -1;

  constructor(core: Core, shape: Shape) {
    this.input = Rest.ofInput(core, shape);
  }

  /** Those up to the one whose result is shown; none: the input at rest. */
  get shown(): readonly Stage[] {
    return this.#stages.slice(0, this.#front + 1);
  }

  get last(): Stage | undefined {
    return this.#stages[this.#front];
  }

  /** The stage of a step, over the result of the one before; those after it wait. Errors: then nothing has changed. */
  prepared(at: number, plan: StepPlan): { stage: Stage; changed: boolean } {
    const old = this.#stages[at];
    const rest = this.#restOf(at);
    if (old?.carries(plan)) {
      const changed = old.prepare(plan, rest);
      if (changed) this.#front = at;
      return { stage: old, changed };
    }
    return { stage: this.#replace(at, make(plan, rest)), changed: true };
  }

  /** Takes the stages to where they were at a moment. */
  bringBack(stood: readonly { plan: StepPlan; moment: StageMoment }[]): void {
    stood.forEach(({ plan, moment }, at) => {
      const rest = this.#restOf(at);
      if (!this.#stages[at]?.carries(plan)) this.#replace(at, make(plan, rest));
      this.#stages[at].goTo(plan, rest, moment);
      this.#front = at;
    });
    this.#front = stood.length - 1;
  }

  /** Whether nothing is left to do for these steps. */
  done(plans: readonly StepPlan[]): boolean {
    return this.#stages.length === plans.length && plans.every((plan, at) => {
      const stage = this.#stages[at];
      return stage !== undefined && stage.isAt(plan, this.#restOf(at)) && stage.done;
    });
  }

  /** This one's result is shown from now on. */
  show(at: number): void {
    this.#front = at;
  }

  /** Nothing comes after so many. */
  end(count: number): void {
    this.#front = count - 1;
    for (const stage of this.#stages.splice(count)) stage.dispose();
  }

  reset(): void {
    for (const stage of this.#stages) stage.reset();
    this.#front = Math.min(this.#front, 0);
  }

  #restOf(at: number): Rest {
    return at === 0 ? this.input : this.#stages[at - 1].next();
  }

  #replace(at: number, stage: Stage): Stage {
    this.#stages[at]?.dispose();
    this.#stages[at] = stage;
    this.#front = at;
    return stage;
  }
}

function make(plan: StepPlan, rest: Rest): Stage {
  return makers[plan.kind](plan as never, rest);
}
