// The edit script as callers write it, and what comes of it (docs/edit-script.md, docs/state-and-report.md).

import type { FloatArray } from "../boundary/check.js";
import type { Step } from "../deform/deformer.js";
import type { LiveOptions, MethodName, MethodOptions } from "../methods/index.js";
import type { Quality } from "../shape/quality.js";
import type { Selection } from "../shape/selection.js";
import type { ShapeReport } from "../shape/shape.js";
import type { Camera, Hold, Mirror, Profile, Refinement, Stroke } from "../deform/sketch.js";
import type { State } from "../boundary/state.js";
import type { Transform } from "../shape/transform.js";

export interface EditScript {
  format: "pliant-edit";
  version: 1;
  /** Each starts from the result of the one before. Either steps or keyframes. */
  steps?: readonly ScriptAnyStep[];
  /** The same steps at several times, with other moves or poses. */
  keyframes?: readonly { time: number; steps: readonly ScriptAnyStep[] }[];
  /** With keyframes: how many frames, evenly from the first time to the last. */
  frames?: number;
  /** 1. */
  seed?: number;
}

export type ScriptAnyStep = ScriptStep | ScriptSketch | ScriptPlace;

/** A method with a solver, and its options. */
export type ScriptMethod<M extends MethodName = MethodName> = {
  [N in M]: { method: N; options?: Omit<MethodOptions[N], "method"> };
}[M];

export type ScriptStep = {
  [M in MethodName]: ScriptMethod<M> & SolverStep & {
    /** What happened under one grab, in order, after the first solve. */
    drag?: readonly (ScriptDrag & { options?: LiveOptions[M] })[];
  };
}[MethodName];

/** What the steps of all methods with a solver have. */
export interface SolverStep {
  fixed?: readonly Selection[];
  /** May be left out where the options are a load: gravity. */
  handles?: readonly ScriptHandle[];
  /** iterations: 100 in all. tolerance: 1e-6. */
  solve?: { iterations?: number; tolerance?: number };
  follow?: readonly ScriptFollow[];
}

/** A loose part, which a method that follows the surface leaves behind: it goes along with what it lies on. */
export interface ScriptFollow {
  /** Moves as one, unless the step itself fixes, moves or draws on a vertex of it. */
  select: Selection;
  /** By the rigid motion that takes these vertices closest to where the step puts them. */
  along: Selection;
}

/** A part that has followed: x -> rotation x + translation, rotation row by row. */
export interface FollowState {
  vertices: number[];
  rotation: number[];
  translation: number[];
}

/** One limb, chosen by a stroke and posed by at least one of bend, twist, scale and turning, which add up. */
export interface ScriptSketch {
  method: "sketch";
  camera: Camera;
  reference: Stroke;
  /** "larger"; see `SketchOptions.hold`. */
  hold?: Hold;
  /** `unfinished`: see `Sketch.bend`. */
  bend?: { target: Stroke; unfinished?: boolean };
  twist?: { degrees: number };
  /** Over the section's size at rest. */
  scale?: { profile: Profile };
  /** See `Sketch.turning` and `Sketch.twistSpeed`. */
  turning?: { profile: Profile };
  twistSpeed?: { profile: Profile };
  partitions?: readonly Stroke[];
  /** true. */
  smooth?: boolean;
  mirror?: Mirror;
  /** Stops on the way from rest (0) to the pose (1). */
  morph?: number;
  /** The region of another stroke, with the partitions of this step; "previous": that of the sketch step before. */
  region?: { camera: Camera; reference: Stroke } | "previous";
  /**
   * Adds vertices, which follow those before, where the limb is stretched and bent: not in keyframes, not with finish.
   * maxAdded: 1,000,000.
   */
  refine?: boolean | { maxAdded?: number };
  /**
   * A solver goes on from the pose: the static part is fixed, rigid parts and region vertices `spacing` diagonals apart
   * (0.05) are its handle.
   */
  finish?: ScriptMethod & { spacing?: number; solve?: { iterations?: number; tolerance?: number } };
  follow?: readonly ScriptFollow[];
}

/** Vertices are put somewhere, and nothing is solved. */
export interface ScriptPlace {
  method: "place";
  /** Each has a move or targets. */
  parts: readonly Omit<ScriptHandle, "depth">[];
}

/** Where a handle goes; targets one a vertex, ascending vertex id. */
export interface ScriptGoal {
  move?: Transform;
  targets?: readonly ArrayLike<number>[] | FloatArray;
}

/** Without move and targets it stays where it is. */
export interface ScriptHandle extends ScriptGoal {
  name?: string;
  select: Selection;
  /**
   * In the plane: how far in front it lies, where the shape overlaps itself, larger over smaller; left out: 0, where
   * the
   * fixed region lies, too. It moves nothing. See `EditResult.depths`.
   */
  depth?: number;
}

