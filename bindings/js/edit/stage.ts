// One step of a living edit: a rest shape, what the step builds over it, and what has come of it so far.

import type { FloatArray } from "../boundary/check.js";
import type { State } from "../boundary/state.js";
import type { Step } from "../deform/deformer.js";
import type { Refinement } from "../deform/sketch.js";
import { requireCarries } from "./carry.js";
import { Followers, type Made } from "./follow.js";
import { extendedLabels, grown } from "./growth.js";
import type { StepPlan } from "./plan.js";
import { Rest } from "./rest.js";
import { shared } from "./same.js";
import type { FollowState, StageMoment, StepReport } from "./types.js";

/** One iteration, and of what. */
export interface StageStep extends Step {
  /** The entry of the step's drag, from 0; -1: the step itself. */
  entry: number;
  /** Accepted iterations of it so far. */
  done: number;
}

/** `dimension` numbers a vertex, those of the rest shape and the added ones; unit normals, three numbers a vertex. */
export interface Result {
  positions<T extends FloatArray>(out: T): T;
  normals<T extends FloatArray>(out: T): T;
}

export abstract class Stage<P extends StepPlan = StepPlan> {
  #next: Rest | undefined;
  #saved: StageMoment | undefined;
  /** Whether `#saved` is of now. */
  #stands = false;

  /** What models that stood here before have cost. */
  protected readonly past = { factorizations: 0, analyses: 0 };

  #followers: Followers;

  /** What it stands for and over; both change in `prepare` alone. */
  constructor(protected plan: P, protected rest: Rest) {
    this.#followers = Followers.of(plan, rest);
  }

  abstract readonly method: string;

  /** As `prepare`, without the parts that follow. */
  protected abstract take(plan: P, rest: Rest): boolean;
  /** Nothing is left to do. */
  abstract readonly done: boolean;
  /** One iteration. Errors: the result is then as before. */
  abstract advance(): StageStep;
  /** Back to rest; what is built stays where that changes nothing. */
  abstract reset(): void;

  /** Vertices that refinement added to the rest shape. */
  abstract readonly added: Refinement | undefined;
  /** What the step makes of the vertices, without the parts that follow. */
  protected abstract readonly result: Result;
  /** Whether the step itself says where a vertex is to be. */
  protected abstract guides(): (vertex: number) => boolean;
  /** Of the step alone, as `EditResult.state`. */
  abstract state(): State;
  abstract report(): StepReport;
  /** Carries points of the rest shape's space, and turns their normals, in place. Errors: not-solvable. */
  carry(points: Float64Array, normals?: Float64Array): void {
    requireCarries(this.plan);
    this.takeAlong(points, normals);
  }

  abstract dispose(): void;

  /** As `carry`, by a plan that does. */
  protected abstract takeAlong(points: Float64Array, normals?: Float64Array): void;

  /** How far it has come, and what else it takes to come back. */
  protected abstract save(): Omit<StageMoment, "source">;
  /** As `prepare`, at a moment of the same step over the same rest shape. */
  protected abstract bringBack(plan: P, rest: Rest, moment: StageMoment): void;

  /**
   * Takes the step over a rest shape and keeps what it can; no iteration. Whether anything is different. Errors: then
   * nothing is.
   */
  prepare(plan: P, rest: Rest): boolean {
    const followers = Followers.of(plan, rest, this.#followers);
    const changed = this.take(plan, rest);
    return this.#follow(followers) || changed;
  }

  #follow(followers: Followers): boolean {
    if (followers === this.#followers) return false;
    const other = followers.parts.length > 0 || this.#followers.parts.length > 0;
    this.#followers = followers;
    if (other) this.changed();
    return other;
  }

  /** `dimension` numbers a vertex, those of the rest shape and the added ones. */
  positions<T extends FloatArray>(out: T): T {
    this.result.positions(out);
    this.#followers.carry(this.#made, out);
    return out;
  }

  /** Unit normals, three numbers a vertex. */
  normals<T extends FloatArray>(out: T): T {
    this.result.normals(out);
    this.#followers.turn(this.#made, out);
    return out;
  }

  get #made(): Made {
    const length = () => this.rest.dimension * this.vertices;
    return { positions: () => this.result.positions(new Float64Array(length())), guides: () => this.guides() };
  }

