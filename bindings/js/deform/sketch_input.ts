// What a sketch is made from, as callers write it, and as the WASM side takes it.

import {
  choice, type Fields, fields, finite, flag, type FloatArray, list, type Place, points, direction, vector,
} from "../boundary/check.js";
import { packLists } from "../boundary/lists.js";
import type { RawValues } from "../boundary/raw.js";

/**
 * CAMERA of docs/edit-script.md. Pixels are square, from the top left corner, y down. Either `fovY` or
 * `orthographicHeight`.
 */
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

/**
 * A function of the normalised arc length s: points [s, F(s)], s from 0 to 1 ascending; linear between, constant
 * beyond.
 */
export type Profile = readonly ArrayLike<number>[] | FloatArray;

/** Which end of a reference stroke is held. */
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

/** A CAMERA as the WASM side takes it. What else has to hold is checked there. */
export function readCamera(place: Place, value: unknown): RawValues {
  const { eye, target, up, fovY, orthographicHeight, width, height } =
    fields(place, value, ["eye", "target", "up", "fovY", "orthographicHeight", "width", "height"]);
  const orthographic = orthographicHeight !== undefined;
  if (orthographic && fovY !== undefined) place.reject("has fovY and orthographicHeight; expected one or the other");
  if (!orthographic && fovY === undefined) {
    place.reject("has neither fovY nor orthographicHeight; expected one of them");
  }
  const of = (name: string, given: unknown) => vector(place.at(name), given, 3);
  return {
    eye: of("eye", eye),
    target: of("target", target),
    up: of("up", up),
    ...(orthographic
      ? { orthographicHeight: finite(place.at("orthographicHeight"), orthographicHeight) }
      : { fovY: finite(place.at("fovY"), fovY) }),
    width: finite(place.at("width"), width),
    height: finite(place.at("height"), height),
  };
}

/** A stroke or a profile. */
export function readPairs(place: Place, value: unknown): ArrayLike<number> {
  return points(place, value, 2);
}

function readMirror(place: Place, value: unknown): RawValues {
  const mirror = fields(place, value, ["normal", "offset"]);
  const mirrorNormal = direction(place.at("normal"), mirror.normal, 3);
  const offset = mirror.offset === undefined ? 0 : finite(place.at("offset"), mirror.offset);
  const square = mirrorNormal.reduce((sum, x) => sum + x * x, 0);
  return { mirrorNormal, mirrorPoint: mirrorNormal.map((x) => (x * offset) / square) };
}

function readPartitions(place: Place, value: unknown): RawValues {
  return packLists(
    "partitions", Array.from(list(place, value, "lines across the shape"), (line, i) => readPairs(place.item(i), line)),
  );
}

/** `prefix`: of the names. */
export function readPose(place: Place, value: unknown, prefix = ""): RawValues {
  const { heading, turns, length, twist, scale } = fields(place, value, [
    "heading", "turns", "length", "twist", "scale",
  ]);
  const pose = {
    heading: finite(place.at("heading"), heading),
    turns: Array.from(list(place.at("turns"), turns), (turn, i) => finite(place.at("turns").item(i), turn)),
    length: finite(place.at("length"), length),
    twist: readPairs(place.at("twist"), twist), scale: readPairs(place.at("scale"), scale),
  };
  return Object.fromEntries(Object.entries(pose).map(([name, field]) => [`${prefix}${name}`, field]));
}

/** A pose from the WASM side. */
export function poseOf(values: RawValues): SketchPose {
  const numbers = (name: keyof SketchPose) => Array.from(values[name] as ArrayLike<number>);
  const pairs = (name: keyof SketchPose) =>
    numbers(name).flatMap((s, i, all) => (i % 2 === 0 ? [[s, all[i + 1]] as [number, number]] : []));
  return {
    heading: numbers("heading")[0],
    turns: numbers("turns"),
    length: numbers("length")[0],
    twist: pairs("twist"),
    scale: pairs("scale"),
  };
}

/** What a region is chosen by. */
export function readDrawing(place: Place, { camera, reference, hold, mirror, partitions, smooth }: Fields): RawValues {
  return {
    ...readCamera(place.at("camera"), camera), reference: readPairs(place.at("reference"), reference),
    ...(mirror === undefined ? {} : readMirror(place.at("mirror"), mirror)),
    ...readPartitions(place.at("partitions"), partitions ?? []),
    ...(hold === undefined ? {} : { hold: choice(place.at("hold"), hold, holds) }),
    ...(smooth === undefined ? {} : { smooth: flag(place.at("smooth"), smooth) }),
  };
}
