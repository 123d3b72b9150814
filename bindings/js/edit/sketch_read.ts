// Reads the sketch steps of a script.

import { fields, type Fields, finite, fraction, integer, notNegative, type Place } from "../boundary/check.js";
import { type DeformerOptions, readMethod } from "../methods/index.js";
import type { Extent } from "../shape/selection.js";
import type { Camera, Profile, SketchOptions, Stroke } from "../deform/sketch.js";
import { Packed, readDrawing } from "../deform/sketch_input.js";
import { maxCount, readDeformer, readSolve, type SolvePlan } from "./solve.js";

/** How a limb is posed. */
export interface PosePlan {
  bend: Stroke | undefined;
  degrees: number | undefined;
  scale: Profile | undefined;
  turning: Profile | undefined;
  twistSpeed: Profile | undefined;
  morph: number;
}

/** The region of another stroke: drawn before this one, or that of the sketch step before. */
export type RegionPlan = { camera: Camera; reference: Stroke } | "previous";

/** A solver that goes on from the pose. */
export interface FinishPlan extends SolvePlan {
  options: DeformerOptions;
  spacing: number | undefined;
}

export interface SketchPlan {
  place: Place;
  /** Checked, and read again by the sketch. */
  sketch: SketchOptions;
  region: RegionPlan | undefined;
  pose: PosePlan;
  /** Between keyframes: the pose to come, and the share of the way to it. */
  toward: { pose: PosePlan; share: number } | undefined;
  refine: { maxAdded?: number } | undefined;
  finish: FinishPlan | undefined;
}

/** What may differ between keyframes. */
export const poseKeys = ["bend", "twist", "scale", "turning", "twistSpeed", "morph"] as const;
const drawingKeys = ["camera", "reference", "partitions", "smooth", "mirror"] as const;

export function readSketchStep(place: Place, value: unknown, extent: Extent, seed: number | undefined): SketchPlan {
  const step = fields(place, value, ["method", ...drawingKeys, ...poseKeys, "region", "refine", "finish"]);
  readDrawing(place, step);
  const pose = readPose(place, step);
  const region = step.region === undefined ? undefined : readRegion(place.at("region"), step);
  if (region === "previous" && step.partitions !== undefined) place.reject('has partitions beside "region": "previous"; expected one or the other');
  if (region === "previous" && step.mirror !== undefined) place.reject('has mirror beside "region": "previous"; expected one or the other');
  const refine = readRefine(place.at("refine"), step.refine ?? false);
  if (refine && step.finish !== undefined) place.reject("has refine and finish; expected one or the other");
  return {
    place, region, pose, toward: undefined, refine,
    sketch: drawingOf(step),
    finish: step.finish === undefined ? undefined : readFinish(place.at("finish"), step.finish, extent, seed),
  };
}

/** What `pliant.sketch` will read again. */
function drawingOf(step: Fields): SketchOptions {
  const given = drawingKeys.filter((key) => step[key] !== undefined);
  return Object.fromEntries(given.map((key) => [key, step[key]])) as object as SketchOptions;
}

function readPose(place: Place, step: Fields): PosePlan {
  const { bend, twist, scale, turning, twistSpeed, morph = 1 } = step;
  if ([bend, twist, scale, turning].every((asked) => asked === undefined)) {
    place.reject("has no bend, twist, scale or turning and asks for nothing; expected at least one of them");
  }
  if (twistSpeed !== undefined && twist === undefined) place.at("twistSpeed").reject("is given without twist; expected both or neither");
  return {
    bend: readPairs(place.at("bend"), bend, "target"),
    degrees: twist === undefined ? undefined : readDegrees(place.at("twist"), twist),
    scale: readPairs(place.at("scale"), scale, "profile"),
    turning: readPairs(place.at("turning"), turning, "profile"),
    twistSpeed: readPairs(place.at("twistSpeed"), twistSpeed, "profile"),
    morph: fraction(place.at("morph"), morph),
  };
}

function readPairs(place: Place, value: unknown, key: "target" | "profile"): Stroke | undefined {
  if (value === undefined) return undefined;
  const pairs = fields(place, value, [key])[key];
  new Packed().pairs(place.at(key), pairs);
  return pairs as Stroke;
}

function readDegrees(place: Place, value: unknown): number {
  return finite(place.at("degrees"), fields(place, value, ["degrees"]).degrees, "a finite number of degrees");
}

function readRegion(place: Place, { region }: Fields): RegionPlan {
  if (region === "previous") return region;
  if (typeof region === "string") place.fail(region, '"previous", or camera and reference of another stroke');
  const { camera, reference } = fields(place, region, ["camera", "reference"]);
  new Packed().camera(place.at("camera"), camera).pairs(place.at("reference"), reference);
  return { camera, reference } as { camera: Camera; reference: Stroke };
}

function readRefine(place: Place, value: unknown): { maxAdded?: number } | undefined {
  if (typeof value === "boolean") return value ? {} : undefined;
  if (typeof value !== "object" || value === null) place.fail(value, "true, false or an object with maxAdded");
  const { maxAdded } = fields(place, value, ["maxAdded"]);
  return maxAdded === undefined ? {} : { maxAdded: integer(place.at("maxAdded"), maxAdded, 0, maxCount) };
}

function readFinish(place: Place, value: unknown, extent: Extent, seed: number | undefined): FinishPlan {
  const finish = fields(place, value, ["method", "options", "spacing", "solve"]);
  const method = readMethod(place.at("method"), finish.method);
  return {
    options: readDeformer(place.at("options"), finish.options, method, extent, seed),
    spacing: finish.spacing === undefined ? undefined : notNegative(place.at("spacing"), finish.spacing),
    ...readSolve(place.at("solve"), finish.solve),
  };
}
