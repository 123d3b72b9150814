// Loose parts of a step: a method that follows the surface leaves them behind, so each goes along with what it lies on.

import { fields, type FloatArray, list, type Place, toSpace } from "../boundary/check.js";
import { type Extent, readSelection, selectedIds } from "../shape/selection.js";
import { fitted } from "../shape/rigid.js";
import { applyTransform, type CheckedTransform, readTransform, type Steps } from "../shape/transform.js";
import type { FollowPlan, StepPlan } from "./plan.js";
import type { Rest } from "./rest.js";
import type { FollowState } from "./types.js";
import { gathered } from "./growth.js";

const none: readonly FollowPlan[] = [];
const origin = [0, 0, 0];
const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
const known = new WeakMap<object, { extent: Extent; plans: readonly FollowPlan[] }>();

/** Of a step; the same value over shapes of one size gives the same plans. */
export function readFollow(place: Place, value: unknown, extent: Extent): readonly FollowPlan[] {
  if (value === undefined) return none;
  const items = list(place, value, "parts that follow");
  const before = known.get(items);
  if (before?.extent.count === extent.count && before.extent.dimension === extent.dimension) return before.plans;
  const plans = Array.from(items, (item, i) => {
    const here = place.item(i);
    const part = fields(here, item, ["select", "along"]);
    const read = (key: "select" | "along") => {
      const place = here.at(key);
      return { place, select: readSelection(place, part[key], extent) };
    };
    return { follows: read("select"), along: read("along") };
  });
  known.set(items, { extent, plans });
  return plans;
}

/** What the step makes of the vertices, without the parts that follow. */
export interface Made {
  /** In double. */
  positions(): Float64Array;
  /** Whether the step itself says where a vertex is to be: then its whole part goes its own way. */
  guides(): (vertex: number) => boolean;
}

/** A part over a rest shape; ascending vertex ids. */
interface Part {
  follows: Int32Array;
  along: Int32Array;
}

/** The parts of a step over a rest shape, and how the result of the step moves them. */
export class Followers {
  #motions: (CheckedTransform | undefined)[] | undefined;

  private constructor(readonly plans: readonly FollowPlan[], readonly rest: Rest, readonly parts: readonly Part[]) {}

  /** Those of a step; `before`, where they are the same. Errors: invalid-script. */
  static of(plan: StepPlan, rest: Rest, before?: Followers): Followers {
    const plans = plan.kind === "place" ? none : plan.follow;
    if (before?.rest.positions === rest.positions && before.plans === plans) return before;
    const ids = ({ place, select }: FollowPlan["along"]) => selectedIds(place, select, rest.positions);
    const parts = plans.map(({ follows, along }) => ({ follows: ids(follows), along: ids(along) }));
    return new Followers(plans, rest, parts);
  }

  /** The result is another one. */
  forget(): void {
    this.#motions = undefined;
  }

  /** Puts the parts where they go. */
  carry(made: Made, positions: FloatArray): void {
    const { positions: rest, dimension } = this.rest;
    this.#each(made, (motion, ids) => {
      scatter(positions, ids, applyTransform(motion, gathered(rest, ids, dimension), origin, dimension), dimension);
    });
  }

  /** Turns their normals. */
  turn(made: Made, normals: FloatArray): void {
    this.#each(made, (motion, ids) => {
      const turn = { ...(motion as Steps), about: origin, translate: origin };
      scatter(normals, ids, applyTransform(turn, gathered(normals, ids, 3), origin, 3), 3);
    });
  }

  /** How they have moved, to compute it again: x -> rotation x + translation. */
  state(made: Made): FollowState[] {
    const moved: FollowState[] = [];
    this.#each(made, (motion, ids) => {
      const image = (point: number[]) => Array.from(applyTransform(motion, Float64Array.from(point), origin, 3));
      const translation = image(origin);
      const columns = axes.map((axis) => image(axis).map((x, row) => x - translation[row]));
      const rotation = [0, 1, 2].flatMap((row) => columns.map((column) => column[row]));
      moved.push({ vertices: Array.from(ids), rotation, translation });
    });
    return moved;
  }

  #each(made: Made, use: (motion: CheckedTransform, ids: Int32Array) => void): void {
    if (this.parts.length === 0) return;
    this.#motions ??= this.#moved(made);
    this.#motions.forEach((motion, i) => motion && use(motion, this.parts[i].follows));
  }

  #moved({ positions, guides }: Made): (CheckedTransform | undefined)[] {
    const { core, positions: rest, dimension } = this.rest;
    const [now, guided] = [positions(), guides()];
    return this.parts.map(({ follows, along }, i) => {
      if (follows.some(guided)) return undefined;
      const at = (points: Float64Array) => toSpace(gathered(points, along, dimension), dimension);
      return readTransform(this.plans[i].along.place, fitted(core, at(rest), at(now)), 3);
    });
  }
}

function scatter(values: FloatArray, ids: Int32Array, own: FloatArray, width: number): void {
  ids.forEach((id, i) => values.set(own.subarray(width * i, width * (i + 1)), width * id));
}
