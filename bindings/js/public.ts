// What every entry of the package exports beside its `init`.

export type { FloatArray } from "./boundary/check.js";
export type { Deformation } from "./deform/deformation.js";
export {
  type Counters, Deformer, type Solution, type SolveOptions, type Step, type StepOptions,
} from "./deform/deformer.js";
export { type ErrorCode, PliantError } from "./boundary/errors.js";
export { Handle } from "./deform/handle.js";
export type { Init } from "./init.js";
export type {
  DeformerOptions, LiveOptions, MaterialField, MethodInfo, MethodName, OptionInfo,
} from "./methods/index.js";
export type { Color, Image, PictureInput } from "./picture/image.js";
export { Picture } from "./picture/picture.js";
export { Pliant } from "./pliant.js";
export type { MeasureOptions, Quality } from "./shape/quality.js";
export { Edit } from "./edit/living.js";
export type * from "./edit/types.js";
export type { LoosePart, Spot } from "./shape/patch.js";
export type { RigidTransform } from "./shape/rigid.js";
export type { Selection } from "./shape/selection.js";
export { Shape, type ShapeInput, type ShapeReport } from "./shape/shape.js";
export {
  type Camera, type Hold, type Mirror, type Profile, type Refinement, Sketch, type SketchOptions, type SketchPose,
  type SketchSeed, type SketchState, type Stroke,
} from "./deform/sketch.js";
export type { HandleState, State } from "./boundary/state.js";
export type { Transform } from "./shape/transform.js";
export type { InitOptions } from "./boundary/wasm.js";
