// How a handle is moved from rest: a turn about its centre, then a shift. The turn is a rotation
// vector (axis times angle) and counts turns: 270 degrees is not -90.
import { Matrix4, Quaternion, Vector3 } from "three";

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

/**
 * The rigid motion that best carries the rest positions of some vertices to their present ones:
 * the closest rotation by the iteration of Müller et al., "A robust method to extract the rotational
 * part of deformations" (2016).
 */
export function bestMotion(rest: ArrayLike<number>, now: ArrayLike<number>, vertices: ArrayLike<number>): Motion {
  const [from, to] = [centroid(rest, vertices), centroid(now, vertices)];
  const covariance = new Float64Array(9); // rows: now, columns: rest
  for (let i = 0; i < vertices.length; i++) {
    const a = pick(rest, vertices[i]!).sub(new Vector3(...from)).toArray();
    const b = pick(now, vertices[i]!).sub(new Vector3(...to)).toArray();
    for (let r = 0; r < 3; r++) for (let c = 0; c < 3; c++) covariance[3 * r + c]! += b[r]! * a[c]!;
  }
  const q = new Quaternion();
  const column = (c: number) => new Vector3(covariance[c], covariance[3 + c], covariance[6 + c]);
  for (let i = 0; i < 60; i++) {
    const turn = new Matrix4().makeRotationFromQuaternion(q);
    const omega = new Vector3();
    let scale = 1e-12;
    for (let c = 0; c < 3; c++) {
      const axis = new Vector3().setFromMatrixColumn(turn, c);
      omega.add(axis.clone().cross(column(c)));
      scale += Math.abs(axis.dot(column(c)));
    }
    omega.divideScalar(scale);
    const angle = omega.length();
    if (angle < 1e-9) break;
    q.premultiply(new Quaternion().setFromAxisAngle(omega.divideScalar(angle), angle)).normalize();
  }
  return { translate: [to[0] - from[0], to[1] - from[1], to[2] - from[2]], rotation: rotationVector(q) };
}
