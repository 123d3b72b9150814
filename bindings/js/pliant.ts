// The started library.

import { fields, Place } from "./boundary/check.js";
import type { Core } from "./boundary/core.js";
import { readCallback, readSignal } from "./boundary/task.js";
import { Deformer } from "./deform/deformer.js";
import { type DeformerOptions, methodInfos, type MethodName } from "./methods/index.js";
import type { PictureInput } from "./picture/image.js";
import { Picture } from "./picture/picture.js";
import { measure, type MeasureOptions, type Quality } from "./shape/quality.js";
import { Edit } from "./edit/living.js";
import type { EditOptions, EditResult, EditScript } from "./edit/types.js";
import { type RigidTransform, rigidMotion } from "./shape/rigid.js";
import { Shape, shapeFor, type ShapeInput } from "./shape/shape.js";
import { type Camera, limbStroke, Sketch, type SketchOptions } from "./deform/sketch.js";

/** What `init` resolves to. */
export class Pliant {
  readonly #core: Core;

  /** @internal */
  constructor(core: Core) {
    this.#core = core;
  }

  /** The methods and their options, in the order of menus: what menus, sliders and documentation are made from. */
  readonly methods = methodInfos;

  /** Checks a shape and takes it in. Errors: invalid-shape, too-large. */
  shape(input: ShapeInput): Shape {
    return new Shape(this.#core, input);
  }

  /**
   * Traces the visible part of a picture and takes it in as a shape in the plane. Errors: invalid-shape,
   * invalid-option, too-large.
   */
  async picture(input: PictureInput): Promise<Picture> {
    const { meshOf } = await import("./picture/mesh.js");
    return new Picture(this.#core, meshOf(input));
  }

  /** Builds a deformer over a shape. Errors: invalid-option, too-large. */
  deformer<M extends MethodName>(shape: Shape, options: { method: M } & DeformerOptions<M>): Deformer<M> {
    return new Deformer(this.#core, shape, options);
  }

  /**
   * Chooses the limb of a mesh that a stroke was drawn on, to be posed by more strokes. Errors: invalid-shape,
   * invalid-option.
   */
  sketch(shape: Shape, options: SketchOptions): Sketch {
    return new Sketch(this.#core, shape, options);
  }

  /**
   * The limb under a pixel as a reference stroke, from the body to there: for a gesture that leaves the shape at once.
   * Errors: invalid-option.
   */
  limbStroke(shape: Shape, options: { camera: Camera; pixel: ArrayLike<number> }): [x: number, y: number][] {
    return limbStroke(this.#core, shape, options);
  }

  /** Compares a shape with deformed positions of its vertices. Errors: invalid-option. */
  measure(shape: Shape, positions: ArrayLike<number>, options?: MeasureOptions): Quality {
    return measure(this.#core, shape, positions, options);
  }

  /**
   * The rigid motion that takes points closest to others, by least squares: three numbers a point, as many of both.
   * Where they leave the turn open (one point, or all on a line) it is the smallest one. Errors: invalid-option.
   */
  rigidMotion(from: ArrayLike<number>, to: ArrayLike<number>): RigidTransform {
    return rigidMotion(this.#core, from, to);
  }

  /** A living edit of a shape, at rest: it carries out one document after another and keeps what it can. */
  open(shape: Shape): Edit {
    return new Edit(this.#core, shapeFor(this.#core, shape));
  }

  /** Runs an edit script. Errors: invalid-script, not-solvable, too-large, aborted. */
  async edit(shape: Shape, script: EditScript, options: EditOptions = {}): Promise<EditResult> {
    shapeFor(this.#core, shape);
    const place = new Place("invalid-option", "options");
    const given = fields(place, options, ["signal", "onProgress"]);
    const signal = readSignal(place.at("signal"), given.signal);
    const onProgress = readCallback<EditOptions["onProgress"]>(place.at("onProgress"), given.onProgress);
    const { edit } = await import("./edit/edit.js");
    return edit(this.#core, shape, script, { signal, onProgress });
  }
}
