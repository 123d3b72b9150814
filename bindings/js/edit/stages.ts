// The stages of a living edit: which one stands for a step, and which shows the result.

import type { Core } from "../boundary/core.js";
import type { Pin } from "../picture/order.js";
import type { Shape } from "../shape/shape.js";
import type { PlacePlan, SketchPlan, SolverPlan, StepPlan } from "./plan.js";
import { PlaceStage } from "./place_stage.js";
import { Rest } from "./rest.js";
import { pinsOf } from "./roles.js";
import { SketchStage } from "./sketch_stage.js";
import { SolverStage } from "./solver_stage.js";
import { PutAway, Stage } from "./stage.js";
import type { StageMoment, StepReport } from "./types.js";

const makers = {
  solver: (plan: SolverPlan, rest: Rest): Stage => new SolverStage(plan, rest) as Stage,
  sketch: (plan: SketchPlan, rest: Rest): Stage => new SketchStage(plan, rest) as Stage,
  place: (plan: PlacePlan, rest: Rest): Stage => new PlaceStage(plan, rest) as Stage,
};

/** Models that are kept beside the last; earlier ones are made again when they are asked for. */
const kept = 2;

export class Stages {
  readonly input: Rest;
  readonly #stages: (Stage | PutAway)[] = [];
  #front = -1;

  constructor(core: Core, shape: Shape) {
    this.input = Rest.ofInput(core, shape);
  }

  /** The one whose result is shown; none: the input at rest. */
  get last(): Stage | undefined {
    return this.#front < 0 ? undefined : this.#open(this.#front);
  }

  /** Where those up to the last one are, and what they have done. */
  moments(): { plan: StepPlan; moment: StageMoment }[] {
    return this.#shown.map((stage) =>
      stage instanceof PutAway ? stage : { plan: stage.standsFor, moment: stage.moment() },
    );
  }

  reports(): StepReport[] {
    return this.#shown.map((stage) => (stage instanceof PutAway ? stage.report : stage.report()));
  }

  /** Of the last one that says what lies in front; none: nothing does. */
  pins(): Pin[] {
    const pins = this.#shown.map((stage) =>
      stage instanceof PutAway ? pinsOf(stage.plan, stage.rest) : pinsOf(stage.standsFor, stage.standsOver));
    return pins.findLast((own) => own.length > 0) ?? [];
  }

  /** Carries points and their normals through all of them, in place. */
  carry(points: Float64Array, normals?: Float64Array): void {
    for (let at = 0; at <= this.#front; ++at) this.#open(at).carry(points, normals);
  }

  /** The stage of a step, over the result of the one before; those after it wait. Errors: then nothing has changed. */
  prepared(at: number, plan: StepPlan): { stage: Stage | PutAway; changed: boolean } {
    const rest = this.#restOf(at);
    const old = this.#stages[at];
    if (old?.isAt(plan, rest)) return { stage: old, changed: false };
    const standing = old instanceof PutAway && old.rest !== rest ? undefined : old && this.#open(at);
    if (!standing?.carries(plan)) return { stage: this.#replace(at, make(plan, rest)), changed: true };
    const changed = standing.prepare(plan, rest);
    if (changed) this.#front = at;
    return { stage: standing, changed };
  }

  /** Takes the stages to where they were at a moment. */
  bringBack(stood: readonly { plan: StepPlan; moment: StageMoment }[]): void {
    stood.forEach(({ plan, moment }, at) => {
      const rest = this.#restOf(at);
      const old = this.#stages[at];
      this.#front = at;
      if (old instanceof PutAway && old.moment === moment && old.isAt(plan, rest)) return;
      const standing = old && this.#open(at);
      const stage = standing?.carries(plan) ? standing : this.#replace(at, make(plan, rest));
      stage.goTo(plan, rest, moment);
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
    for (const stage of this.#stages.splice(count)) if (!(stage instanceof PutAway)) stage.dispose();
  }

  reset(): void {
    if (this.#stages.length > 0) this.#open(0).reset(); // which gives those after it another rest shape
    this.#front = Math.min(this.#front, 0);
  }

  get #shown(): readonly (Stage | PutAway)[] {
    return this.#stages.slice(0, this.#front + 1);
  }

  #restOf(at: number): Rest {
    if (at === 0) return this.input;
    const before = this.#stages[at - 1];
    return before instanceof PutAway ? before.next : before.next();
  }

  #open(at: number): Stage {
    const stage = this.#stages[at];
    if (!(stage instanceof PutAway)) return stage;
    const made = make(stage.plan, stage.rest);
    made.resume(stage);
    return (this.#stages[at] = made);
  }

  #replace(at: number, stage: Stage): Stage {
    const old = this.#stages[at];
    if (old instanceof PutAway) stage.inherit(old.report);
    if (old instanceof Stage) old.dispose();
    this.#stages[at] = stage;
    this.#front = at;
    this.#stages.slice(0, Math.max(0, at - kept)).forEach((before, i) => {
      if (before instanceof Stage && before.done) this.#stages[i] = before.putAway();
    });
    return stage;
  }
}

function make(plan: StepPlan, rest: Rest): Stage {
  return makers[plan.kind](plan as never, rest);
}
