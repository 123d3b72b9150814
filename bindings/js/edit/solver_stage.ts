// A step with a solver: a deformer over the rest shape, kept as long as the step's document allows.

import type { State } from "../boundary/state.js";
import { carryThrough } from "../deform/deformation.js";
import { Deformer, drive } from "../deform/deformer.js";
import type { Handle } from "../deform/handle.js";
import type { Options } from "../methods/index.js";
import type { Goal, SolverPlan } from "./plan.js";
import type { Rest } from "./rest.js";
import { checkedRoles, reach, type Roles, sameGoal } from "./roles.js";
import { same } from "./same.js";
import { copied, type Phase, solvedReport, Solving } from "./solving.js";
import { type Result, Stage, type StageStep } from "./stage.js";
import type { StageMoment, StepReport } from "./types.js";

type Given = Readonly<Record<string, unknown>>;

/** Handles with where they were last sent. */
interface Held {
  handle: Handle;
  goal: Goal | undefined;
}

/** A deformer with the constraints of a step on it. */
class Model {
  held: Held[] = [];
  /** Options as they are now, after those of drags. */
  options: Given;

  constructor(readonly deformer: Deformer, readonly roles: Roles, options: Given) {
    this.options = options;
  }

  static build(plan: SolverPlan, rest: Rest, roles: Roles): Model {
    const deformer = new Deformer(rest.core, rest.shape, plan.options);
    try {
      deformer.setFixed(roles.fixed);
      const model = new Model(deformer, roles, plan.options as object as Given);
      model.held = roles.handles.map((ids) => ({ handle: deformer.addHandle(ids), goal: undefined }));
      return model;
    } catch (error) {
      deformer.dispose();
      throw error;
    }
  }

  /** The same deformer under other constraints; handles on the same vertices stay. Errors: it is of no use then. */
  constrained(roles: Roles): Model {
    const model = new Model(this.deformer, roles, this.options);
    const before = [...this.held];
    const kept = roles.handles.map((ids) => {
      const at = before.findIndex(({ handle }) => same(handle.vertices, ids));
      return at < 0 ? undefined : before.splice(at, 1)[0];
    });
    for (const { handle } of before) handle.remove();
    this.deformer.setFixed(roles.fixed);
    model.held = roles.handles.map((ids, i) => kept[i] ?? { handle: this.deformer.addHandle(ids), goal: undefined });
    return model;
  }

  send(at: number, goal: Goal | undefined): void {
    const held = this.held[at];
    if (sameGoal(held.goal, goal)) return;
    reach(held.handle, goal);
    held.goal = goal;
  }

  /** Only what differs. */
  setOptions(options: Given): void {
    const changes = changesOf(this.options, options);
    if (Object.keys(changes).length > 0) this.deformer.setOptions(changes as never);
    this.options = this.#after(changes);
  }

  /** Whether changing live options leads to these. */
  canTake(options: Given): boolean {
    const { live } = drive(this.deformer).method;
    const changes = changesOf(this.options, options);
    return Object.keys(changes).every((key) => live.includes(key)) && same(this.#after(changes), options);
  }

  #after(changes: Given): Given {
    const { merge } = drive(this.deformer).method;
    return merge?.(this.options as Options, changes as Options) ?? { ...this.options, ...changes };
  }
}

function changesOf(before: Given, after: Given): Given {
  return Object.fromEntries(Object.entries(after).filter(([key, value]) => !same(before[key], value)));
}

export class SolverStage extends Stage<SolverPlan> {
  #model: Model;
  #solving: Solving;
  /** Whether the model is as the plan has it; not after an error half way. */
  #sound = true;
  #setupMs: number;

  constructor(plan: SolverPlan, rest: Rest) {
    super(plan, rest);
    const begin = performance.now();
    this.#model = Model.build(plan, rest, checkedRoles(plan, rest));
    this.#solving = new Solving(this.#model.deformer, this.#phases(plan));
    this.#setupMs = performance.now() - begin;
  }

  get method(): string {
    return this.plan.options.method;
  }

