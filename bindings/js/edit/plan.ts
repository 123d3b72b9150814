// A document after reading: every value checked, every selection a function of the rest positions.

import type { Place } from "../boundary/check.js";
import type { Camera, Profile, SketchOptions, Stroke } from "../deform/sketch.js";
import type { DeformerOptions, LiveOptions } from "../methods/index.js";
import type { Select } from "../shape/selection.js";
import type { Transform } from "../shape/transform.js";

/** Where a handle goes. */
export type Goal = { move: Transform } | { targets: ArrayLike<number>; place: Place };

export interface HandlePlan {
  place: Place;
  name: string | undefined;
  select: Select;
  goal: Goal | undefined;
  /** How far in front it lies, where the step says so. */
  depth?: number;
}

export interface RegionPlan {
  place: Place;
  select: Select;
}

/** A part of the shape that goes along with another. */
export interface FollowPlan {
  follows: RegionPlan;
  along: RegionPlan;
}

export interface DragPlan {
  source: unknown;
  /** By the position of the handle in the step. */
  goals: { handle: number; goal: Goal }[];
  /** Checked, and read again by the deformer. */
  options: LiveOptions[keyof LiveOptions];
  iterations: number;
}

/** How long to solve. */
export interface SolvePlan {
  iterations: number;
  tolerance: number;
}

/** `source`: the step as it was written; what has the same source has the same plan. */
interface Planned<Kind extends string> {
  kind: Kind;
  place: Place;
  source: unknown;
}

export interface SolverPlan extends Planned<"solver">, SolvePlan {
  /** Checked, and read again by the deformer. */
  options: DeformerOptions;
  fixed: RegionPlan[];
  handles: HandlePlan[];
  drag: DragPlan[];
  follow: readonly FollowPlan[];
}

/** How a limb is posed. */
export interface PosePlan {
  bend: { target: Stroke; unfinished: boolean } | undefined;
  degrees: number | undefined;
  scale: Profile | undefined;
  turning: Profile | undefined;
  twistSpeed: Profile | undefined;
  morph: number;
}

/** The region of another stroke: drawn before this one, or that of the sketch step before. */
export type DrawnRegion = { camera: Camera; reference: Stroke } | "previous";

/** A solver that goes on from the pose. */
export interface FinishPlan extends SolvePlan {
  options: DeformerOptions;
  spacing: number | undefined;
}

export interface SketchPlan extends Planned<"sketch"> {
  /** Checked, and read again by the sketch. */
  sketch: SketchOptions;
  region: DrawnRegion | undefined;
  pose: PosePlan;
  /** Between keyframes: the pose to come, and which part t of the way to it. */
  toward: { pose: PosePlan; t: number } | undefined;
  refine: { maxAdded?: number } | undefined;
  finish: FinishPlan | undefined;
  follow: readonly FollowPlan[];
}

export interface PlacePlan extends Planned<"place"> {
  parts: (HandlePlan & { goal: Goal })[];
}

export type StepPlan = SolverPlan | SketchPlan | PlacePlan;

export interface Keyframe {
  time: number;
  steps: StepPlan[];
}

export interface ScriptPlan {
  /** One where the script has steps. */
  keyframes: Keyframe[];
  /** How many frames to make; undefined where the script has steps. */
  frames: number | undefined;
}
