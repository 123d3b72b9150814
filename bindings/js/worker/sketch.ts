// Sketches of pliant/worker.

import type { FloatArray } from "../boundary/check.js";
import type { Camera, Profile, Refinement, Sketch, SketchPose, SketchSeed, SketchState, Stroke } from "../deform/sketch.js";
import type { Line } from "./line.js";
import type { WorkerShape } from "./objects.js";
import type { Reference } from "./protocol.js";
import { Remote } from "./remote.js";

/** See {@link Sketch}. */
export class WorkerSketch extends Remote {
  readonly shape: WorkerShape;

  /** @internal */
  constructor(line: Line, reference: Reference, shape: WorkerShape) {
    super(line, reference);
    this.shape = shape;
  }

  redraw(camera: Camera, reference: Stroke): Promise<void> {
    return this.call("redraw", camera, reference);
  }

  bend(target: Stroke, options: { unfinished?: boolean } = {}): Promise<void> {
    return this.call("bend", target, options);
  }

  unbend(): Promise<void> {
    return this.call("unbend");
  }

  twist(degrees: number): Promise<void> {
    return this.call("twist", degrees);
  }

  scale(profile: Profile): Promise<void> {
    return this.call("scale", profile);
  }

  turning(profile: Profile): Promise<void> {
    return this.call("turning", profile);
  }

  twistSpeed(profile: Profile): Promise<void> {
    return this.call("twistSpeed", profile);
  }

  setSmooth(smooth: boolean): Promise<void> {
    return this.call("setSmooth", smooth);
  }

  morph(t: number): Promise<void> {
    return this.call("morph", t);
  }

  pose(): Promise<SketchPose> {
    return this.call("pose");
  }

  setPose(pose: SketchPose, toward?: SketchPose, t = 0): Promise<void> {
    return this.call("setPose", pose, toward, t);
  }

  reset(): Promise<void> {
    return this.call("reset");
  }

  refine(options: { maxAdded?: number } = {}): Promise<Refinement> {
    return this.call("refine", options);
  }

  unrefine(): Promise<void> {
    return this.call("unrefine");
  }

  labels(): Promise<Uint32Array> {
    return this.call("labels");
  }

  parameters(): Promise<Float32Array>;
  parameters<T extends FloatArray>(out: T): Promise<T>;
  parameters(out?: FloatArray): Promise<FloatArray> {
    return this.callInto(out, "parameters");
  }

  reference(): Promise<Float64Array> {
    return this.call("reference");
  }

  target(): Promise<Float64Array> {
    return this.call("target");
  }

  positions(): Promise<Float32Array>;
  positions<T extends FloatArray>(out: T): Promise<T>;
  positions(out?: FloatArray): Promise<FloatArray> {
    return this.callInto(out, "positions");
  }

  restPositions(): Promise<Float32Array>;
  restPositions<T extends FloatArray>(out: T): Promise<T>;
  restPositions(out?: FloatArray): Promise<FloatArray> {
    return this.callInto(out, "restPositions");
  }

  normals(): Promise<Float32Array>;
  normals<T extends FloatArray>(out: T): Promise<T>;
  normals(out?: FloatArray): Promise<FloatArray> {
    return this.callInto(out, "normals");
  }

  seed(options: { spacing?: number } = {}): Promise<SketchSeed> {
    return this.call("seed", options);
  }

  state(): Promise<SketchState> {
    return this.call("state");
  }

  dispose(): Promise<void> {
    return this.call("dispose");
  }
}
