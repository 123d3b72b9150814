// The rigid motion that takes points to others.

import { coordinates, Place } from "../boundary/check.js";
import type { Core } from "../boundary/core.js";
import type { Transform } from "./transform.js";

/** A transform that keeps all lengths: a turn about a point, then a shift. */
export interface RigidTransform extends Transform {
  rotate: { axis: number[]; degrees: number; about: number[] };
  translate: number[];
}

/** Three numbers a point. Errors: invalid-option. */
export function rigidMotion(core: Core, from: ArrayLike<number>, to: ArrayLike<number>): RigidTransform {
  const before = coordinates(new Place("invalid-option", "from"), from, 3);
  const after = coordinates(new Place("invalid-option", "to"), to, 3);
  if (after.length !== before.length) {
    new Place("invalid-option", "to").fail(to, `${before.length} numbers, as many as from`);
  }
  return fitted(core, before, after);
}

/** The same for numbers that are checked. */
export function fitted(core: Core, from: ArrayLike<number>, to: ArrayLike<number>): RigidTransform {
  const both = new Float64Array(from.length + to.length);
  both.set(from);
  both.set(to, from.length);
  const scratch = core.stage(both);
  core.call(() => core.raw.fitRigid(scratch));
  const [x, y, z, ...centers] = scratch.doubles(9);
  const angle = Math.hypot(x, y, z);
  const about = centers.slice(0, 3);
  const axis = angle > 0 ? [x, y, z].map((component) => component / angle) : [0, 0, 1];
  return {
    rotate: { axis, degrees: (angle * 180) / Math.PI, about },
    translate: about.map((component, k) => centers[3 + k] - component),
  };
}