export interface ScriptDrag {
  handles?: readonly (ScriptGoal & { name: string })[];
  /** 1. */
  iterations?: number;
}

export interface EditOptions {
  signal?: AbortSignal;
  /** Called after every iteration. */
  onProgress?: (progress: EditProgress) => void;
}

export interface EditProgress {
  frame: number;
  frames: number;
  step: number;
  steps: number;
  iteration: number;
  energy: number;
}

/** What a living edit carries out: an edit script with steps. */
export type EditDocument = Omit<EditScript, "keyframes" | "frames" | "steps"> & { steps: readonly ScriptAnyStep[] };

/** How far a phase has come. Plain data, part of a moment. */
export interface Progress {
  /** Energy before its first iteration. */
  start: number;
  iterations: IterationReport[];
  converged: boolean;
  /** Nothing more would come of it. */
  settled: boolean;
  factorizations: number;
  analyses: number;
}

/** What a stage was at some time: plain data, which takes it back there. */
export interface StageMoment {
  /** The step it stood for. */
  source: unknown;
  /** Of its solver. */
  progress: Progress[];
  /** Whether a pose or a placement had been shown. */
  shown?: boolean;
  /** Of its solver; absent where the step alone says what comes of it. */
  state?: State;
}

/** A document and how far it had been carried out, as `Edit.moment` gives it and `Edit.apply` takes it: plain data. */
export interface EditMoment {
  format: "pliant-moment";
  version: 1;
  /** None before the first document. */
  document: EditDocument | undefined;
  /** One a step whose result stood. */
  stages: readonly StageMoment[];
}

export interface RunOptions {
  milliseconds?: number;
  iterations?: number;
}

export interface SettleOptions {
  signal?: AbortSignal;
  /** Called after every iteration. */
  onProgress?: (progress: Omit<EditProgress, "frame" | "frames">) => void;
}

/** One iteration of the step at index `step`. */
export interface EditStep extends Step {
  step: number;
  /** The entry of the step's drag, from 0; -1: the step itself. */
  entry: number;
  /** Accepted iterations of it so far: what its `iterations` are where a session is written down. */
  done: number;
}

/** The last iteration of a run, and how many there were. */
export interface EditRun extends EditStep {
  iterations: number;
  /**
   * Nothing is left to do: each step's own test holds, nothing lowers its energy any more, or its iterations are used
   * up.
   */
  converged: boolean;
}

/** What is to be seen of a limb: see `labels`, `parameters`, `reference`, `target` and `refinement` of `Sketch`. */
export interface SketchView {
  labels: Uint32Array;
  parameters: Float32Array;
  reference: Float64Array;
  target: Float64Array;
  refinement: Refinement | undefined;
  /** The end of the reference that is held. */
  held: "start" | "end";
}

export interface EditResult {
  /**
   * Of the input's vertices and those that refinement added, in the precision the shape came in; with keyframes, of the
   * last frame.
   */
  positions: FloatArray;
  report: EditReport;
  /**
   * Of the last step; after a sketch its `SketchState`. Where vertices were added: their `parents`, and where they were
   * at `rest` in that step.
   */
  state: State;
  /** Where steps have refined the shape: what they added to the input in all. */
  refinement?: Refinement;
  /**
   * Where handles have a depth: that of every vertex, spread from the last step that has any (see `spreadDepths` of
   * pliant/picture).
   */
  depths?: Float64Array;
  /** With keyframes: the positions of every frame. */
  frames?: FloatArray[];
}

export interface EditReport {
  format: "pliant-report";
  version: 1;
  shape: ShapeReport;
  steps: StepReport[];
  quality: EditQuality;
  /** With keyframes. */
  frames?: { time: number; steps: StepReport[]; quality: EditQuality }[];
}

export interface EditQuality extends Quality {
  /** Largest distance of a handle's vertex from its target over the diagonal, in the last step. */
  constraintError: number;
}

export interface IterationReport {
  energy: number;
  ms: number;
}

export interface StepReport {
  method: string;
  unknowns: number;
  factorizations: number;
  analyses: number;
  setupMs: number;
  /** Energy before the first iteration. */
  start: number;
  /** One entry an accepted iteration. */
  iterations: IterationReport[];
  converged: boolean;
  /** `total` is the weighted sum of the others. */
  energy: Record<string, number>;
  /** Of a sketch: vertices that refinement added, and what the solver that finished it did. */
  added?: number;
  finish?: StepReport;
  /** One entry a drag of the script. */
  drag?: { factorizations: number; analyses: number; iterations: IterationReport[] }[];
}
