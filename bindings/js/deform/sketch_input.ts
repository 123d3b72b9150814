// What a sketch is made from, as callers write it, and how it is packed for the WASM side.

import { choice, type Fields, fields, finite, flag, type FloatArray, list, type Place, points, direction, vector } from "../boundary/check.js";

/** CAMERA of docs/edit-script.md. Pixels are square, from the top left corner, y down. Either `fovY` or `orthographicHeight`. */
export interface Camera {
  eye: ArrayLike<number>;
  target: ArrayLike<number>;
  up: ArrayLike<number>;
  /** Height of the view, in degrees. */
  fovY?: number;
  /** Height of the picture in the scene's units, for a view without perspective. */
  orthographicHeight?: number;
  /** Of the picture, in pixels. */
  width: number;
  height: number;
}

/** Samples of a drawn line in pixels: [[x, y], ...], or a typed array of x, y, x, y, ... */
export type Stroke = readonly ArrayLike<number>[] | FloatArray;

/** A function of the normalised arc length s: points [s, F(s)], s from 0 to 1 ascending; linear between, constant beyond. */
export type Profile = readonly ArrayLike<number>[] | FloatArray;

/** Which end of a reference stroke is held; in the order of the WASM side's `Hold`. */
export const holds = ["larger", "start", "end"] as const;
export type Hold = (typeof holds)[number];

/** The plane of the points x with normal . x = offset (0). */
export interface Mirror {
  normal: ArrayLike<number>;
  offset?: number;
}

/** A key pose, relative to the reference curve: what `pose()` gives and `setPose` takes. Angles in radians. */
export interface SketchPose {
  /** Of the whole limb about the start of the curve. */
  heading: number;
  /** Added to the turning angle at every inner node of the curve. */
  turns: number[];
  /** The target's length over the reference's. */
  length: number;
  /** Angle over s. */
  twist: [s: number, angle: number][];
  /** Factor over s. */
  scale: [s: number, factor: number][];
}

/** Numbers and counts on their way into the scratch. */
export class Packed {
  readonly doubles: number[] = [];
  readonly integers: number[] = [];

  /** A CAMERA. What else has to hold is checked behind. */
  camera(place: Place, value: unknown): this {
    const camera = fields(place, value, ["eye", "target", "up", "fovY", "orthographicHeight", "width", "height"]);
    for (const key of ["eye", "target", "up"] as const) this.doubles.push(...vector(place.at(key), camera[key], 3));
    const { fovY, orthographicHeight } = camera;
    const orthographic = orthographicHeight !== undefined;
    if (orthographic && fovY !== undefined) place.reject("has fovY and orthographicHeight; expected one or the other");
    if (!orthographic && fovY === undefined) place.reject("has neither fovY nor orthographicHeight; expected one of them");
    this.integers.push(Number(orthographic));
    this.doubles.push(orthographic ? finite(place.at("orthographicHeight"), orthographicHeight) : finite(place.at("fovY"), fovY));
    for (const key of ["width", "height"] as const) this.doubles.push(finite(place.at(key), camera[key]));
    return this;
  }

  /** A STROKE or a PROFILE. */
  pairs(place: Place, value: unknown): this {
    const numbers = points(place, value, 2);
    this.integers.push(numbers.length / 2);
    for (let i = 0; i < numbers.length; ++i) this.doubles.push(numbers[i]);
    return this;
  }

  mirror(place: Place, value: unknown): this {
    const mirror = fields(place, value, ["normal", "offset"]);
    const normal = direction(place.at("normal"), mirror.normal, 3);
    const offset = mirror.offset === undefined ? 0 : finite(place.at("offset"), mirror.offset);
    const square = normal.reduce((sum, x) => sum + x * x, 0);
    this.doubles.push(...normal.map((x) => (x * offset) / square), ...normal);
    return this;
  }

  partitions(place: Place, value: unknown): this {
    const lines = Array.from(list(place, value, "lines across the shape"));
    this.integers.push(lines.length);
    lines.forEach((line, i) => this.pairs(place.item(i), line));
    return this;
  }

  pose(place: Place, value: unknown): this {
    const pose = fields(place, value, ["heading", "turns", "length", "twist", "scale"]);
    for (const key of ["heading", "length"] as const) this.doubles.push(finite(place.at(key), pose[key]));
    const turns = list(place.at("turns"), pose.turns);
    this.integers.push(turns.length);
    for (let i = 0; i < turns.length; ++i) this.doubles.push(finite(place.at("turns").item(i), turns[i]));
    return this.pairs(place.at("twist"), pose.twist).pairs(place.at("scale"), pose.scale);
  }
}

/** A pose from the numbers of the WASM side, each list after its length. */
export function unpackPose(numbers: ArrayLike<number>): SketchPose {
  let at = 0;
  const take = (count: number) => Array.from({ length: count }, () => numbers[at++]);
  const [heading, length] = take(2);
  const [turns, twist, scale] = [1, 2, 2].map((width) => {
    const [count] = take(1);
    return Array.from({ length: count }, () => take(width));
  });
  return { heading, turns: turns.flat(), length, twist: twist as SketchPose["twist"], scale: scale as SketchPose["scale"] };
}

/** What a region is chosen by, packed, and the choices that travel beside. */
export function readDrawing(place: Place, options: Fields): { packed: Packed; smooth: boolean; mirrored: boolean; hold: number } {
  const packed = new Packed().camera(place.at("camera"), options.camera).pairs(place.at("reference"), options.reference);
  const mirrored = options.mirror !== undefined;
  if (mirrored) packed.mirror(place.at("mirror"), options.mirror);
  packed.partitions(place.at("partitions"), options.partitions ?? []);
  return {
    packed, mirrored, smooth: options.smooth === undefined || flag(place.at("smooth"), options.smooth),
    hold: holds.indexOf(choice(place.at("hold"), options.hold ?? "larger", holds)),
  };
}
