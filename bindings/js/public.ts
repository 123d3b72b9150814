// What every entry of the package exports beside its `init`.

export type { FloatArray } from "./check.js";
export { type Counters, Deformer, type Solution, type SolveOptions, type Step, type StepOptions } from "./deformer.js";
export { type ErrorCode, PliantError } from "./errors.js";
export { Handle } from "./handle.js";
export type { Init } from "./init.js";
export type { ArapOptions, DeformerOptions, EdgeMaterialOptions, EmbeddedGraphOptions, LiveOptions, MaterialField, MethodName } from "./methods/index.js";
export { Pliant } from "./pliant.js";
export type { MeasureOptions, Quality } from "./quality.js";
export type * from "./script/types.js";
export type { Selection } from "./selection.js";
export { Shape, type ShapeInput, type ShapeReport } from "./shape.js";
export {
  type Camera, type Mirror, type Profile, type Refinement, Sketch, type SketchOptions, type SketchPose, type SketchSeed, type SketchState, type Stroke,
} from "./sketch.js";
export type { HandleState, State } from "./state.js";
export type { Transform } from "./transform.js";
export type { InitOptions } from "./wasm.js";
