// Which vertices of the rest shape each part of a step is about.

import type { Place } from "../boundary/check.js";
import type { Handle } from "../deform/handle.js";
import { selectedIds } from "../shape/selection.js";
import { applyTransform, centroidOf, readTransform } from "../shape/transform.js";
import type { Pin } from "../picture/order.js";
import type { Goal, HandlePlan, PlacePlan, RegionPlan, SolverPlan, StepPlan } from "./plan.js";
import type { Rest } from "./rest.js";
import { same } from "./same.js";

/** Ascending vertex ids. */
export interface Roles {
  fixed: Int32Array;
  handles: Int32Array[];
}

/** Of steps that are still read: the same handles and fixed region over the same rest shape have the same vertices. */
const known = new WeakMap<readonly HandlePlan[], { fixed: readonly RegionPlan[]; rest: Float64Array; roles: Roles }>();

/** Of a step over a rest shape; no vertex in two roles, and a target for each. Errors: invalid-script. */
export function checkedRoles(
  plan: Pick<SolverPlan, "fixed" | "handles" | "drag">, { positions, dimension }: Rest,
): Roles {
  const { fixed, handles, drag } = plan;
  const before = known.get(handles);
  const stands = before !== undefined && before.fixed === fixed && before.rest === positions;
  const roles = stands ? before.roles : rolesOf(fixed, handles, positions);
  known.set(handles, { fixed, rest: positions, roles });
  handles.forEach(({ goal }, i) => checkTargets(goal, roles.handles[i], dimension));
  for (const { goals } of drag) {
    for (const { handle, goal } of goals) checkTargets(goal, roles.handles[handle], dimension);
  }
  return roles;
}

function rolesOf(fixed: readonly RegionPlan[], handles: readonly HandlePlan[], rest: Float64Array): Roles {
  const taken = new Map<number, Place>();
  for (const { place, select } of fixed) for (const id of selectedIds(place, select, rest)) taken.set(id, place);
  const ids = Int32Array.from(taken.keys()).sort();
  const lists = handles.map(({ place, select }) => {
    const here = place.at("select");
    const own = selectedIds(here, select, rest);
    for (const id of own) {
      const other = taken.get(id);
      const expected = "expected a vertex to be fixed or moved by one handle";
      if (other) here.reject(`holds vertex ${id}, as ${other.path} does; ${expected}`);
      taken.set(id, here);
    }
    return own;
  });
  return { fixed: ids, handles: lists };
}

/** The vertices of each part of a step that places them. Errors: invalid-script. */
export function checkedParts({ parts }: PlacePlan, rest: Rest): Int32Array[] {
  return checkedRoles({ fixed: [], handles: parts, drag: [] }, rest).handles;
}

/** What lies how far in front, where a step says so: its handles, and the fixed region at 0. */
export function pinsOf(plan: StepPlan, rest: Rest): Pin[] {
  if (plan.kind !== "solver" || plan.handles.every(({ depth }) => depth === undefined)) return [];
  const { fixed, handles } = checkedRoles(plan, rest);
  return [{ vertices: fixed }, ...handles.map((vertices, i) => ({ vertices, depth: plan.handles[i].depth }))];
}

function checkTargets(goal: Goal | undefined, { length }: Int32Array, dimension: number): void {
  if (!goal || !("targets" in goal)) return;
  const given = goal.targets.length / dimension;
  if (given !== length) goal.place.reject(`has ${given} points; expected ${length}, one a selected vertex`);
}

export function sameGoal(a: Goal | undefined, b: Goal | undefined): boolean {
  if (!a || !b) return a === b;
  if ("move" in a) return "move" in b && same(a.move, b.move);
  return "targets" in b && same(a.targets, b.targets);
}

/** Moves a handle, without a goal back to rest. */
export function reach(handle: Handle, goal: Goal | undefined): void {
  if (goal && "targets" in goal) handle.moveTo(goal.targets);
  else handle.move(goal?.move ?? {});
}

/** Where a goal takes points at rest, `dimension` numbers each. */
export function placed(
  { place, goal }: HandlePlan & { goal: Goal }, points: Float64Array, dimension: number,
): ArrayLike<number> {
  if ("targets" in goal) return goal.targets;
  const transform = readTransform(place.at("move"), goal.move, dimension);
  return applyTransform(transform, points, centroidOf(points, dimension), dimension);
}
