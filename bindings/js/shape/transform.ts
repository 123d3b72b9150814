// TRANSFORM of the edit script: how a handle moves from its rest position.

import { direction, fields, finite, type Place, positive, toSpace, vector } from "../boundary/check.js";
import type { RawValues } from "../boundary/raw.js";

/** Applied in this order: scale about the centroid of the handle, rotate, translate; or a matrix. */
export interface Transform {
  scale?: number;
  /** axis: in the plane it may be left out. about: the centroid of the handle when left out. */
  rotate?: { axis?: ArrayLike<number>; degrees: number; about?: ArrayLike<number> };
  translate?: ArrayLike<number>;
  /** 16 numbers, column by column, instead of the others. */
  matrix?: ArrayLike<number>;
}

/** A checked TRANSFORM, in space. */
export type CheckedTransform = Steps | { kind: "matrix"; matrix: number[] };

export interface Steps {
  kind: "steps";
  scale: number;
  axis: number[];
  degrees: number;
  about: number[] | undefined;
  translate: number[];
}

export function readTransform(place: Place, value: unknown, dimension: number): CheckedTransform {
  const move = fields(place, value, ["scale", "rotate", "translate", "matrix"]);
  if (move.matrix !== undefined) {
    const others = Object.keys(move).filter((key) => key !== "matrix");
    if (others.length > 0) place.reject(`has matrix and ${others[0]}; expected one or the other`);
    return { kind: "matrix", matrix: readMatrix(place.at("matrix"), move.matrix, dimension) };
  }
  const space = (at: Place, v: unknown) => Array.from(toSpace(vector(at, v, dimension), dimension));
  const rotate =
    move.rotate === undefined ? undefined : fields(place.at("rotate"), move.rotate, ["axis", "degrees", "about"]);
  const turn = place.at("rotate");
  return {
    kind: "steps",
    scale: move.scale === undefined ? 1 : positive(place.at("scale"), move.scale),
    axis: rotate ? readAxis(turn.at("axis"), rotate.axis, dimension) : [0, 0, 1],
    degrees: rotate ? finite(turn.at("degrees"), rotate.degrees) : 0,
    about: rotate?.about === undefined ? undefined : space(turn.at("about"), rotate.about),
    translate: move.translate === undefined ? [0, 0, 0] : space(place.at("translate"), move.translate),
  };
}

function readAxis(place: Place, value: unknown, dimension: number): number[] {
  if (dimension === 3) return direction(place, value, 3);
  if (value === undefined) return [0, 0, 1];
  const axis = direction(place, value, 3);
  return axis[0] === 0 && axis[1] === 0 ? axis : place.reject("leaves the plane; expected [0, 0, 1] or [0, 0, -1]");
}

function readMatrix(place: Place, value: unknown, dimension: number): number[] {
  const m = vector(place, value, 16);
  if (m[3] !== 0 || m[7] !== 0 || m[11] !== 0 || m[15] !== 1) {
    place.reject("has a last row other than 0 0 0 1; expected an affine matrix, column by column");
  }
  if (dimension === 2 && (m[2] !== 0 || m[6] !== 0 || m[14] !== 0)) {
    place.reject("leaves the plane; expected a matrix that keeps z = 0");
  }
  return m;
}

/** One as a RawDeformer takes it. */
export function packTransform({ scale, axis, degrees, about, translate }: Steps, center: number[]): RawValues {
  const angle = (degrees * Math.PI) / 180;
  // Without a scale the centre plays no part: as the origin it costs no rounding either.
  return {
    scale, center: scale === 1 ? [0, 0, 0] : center, axis, angle, about: about ?? center, translation: translate,
  };
}

/** Where it takes points, `dimension` numbers each; `center`: theirs, in space. */
export function applyTransform(
  transform: CheckedTransform, points: Float64Array, center: number[], dimension: number,
): Float64Array {
  return applyMatrix(matrixOf(transform, center), points, dimension);
}

/** One of points with this centre as an affine matrix, column by column. */
export function matrixOf(transform: CheckedTransform, center: number[]): number[] {
  if (transform.kind === "matrix") return transform.matrix;
  const { scale, axis, degrees, about = center, translate } = transform;
  const length = Math.hypot(...axis);
  const [sine, cosine] = [Math.sin((degrees * Math.PI) / 180), Math.cos((degrees * Math.PI) / 180)];
  const [x, y, z] = axis.map((a) => a / length);
  const v = 1 - cosine; // the rotation matrix of Rodrigues, row by row
  const turn = [
    [x * x * v + cosine, x * y * v - z * sine, x * z * v + y * sine],
    [y * x * v + z * sine, y * y * v + cosine, y * z * v - x * sine],
    [z * x * v - y * sine, z * y * v + x * sine, z * z * v + cosine],
  ];
  const row = (r: number) => turn[r].map((m) => m * scale);
  const offset = (r: number) =>
    about[r] + translate[r] + turn[r].reduce((sum, m, c) => sum + m * ((1 - scale) * center[c] - about[c]), 0);
  const columns = [0, 1, 2].map((c) => [0, 1, 2].map((r) => row(r)[c]));
  return [...columns.flatMap((column) => [...column, 0]), offset(0), offset(1), offset(2), 1];
}

/** What turns normals where a matrix moves points: the cofactors of its linear part, without a translation. */
export function cofactors(m: number[]): number[] {
  const entry = (r: number, c: number) => m[4 * (c % 3) + (r % 3)];
  const minor = (r: number, c: number) =>
    entry(r + 1, c + 1) * entry(r + 2, c + 2) - entry(r + 1, c + 2) * entry(r + 2, c + 1);
  return [0, 1, 2].flatMap((c) => [minor(0, c), minor(1, c), minor(2, c), 0]).concat(0, 0, 0, 1);
}

/** The mean of points, in space. */
export function centroidOf(points: Float64Array, dimension: number): number[] {
  const sum = [0, 0, 0];
  points.forEach((x, i) => (sum[i % dimension] += x));
  return sum.map((x) => (x * dimension) / points.length);
}

/** Where an affine matrix takes points, `dimension` numbers each. */
export function applyMatrix(m: number[], points: Float64Array, dimension: number): Float64Array {
  return points.map((_, i) => {
    const row = i % dimension;
    let sum = m[12 + row];
    for (let axis = 0; axis < dimension; ++axis) sum += m[4 * axis + row] * points[i - row + axis];
    return sum;
  });
}
