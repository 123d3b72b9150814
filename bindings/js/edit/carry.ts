// Which steps carry other points along, and how a step does that solves nothing.

import { PliantError } from "../boundary/errors.js";
import { methodsThat, readMethod } from "../methods/index.js";
import { applyMatrix, centroidOf, cofactors, matrixOf, readTransform } from "../shape/transform.js";
import { gathered } from "./growth.js";
import type { PlacePlan, StepPlan } from "./plan.js";
import { checkedParts } from "./roles.js";
import type { Rest } from "./rest.js";

/** Errors: not-solvable where a step moves a surface and not the space around it. */
export function requireCarries(plan: StepPlan): void {
  if (plan.kind === "place") return requirePlaces(plan);
  if (plan.follow.length > 0) {
    refuse(`${plan.place.at("follow").path} moves vertices apart from the space around them; expected none`);
  }
  const solver = plan.kind === "solver" ? plan.options : plan.finish?.options;
  if (solver && readMethod(plan.place, solver.method).carries) return;
  const method = solver?.method ?? plan.kind;
  refuse(`${plan.place.at("method").path} is "${method}", which moves the surface and not the space around it; ` +
    `expected ${methodsThat(({ carries }) => carries)}`);
}

/** What is placed by where it is takes along what else is there. */
function requirePlaces({ parts }: PlacePlan): void {
  for (const { place, select, goal } of parts) {
    if ("targets" in goal) refuse(`${goal.place.path} says nothing of the space between vertices; expected a move`);
    if (select.spatial) continue;
    refuse(`${place.at("select").path} names vertices and no part of space; expected box, sphere, halfSpace or all`);
  }
}

function refuse(reason: string): never {
  throw new PliantError("not-solvable", reason);
}

/** Moves the points that lie in a part, and turns their normals, in place. The plan is one that carries. */
export function carryPlaced(
  plan: PlacePlan, rest: Rest, points: Float64Array, normals: Float64Array | undefined,
): void {
  const { positions, dimension } = rest;
  const vertices = checkedParts(plan, rest);
  const taken = new Uint8Array(points.length / dimension);
  const inside = plan.parts.map(({ select }) => {
    const own = select(points).map((selected, i) => selected & ~taken[i]);
    own.forEach((selected, i) => (taken[i] |= selected));
    return own;
  });
  plan.parts.forEach(({ place, goal }, part) => {
    if (!("move" in goal)) return;
    const center = centroidOf(gathered(positions, vertices[part], dimension), dimension);
    const matrix = matrixOf(readTransform(place.at("move"), goal.move, dimension), center);
    const ids = Int32Array.from(inside[part].keys()).filter((id) => inside[part][id] === 1);
    put(points, ids, dimension, applyMatrix(matrix, gathered(points, ids, dimension), dimension));
    if (normals) put(normals, ids, 3, turned(gathered(normals, ids, 3), matrix));
  });
}

function put(values: Float64Array, ids: Int32Array, width: number, own: Float64Array): void {
  ids.forEach((id, i) => values.set(own.subarray(width * i, width * (i + 1)), width * id));
}

/** By the cofactors of an affine matrix, as normals do; each keeps its length, and one that is crushed stays. */
function turned(normals: Float64Array, matrix: number[]): Float64Array {
  const result = applyMatrix(cofactors(matrix), normals, 3);
  for (let at = 0; at < result.length; at += 3) {
    const [before, after] = [normals, result].map((n) => Math.hypot(n[at], n[at + 1], n[at + 2]));
    for (let i = at; i < at + 3; ++i) result[i] = after > 0 ? (result[i] * before) / after : normals[i];
  }
  return result;
}
