// The edit script as callers write it, and what comes of it (contract, section 3).

import type { FloatArray } from "../check.js";
import type { EmbeddedGraphOptions } from "../methods/index.js";
import type { Quality } from "../quality.js";
import type { Selection } from "../selection.js";
import type { ShapeReport } from "../shape.js";
import type { State } from "../state.js";
import type { Transform } from "../transform.js";

export interface EditScript {
  format: "pliant-edit";
  version: 1;
  /** Each starts from the result of the one before. Either steps or keyframes. */
  steps?: readonly ScriptStep[];
  /** The same steps at several times, with other moves. */
  keyframes?: readonly { time: number; steps: readonly ScriptStep[] }[];
  /** With keyframes: how many frames, evenly from the first time to the last. */
  frames?: number;
  /** 1. */
  seed?: number;
}

export interface ScriptStep {
  method: EmbeddedGraphOptions["method"];
  options?: Omit<EmbeddedGraphOptions, "method">;
  fixed?: readonly Selection[];
  handles: readonly ScriptHandle[];
  /** iterations: 100 in all. tolerance: 1e-6. */
  solve?: { iterations?: number; tolerance?: number };
  /** What happened under one grab, in order, after the first solve. */
  drag?: readonly ScriptDrag[];
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
}

export interface ScriptDrag {
  handles?: readonly (ScriptGoal & { name: string })[];
  /** Those that may change during a drag. */
  options?: object;
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

export interface EditResult {
  /** Of the input's vertices, in the precision the shape came in; with keyframes, of the last frame. */
  positions: FloatArray;
  report: EditReport;
  /** Of the last step. */
  state: State;
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
  /** One entry a drag of the script. */
  drag?: { factorizations: number; analyses: number; iterations: IterationReport[] }[];
}
