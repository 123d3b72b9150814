// A sketch step: a limb, which stays as long as the same stroke chose it, its pose, and perhaps a solver that goes on.

import type { State } from "../boundary/state.js";
import type { Step } from "../deform/deformer.js";
import { carryThrough } from "../deform/deformation.js";
import { type Refinement, Sketch } from "../deform/sketch.js";
import { Finisher } from "./finisher.js";
import { located } from "./located.js";
import type { PosePlan, SketchPlan } from "./plan.js";
import type { Rest } from "./rest.js";
import { same } from "./same.js";
import { copied } from "./solving.js";
import { type Result, Stage, type StageStep } from "./stage.js";
import type { SketchView, StageMoment, StepReport } from "./types.js";

/** What chooses a limb; the rest of a step poses it. */
const limbOf = ({ sketch: { smooth: _, ...drawing }, region }: SketchPlan) => ({ ...drawing, region });
const poseOf = ({ sketch: { smooth = true }, pose, toward, refine }: SketchPlan) => ({ smooth, pose, toward, refine });

export class SketchStage extends Stage<SketchPlan> {
  readonly method = "sketch";
  #sketch: Sketch;
  #finisher: Finisher | undefined;
  /** The step whose pose the limb shows; undefined: it is at rest. */
  #posed: SketchPlan | undefined;
  #setupMs: number;
  #poseMs = 0;

  constructor(plan: SketchPlan, rest: Rest) {
    super(plan, rest);
    const begin = performance.now();
    this.#sketch = chosen(plan, rest);
    this.#setupMs = performance.now() - begin;
  }

  protected take(plan: SketchPlan, rest: Rest): boolean {
    if (plan === this.plan && rest === this.rest) return false;
    const begin = performance.now();
    const before = this.plan;
    const stays = rest === this.rest && same(limbOf(plan), limbOf(before));
    if (stays && same(poseOf(plan), poseOf(before)) && sameFinish(plan, before)) {
      if (this.#posed === before) this.#posed = plan;
      this.plan = plan;
      return false;
    }
    if (!stays) this.#chooseAgain(plan, rest);
    else if (plan.sketch.smooth !== before.sketch.smooth) this.#smooth(plan.sketch.smooth ?? true);
    [this.plan, this.rest] = [plan, rest];
    this.#setupMs += performance.now() - begin;
    return true;
  }

  #chooseAgain(plan: SketchPlan, rest: Rest): void {
    const sketch = chosen(plan, rest);
    this.#pastOf(this.plan);
    this.#dropFinisher();
    this.#sketch.dispose();
    this.#sketch = sketch;
    this.#posed = undefined;
    this.changed();
  }

