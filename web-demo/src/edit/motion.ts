// How a handle is moved from rest: a turn about its centre, then a shift. The turn is a rotation
// vector (axis times angle) and counts turns: 270 degrees is not -90.
import { Quaternion, Vector3 } from "three";
import type { RigidTransform } from "../solver/pliant.ts";

export type Vec3 = readonly [number, number, number];

export interface Motion {
  translate: Vec3;
  /** Radians. */
  rotation: Vec3;
}

export const atRest: Motion = { translate: [0, 0, 0], rotation: [0, 0, 0] };

export const isAtRest = (m: Motion): boolean => [...m.translate, ...m.rotation].every((x) => x === 0);

const angleOf = (r: Vec3): number => Math.hypot(...r);

export function quaternionOf(rotation: Vec3): Quaternion {
  const angle = angleOf(rotation);
  if (angle === 0) return new Quaternion();
  return new Quaternion().setFromAxisAngle(new Vector3(...rotation).divideScalar(angle), angle);
}

/** The rotation vector of `q` nearest to `near`, any number of turns away. */
export function rotationVector(q: Quaternion, near: Vec3 = [0, 0, 0]): Vec3 {
  const sine = Math.hypot(q.x, q.y, q.z);
  const previous = new Vector3(...near);
  if (sine < 1e-12) {
    const turns = Math.round(angleOf(near) / (2 * Math.PI)); // no axis of its own: keep the old one
    return turns === 0 ? [0, 0, 0] : previous.setLength(2 * Math.PI * turns).toArray();
  }
  const axis = new Vector3(q.x, q.y, q.z).divideScalar(sine);
  const angle = 2 * Math.atan2(sine, q.w);
  const turns = Math.round((previous.dot(axis) - angle) / (2 * Math.PI));
  return axis.multiplyScalar(angle + 2 * Math.PI * turns).toArray();
}

export function translated(m: Motion, by: Vec3): Motion {
  return { ...m, translate: [m.translate[0] + by[0], m.translate[1] + by[1], m.translate[2] + by[2]] };
}

/** Turned further about a world axis (unit) through the handle's present centre. */
export function rotated(m: Motion, axis: Vec3, radians: number): Motion {
  const turn = new Quaternion().setFromAxisAngle(new Vector3(...axis), radians);
  return { ...m, rotation: rotationVector(turn.multiply(quaternionOf(m.rotation)), m.rotation) };
}

/** What is left of a motion in the plane: no depth, turns about z only. */
export const inPlane = (m: Motion): Motion =>
  ({ translate: [m.translate[0], m.translate[1], 0], rotation: [0, 0, m.rotation[2]] });

/** TRANSFORM of docs/edit-script.md; points have `dimension` numbers. */
export function asTransform(m: Motion, about: Vec3, dimension: 2 | 3) {
  const angle = angleOf(m.rotation);
  const translate = m.translate.slice(0, dimension);
  if (angle === 0) return { translate };
  const axis = m.rotation.map((x) => x / angle);
  return { rotate: { axis, degrees: (angle * 180) / Math.PI, about: about.slice(0, dimension) }, translate };
}

const pick = (positions: ArrayLike<number>, v: number) => new Vector3().fromArray(positions as number[], 3 * v);

export function centroid(positions: ArrayLike<number>, vertices: ArrayLike<number>): Vec3 {
  const sum = new Vector3();
  for (let i = 0; i < vertices.length; i++) sum.add(pick(positions, vertices[i]!));
  return sum.divideScalar(vertices.length).toArray();
}

/** As the library tells a rigid motion, about the centroid of what it moves. */
export function motionOf({ rotate: { axis, degrees }, translate }: RigidTransform): Motion {
  const [x, y, z] = axis.map((component) => (component * degrees * Math.PI) / 180);
  return { translate: translate as number[] as [number, number, number], rotation: [x!, y!, z!] };
}
