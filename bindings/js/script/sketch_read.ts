// Reads the sketch steps of a script.

import { fields, type Fields, finite, flag, integer, type Place } from "../check.js";
import { type DeformerOptions, readMethod, readOptions } from "../methods/index.js";
import type { Extent } from "../selection.js";
import type { Camera, Profile, SketchOptions, Stroke } from "../sketch.js";
import { Packed, readSpacing } from "../sketch_input.js";
import { maxCount, readSolve, type SolvePlan } from "./solve.js";

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
const otherKeys = ["camera", "reference", "partitions", "smooth", "mirror", "region", "refine", "finish"] as const;

export function readSketchStep(place: Place, value: unknown, extent: Extent, seed: number | undefined): SketchPlan {
  const step = fields(place, value, ["method", ...otherKeys, ...poseKeys]);
  readDrawing(place, step);
  const pose = readPose(place, step);
  const region = step.region === undefined ? undefined : readRegion(place.at("region"), step);
  if (region === "previous" && step.partitions !== undefined) place.reject('has partitions beside "region": "previous"; expected one or the other');
  if (region === "previous" && step.mirror !== undefined) place.reject('has mirror beside "region": "previous"; expected one or the other');
  const refine = readRefine(place.at("refine"), step.refine ?? false);
  if (refine && step.finish !== undefined) place.reject("has refine and finish; expected one or the other");
  return {
    place, region, pose, toward: undefined, refine,
    sketch: drawing(step, "camera", "reference", "partitions", "smooth", "mirror"),
    finish: step.finish === undefined ? undefined : readFinish(place.at("finish"), step.finish, extent, seed),
  };
}

/** Checks what `pliant.sketch` will read again. */
function readDrawing(place: Place, step: Fields): void {
  const packed = new Packed().camera(place.at("camera"), step.camera).pairs(place.at("reference"), step.reference);
  if (step.partitions !== undefined) packed.partitions(place.at("partitions"), step.partitions);
  if (step.mirror !== undefined) packed.mirror(place.at("mirror"), step.mirror);
  if (step.smooth !== undefined) flag(place.at("smooth"), step.smooth);
}

/** Those of the keys that are given. */
function drawing(step: Fields, ...keys: (keyof SketchOptions)[]): SketchOptions {
  return Object.fromEntries(keys.filter((key) => step[key] !== undefined).map((key) => [key, step[key]])) as object as SketchOptions;
}

function readPose(place: Place, step: Fields): PosePlan {
  const { bend, twist, scale, turning, twistSpeed, morph = 1 } = step;
  if ([bend, twist, scale, turning].every((asked) => asked === undefined)) {
    place.reject("has no bend, twist, scale or turning and asks for nothing; expected at least one of them");
  }
  if (twistSpeed !== undefined && twist === undefined) place.at("twistSpeed").reject("is given without twist; expected both or neither");
  const share = finite(place.at("morph"), morph, "a number from 0 to 1");
  if (share < 0 || share > 1) place.at("morph").fail(morph, "a number from 0 to 1");
  return {
    bend: readPairs(place.at("bend"), bend, "target"),
    degrees: twist === undefined ? undefined : readDegrees(place.at("twist"), twist),
    scale: readPairs(place.at("scale"), scale, "profile"),
    turning: readPairs(place.at("turning"), turning, "profile"),
    twistSpeed: readPairs(place.at("twistSpeed"), twistSpeed, "profile"),
    morph: share,
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
  readOptions(place.at("options"), finish.options ?? {}, method, extent);
  const spacing = finish.spacing === undefined ? undefined : readSpacing(place.at("spacing"), finish.spacing);
  const seeded = seed !== undefined && "seed" in method.options ? { seed } : {};
  const options = { ...seeded, ...(finish.options as object), method: method.name } as DeformerOptions;
  return { options, spacing, ...readSolve(place.at("solve"), finish.solve) };
}
