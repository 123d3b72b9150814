// A step that puts vertices somewhere and solves nothing.

import { type FloatArray, toSpace } from "../boundary/check.js";
import type { State } from "../boundary/state.js";
import { surfaceNormals } from "../shape/normals.js";
import { carryPlaced } from "./carry.js";
import { gathered, rows } from "./growth.js";
import type { PlacePlan } from "./plan.js";
import type { Rest } from "./rest.js";
import { checkedParts, placed, sameGoal } from "./roles.js";
import { same } from "./same.js";
import { type Result, Stage, type StageStep } from "./stage.js";
import type { StageMoment, StepReport } from "./types.js";

export class PlaceStage extends Stage<PlacePlan> {
  readonly method = "place";
  readonly added = undefined;
  #parts: Int32Array[];
  #positions: Float64Array;
  #done = false;
  #ms = 0;

  constructor(plan: PlacePlan, rest: Rest) {
    super(plan, rest);
    this.#parts = checkedParts(plan, rest);
    this.#positions = rest.positions;
  }

  protected take(plan: PlacePlan, rest: Rest): boolean {
    if (plan === this.plan && rest === this.rest) return false;
    const parts = checkedParts(plan, rest);
    const stays = rest === this.rest && same(parts, this.#parts)
      && plan.parts.every(({ goal }, i) => sameGoal(goal, this.plan.parts[i].goal));
    if (stays) {
      this.plan = plan;
      return false;
    }
    if (rest !== this.rest) this.#positions = rest.positions;
    [this.plan, this.rest, this.#parts, this.#done] = [plan, rest, parts, false];
    this.changed();
    return true;
  }

  get done(): boolean {
    return this.#done;
  }

  advance(): StageStep {
    const begin = performance.now();
    const { positions, dimension } = this.rest;
    const result = positions.slice();
    this.plan.parts.forEach((part, i) => {
      const ids = this.#parts[i];
      const targets = placed(part, gathered(positions, ids, dimension), dimension);
      ids.forEach((id, at) => {
        for (let k = 0; k < dimension; ++k) result[dimension * id + k] = targets[dimension * at + k];
      });
    });
    this.#positions = result;
    this.#done = true;
    this.#ms = performance.now() - begin;
    this.changed();
    return {
      iteration: 1, energy: 0, terms: {}, converged: true, accepted: true, milliseconds: this.#ms, entry: -1, done: 1,
    };
  }

  reset(): void {
    this.#positions = this.rest.positions;
    this.#done = false;
    this.changed();
  }

  protected get result(): Result {
    const { triangles, dimension, positions: rest } = this.rest;
    const placed = this.#positions;
    return {
      positions<T extends FloatArray>(out: T): T {
        out.set(placed);
        return out;
      },
      normals: (out) => surfaceNormals(placed, triangles, rest, dimension, out),
    };
  }

  protected guides(): () => boolean {
    return () => true;
  }

  state(): State {
    const { dimension } = this.rest;
    const points = (ids: Int32Array) => rows(toSpace(gathered(this.#positions, ids, dimension), dimension), 3);
    return { handles: this.#parts.map((ids) => ({ vertices: Array.from(ids), targets: points(ids) })) };
  }

  report(): StepReport {
    const iterations = this.#done ? [{ energy: 0, ms: this.#ms }] : [];
    return {
      method: "place", unknowns: 0, ...this.past, setupMs: 0, start: 0, iterations, converged: this.#done,
      energy: { total: 0 },
    };
  }

  protected takeAlong(points: Float64Array, normals?: Float64Array): void {
    carryPlaced(this.plan, this.rest, points, normals);
  }

  dispose(): void {
    this.changed();
  }

  protected save(): Omit<StageMoment, "source"> {
    return { shown: this.#done, progress: [] };
  }

  protected bringBack(plan: PlacePlan, rest: Rest, { shown }: StageMoment): void {
    this.prepare(plan, rest);
    if (shown) this.advance();
  }
}