  protected take(plan: SolverPlan, rest: Rest): boolean {
    if (plan === this.plan && rest === this.rest && this.#sound) return false;
    const roles = checkedRoles(plan, rest);
    if (!this.#goesOn(plan, rest, roles)) return this.#takeUp(plan, rest, roles);
    [this.plan, this.#solving.phases] = [plan, this.#phases(plan)];
    return false;
  }

  /** Whether what has been carried out is the beginning of what the plan asks for. */
  #goesOn(plan: SolverPlan, rest: Rest, roles: Roles): boolean {
    const { options, handles, drag, tolerance } = this.plan;
    const begun = this.#solving.progress.length;
    return this.#sound && begun > 0 && rest === this.rest && same(roles, this.#model.roles)
      && same(options, plan.options) && tolerance === plan.tolerance
      && handles.every(({ goal }, i) => sameGoal(goal, plan.handles[i].goal))
      && drag.slice(0, begun - 1).every((entry, i) => plan.drag[i] !== undefined && sameEntry(entry, plan.drag[i]))
      && this.#solving.fits(this.#phases(plan));
  }

  /** From the beginning of the plan, and from the deformation as it is where the model stays. */
  #takeUp(plan: SolverPlan, rest: Rest, roles: Roles): true {
    const begin = performance.now();
    const { deformer } = this.#model;
    const stays = this.#sound && rest === this.rest && plan.options.method === this.method
      && !drive(deformer).refined();
    if (!stays || !this.#model.canTake(plan.options as object as Given)) this.#rebuild(plan, rest, roles);
    else if (!same(roles, this.#model.roles)) this.#constrain(roles);
    [this.plan, this.rest] = [plan, rest];
    this.#solving = new Solving(this.#model.deformer, this.#phases(plan));
    this.#setupMs += performance.now() - begin;
    this.changed();
    return true;
  }

  #rebuild(plan: SolverPlan, rest: Rest, roles: Roles): void {
    const model = Model.build(plan, rest, roles);
    this.inherit(this.#model.deformer.counters());
    this.#model.deformer.dispose();
    this.#model = model;
    this.#sound = true;
  }

  #constrain(roles: Roles): void {
    this.#sound = false;
    this.#model = this.#model.constrained(roles);
    this.#sound = true;
  }

  /** The step itself, then what happened under the grab, entry by entry. */
  #phases({ options, handles, drag, iterations, tolerance }: SolverPlan): Phase[] {
    const begin = () => this.#send(options as object as Given, handles.map(({ goal }) => goal));
    return [{ iterations, tolerance, begin }, ...drag.map((entry) => ({
      iterations: entry.iterations, tolerance,
      begin: () => {
        this.#model.setOptions({ ...this.#model.options, ...(entry.options as object) });
        for (const { handle, goal } of entry.goals) this.#model.send(handle, goal);
      },
    }))];
  }

  get done(): boolean {
    return this.#solving.done;
  }

  advance(): StageStep {
    const step = this.#solving.advance();
    this.changed();
    const { progress } = this.#solving;
    return { ...step, entry: progress.length - 2, done: progress[progress.length - 1].iterations.length };
  }

  reset(): void {
    const { deformer, held } = this.#model;
    if (drive(deformer).refined()) this.#sound = false; // the model of its beginning is gone
    deformer.reset();
    for (const one of held) one.goal = undefined;
    this.#solving = new Solving(deformer, this.#phases(this.plan));
    this.changed();
  }

  readonly added = undefined;

  protected get result(): Result {
    return this.#model.deformer;
  }

  protected guides(): (vertex: number) => boolean {
    const { fixed, handles } = this.#model.roles;
    const held = new Set([fixed, ...handles].flatMap((ids) => [...ids]));
    return (vertex) => held.has(vertex);
  }

  state(): State {
    return this.#model.deformer.state();
  }

  report(): StepReport {
    const [main, ...drag] = this.#solving.progress;
    const report = solvedReport(this.#solving, main, this.#setupMs, this.past);
    const costs = drag.map(({ factorizations, analyses, iterations }) => ({
      factorizations, analyses, iterations: [...iterations],
    }));
    return costs.length > 0 ? { ...report, drag: costs } : report;
  }

  override energy(): Record<string, number> {
    const { total, terms } = this.#model.deformer.energy();
    return { total, ...terms };
  }

  override isAt(plan: SolverPlan, rest: Rest): boolean {
    return this.#sound && super.isAt(plan, rest);
  }

  protected takeAlong(points: Float64Array, normals?: Float64Array): void {
    carryThrough(this.#model.deformer, points, normals);
  }

  dispose(): void {
    this.changed();
    this.#model.deformer.dispose();
  }

  protected save(): Omit<StageMoment, "source"> {
    return { progress: copied(this.#solving.progress), state: this.state() };
  }

  protected bringBack(plan: SolverPlan, rest: Rest, { progress, state }: StageMoment): void {
    this.#takeUp(plan, rest, checkedRoles(plan, rest));
    let options = plan.options as object as Given;
    const goals = plan.handles.map(({ goal }) => goal);
    for (const entry of plan.drag.slice(0, Math.max(0, progress.length - 1))) {
      options = { ...options, ...(entry.options as object) };
      for (const { handle, goal } of entry.goals) goals[handle] = goal;
    }
    if (progress.length > 0) this.#send(options, goals);
    if (state) this.#model.deformer.restore(state);
    this.#solving = new Solving(this.#model.deformer, this.#phases(plan), progress);
  }

  #send(options: Given, goals: readonly (Goal | undefined)[]): void {
    this.#model.setOptions(options);
    goals.forEach((goal, i) => this.#model.send(i, goal));
  }
}

function sameEntry(a: SolverPlan["drag"][number], b: SolverPlan["drag"][number]): boolean {
  if (a === b) return true;
  return same(a.options, b.options) && a.goals.length === b.goals.length
    && a.goals.every(({ handle, goal }, i) => handle === b.goals[i].handle && sameGoal(goal, b.goals[i].goal));
}