  #smooth(smooth: boolean): void {
    this.#pastOf({ ...this.plan, finish: undefined });
    this.#sketch.setSmooth(smooth);
    this.changed();
  }

  #pastOf(plan: SketchPlan): void {
    this.inherit({ factorizations: systemsOf(plan), analyses: systemsOf(plan) });
  }

  get #shown(): boolean {
    return this.#posed === this.plan;
  }

  get done(): boolean {
    return this.#shown && (this.#finisher?.solving.done ?? true);
  }

  advance(): StageStep {
    const step = this.#shown ? this.#finisher!.solving.advance() : this.#show();
    this.changed();
    return { ...step, entry: -1, done: this.#finisher?.solving.progress.at(-1)?.iterations.length ?? 1 };
  }

  /** Poses the limb. Errors: it is as before. */
  #show(): Step {
    const begin = performance.now();
    const { plan } = this;
    try {
      this.#finish(posed(this.#sketch, plan));
    } catch (error) {
      if (this.#posed) posed(this.#sketch, this.#posed);
      else atRest(this.#sketch);
      throw error;
    }
    this.#posed = plan;
    this.#poseMs = performance.now() - begin;
    return { iteration: 1, energy: 0, terms: {}, converged: true, accepted: true, milliseconds: this.#poseMs };
  }

  #finish(morph: number): void {
    const { finish } = this.plan;
    const kept = this.#finisher;
    const stays = kept && finish && same(kept.plan.options, finish.options) && kept.plan.spacing === finish.spacing;
    if (stays) return kept.begin(finish, morph);
    const place = this.plan.place.at("finish");
    const next = finish && located(place, () => new Finisher(this.rest.core, this.#sketch, finish, morph));
    this.#dropFinisher();
    this.#finisher = next;
  }

  #dropFinisher(): void {
    this.#finisher?.deformer.dispose();
    this.#finisher = undefined;
  }

  reset(): void {
    atRest(this.#sketch);
    this.#finisher?.deformer.reset();
    this.#posed = undefined;
    this.changed();
  }

  get added(): Refinement | undefined {
    return this.#finisher ? undefined : this.#sketch.refinement;
  }

  protected get result(): Result {
    return this.#finisher?.deformer ?? this.#sketch;
  }

  protected guides(): (vertex: number) => boolean {
    const labels = this.#sketch.labels();
    return (vertex) => labels[vertex] > 0;
  }

  protected override labels(): Uint32Array {
    return this.#sketch.labels();
  }

  view(): SketchView {
    const sketch = this.#sketch;
    return {
      labels: sketch.labels(),
      held: sketch.held(),
      parameters: sketch.parameters(),
      reference: sketch.reference(),
      target: sketch.target(),
      refinement: sketch.refinement,
    };
  }

  state(): State {
    const sketched = this.#sketch.state();
    if (!this.#finisher) return { handles: [], ...sketched };
    const { deformer } = this.#finisher;
    const solved = deformer.state();
    return { ...sketched, finish: { method: deformer.method, ...solved }, handles: solved.handles };
  }

  report(): StepReport {
    const { smooth = true } = this.plan.sketch;
    const region = this.#sketch.labels().reduce((count, label) => count + Number(label === 1), 0);
    const systems = systemsOf(this.plan);
    const { added } = this;
    return {
      method: "sketch", unknowns: smooth ? region : 0,
      factorizations: this.past.factorizations + systems, analyses: this.past.analyses + systems,
      setupMs: this.#setupMs, start: 0, iterations: this.#shown ? [{ energy: 0, ms: this.#poseMs }] : [],
      converged: this.#shown, energy: { total: 0 },
      ...(added ? { added: added.parents.length / 2 } : {}),
      ...(this.#finisher ? { finish: this.#finisher.report() } : {}),
    };
  }

  protected takeAlong(points: Float64Array, normals?: Float64Array): void {
    carryThrough(this.#finisher!.deformer, points, normals);
  }

  dispose(): void {
    this.changed();
    this.#dropFinisher();
    this.#sketch.dispose();
  }

  protected save(): Omit<StageMoment, "source"> {
    const shown = this.#shown;
    if (!this.#finisher) return { shown, progress: [] };
    return { shown, progress: copied(this.#finisher.solving.progress), state: this.#finisher.deformer.state() };
  }

  protected bringBack(plan: SketchPlan, rest: Rest, moment: StageMoment): void {
    this.prepare(plan, rest);
    if (!moment.shown) return;
    if (!this.#shown) this.#show();
    this.#finisher?.bringBack(plan.pose.morph, moment);
  }
}

/** Systems that smoothing the parameters solves. */
function systemsOf({ sketch: { smooth = true, mirror } }: SketchPlan): number {
  return smooth ? (mirror ? 2 : 1) : 0;
}

function sameFinish(a: SketchPlan, b: SketchPlan): boolean {
  return same(a.finish, b.finish);
}

/** The limb at rest. */
function chosen({ place, sketch: options, region }: SketchPlan, { core, shape, labels }: Rest): Sketch {
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

function atRest(sketch: Sketch): void {
  sketch.unrefine();
  sketch.reset();
}

/** Poses a sketch from rest and gives the morph it shows. */
function posed(sketch: Sketch, { place, pose, toward, refine }: SketchPlan): number {
  const show = (plan: PosePlan) => {
    const { bend } = plan;
    if (bend) located(place.at("bend"), () => sketch.bend(bend.target, { unfinished: bend.unfinished }));
    if (plan.degrees !== undefined) located(place.at("twist"), () => sketch.twist(plan.degrees!));
    for (const key of ["scale", "turning", "twistSpeed"] as const) {
      const profile = plan[key];
      if (profile) located(place.at(key), () => sketch[key](profile));
    }
  };
  atRest(sketch);
  show(pose);
  let { morph } = pose;
  if (toward) {
    const from = sketch.pose();
    sketch.reset();
    show(toward.pose);
    sketch.setPose(from, sketch.pose(), toward.t);
    morph += toward.t * (toward.pose.morph - morph);
  }
  sketch.morph(morph);
  if (refine) sketch.refine(refine);
  return morph;
}
