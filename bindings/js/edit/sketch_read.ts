// Reads the sketch steps of a script.

import { fields, type Fields, finite, flag, fraction, integer, notNegative, type Place } from "../boundary/check.js";
import { readMethod } from "../methods/index.js";
import type { Extent } from "../shape/selection.js";
import type { Camera, Profile, SketchOptions, Stroke } from "../deform/sketch.js";
import { readCamera, readDrawing, readPairs } from "../deform/sketch_input.js";
import { readFollow } from "./follow.js";
import type { DrawnRegion, FinishPlan, PosePlan, SketchPlan } from "./plan.js";
import { maxCount, readDeformer, readSolve } from "./solve.js";

/** What may differ between keyframes. */
export const poseKeys = ["bend", "twist", "scale", "turning", "twistSpeed", "morph"] as const;
const drawingKeys = ["camera", "reference", "hold", "partitions", "smooth", "mirror"] as const;

export function readSketchStep(place: Place, value: unknown, extent: Extent, seed: number | undefined): SketchPlan {
  const step = fields(place, value, ["method", ...drawingKeys, ...poseKeys, "region", "refine", "finish", "follow"]);
  readDrawing(place, step);
  const pose = readPose(place, step);
  const region = step.region === undefined ? undefined : readRegion(place.at("region"), step);
  for (const key of ["partitions", "mirror"]) {
    if (region !== "previous" || step[key] === undefined) continue;
    place.reject(`has ${key} beside "region": "previous"; expected one or the other`);
  }
  const refine = readRefine(place.at("refine"), step.refine ?? false);
  if (refine && step.finish !== undefined) place.reject("has refine and finish; expected one or the other");
  return {
    kind: "sketch", place, source: value, region, pose, toward: undefined, refine,
    sketch: drawingOf(step),
    follow: readFollow(place.at("follow"), step.follow, extent),
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
  if (twistSpeed !== undefined && twist === undefined) {
    place.at("twistSpeed").reject("is given without twist; expected both or neither");
  }
  return {
    bend: readBend(place.at("bend"), bend),
    degrees: twist === undefined ? undefined : readDegrees(place.at("twist"), twist),
    scale: readProfile(place.at("scale"), scale),
    turning: readProfile(place.at("turning"), turning),
    twistSpeed: readProfile(place.at("twistSpeed"), twistSpeed),
    morph: fraction(place.at("morph"), morph),
  };
}

function readBend(place: Place, value: unknown): PosePlan["bend"] {
  if (value === undefined) return undefined;
  const { target, unfinished = false } = fields(place, value, ["target", "unfinished"]);
  readPairs(place.at("target"), target);
  return { target: target as Stroke, unfinished: flag(place.at("unfinished"), unfinished) };
}

function readProfile(place: Place, value: unknown): Profile | undefined {
  if (value === undefined) return undefined;
  const { profile } = fields(place, value, ["profile"]);
  readPairs(place.at("profile"), profile);
  return profile as Profile;
}

function readDegrees(place: Place, value: unknown): number {
  return finite(place.at("degrees"), fields(place, value, ["degrees"]).degrees, "a finite number of degrees");
}

function readRegion(place: Place, { region }: Fields): DrawnRegion {
  if (region === "previous") return region;
  if (typeof region === "string") place.fail(region, '"previous", or camera and reference of another stroke');
  const { camera, reference } = fields(place, region, ["camera", "reference"]);
  readCamera(place.at("camera"), camera);
  readPairs(place.at("reference"), reference);
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