  /** The parts that have followed. */
  followed(): FollowState[] {
    return this.#followers.state(this.#made);
  }

  /** Whether it can stand for this step. */
  carries(plan: StepPlan): plan is P {
    return this.plan.kind === plan.kind;
  }

  get standsFor(): P {
    return this.plan;
  }

  get standsOver(): Rest {
    return this.rest;
  }

  /** Whether it stands for this step over this rest shape. */
  isAt(plan: StepPlan, rest: Rest): boolean {
    return plan === this.plan && rest === this.rest;
  }

  /** At the result, each term unweighted and the weighted sum as `total`. */
  energy(): Record<string, number> {
    return { total: 0 };
  }

  get vertices(): number {
    return this.rest.positions.length / this.rest.dimension + (this.added?.parents.length ?? 0) / 2;
  }

  /** The rest shape of the next step, the same one until the result changes. */
  next(): Rest {
    if (this.#next) return this.#next;
    const { core, input, dimension, growth } = this.rest;
    const positions = this.positions(new Float64Array(dimension * this.vertices));
    const labels = this.labels();
    const { added } = this;
    return (this.#next = added
      ? new Rest(core, input, positions, grown(growth, added), labels && extendedLabels(labels, added.parents))
      : new Rest(core, input, positions, growth, labels));
  }

  /** Of the last sketch, one a vertex of the rest shape. */
  protected labels(): Uint32Array | undefined {
    return this.rest.labels;
  }

  /** What refinement has added to the input up to here. */
  get growth(): Refinement | undefined {
    return this.added ? this.next().growth : this.rest.growth;
  }

  /** Where the rest shape's vertices are at rest in this step. */
  get restPositions(): Float64Array {
    return this.rest.positions;
  }

  /** Moments share what has not changed between them. */
  moment(): StageMoment {
    if (this.#saved && this.#stands) return this.#saved;
    this.#stands = true;
    const { source: _, ...before } = this.#saved ?? { source: undefined };
    return (this.#saved = { ...shared(before, this.save()), source: this.plan.source });
  }

  /** Goes to a moment of the same step over the same rest shape. */
  goTo(plan: P, rest: Rest, moment: StageMoment): void {
    if (moment === this.#saved && this.#stands && rest === this.rest) {
      this.prepare(plan, rest);
      return;
    }
    const followers = Followers.of(plan, rest, this.#followers);
    this.bringBack(plan, rest, moment);
    this.#followers = followers;
    this.changed();
  }

  /** Goes on counting from here. */
  inherit({ factorizations, analyses }: Pick<StepReport, "factorizations" | "analyses">): void {
    this.past.factorizations += factorizations;
    this.past.analyses += analyses;
  }

  /** Comes back from where `PutAway` kept it. */
  resume({ plan, rest, moment, next }: PutAway): void {
    this.goTo(plan as P, rest, moment);
    [this.#saved, this.#stands, this.#next] = [moment, true, next];
  }

  /** Without its model, which can be made again. */
  putAway(): PutAway {
    const kept = { plan: this.plan, rest: this.rest, moment: this.moment(), next: this.next(), report: this.report() };
    this.#next = undefined; // it stays with what is kept
    this.dispose();
    return new PutAway(kept.plan, kept.rest, kept.moment, kept.next, kept.report);
  }

  /** The result is another one from now on. */
  protected changed(): void {
    this.#stands = false;
    this.#followers.forget();
    this.#next?.dispose();
    this.#next = undefined;
  }
}

/** What is kept of a stage that is done while later ones are at work: no model, only what came of it. */
export class PutAway {
  readonly done = true;

  constructor(
    readonly plan: StepPlan,
    readonly rest: Rest,
    readonly moment: StageMoment,
    readonly next: Rest,
    readonly report: StepReport,
  ) {}

  isAt(plan: StepPlan, rest: Rest): boolean {
    return plan === this.plan && rest === this.rest;
  }
}
