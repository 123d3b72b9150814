// Editing by two strokes: one over a limb, a second where it should go.

import {
  fields, filled, finite, flag, type FloatArray, fraction, integer, notNegative, Place, vector,
} from "../boundary/check.js";
import { build, type Core } from "../boundary/core.js";
import type { RawScratch, RawSketch, RawStatus, RawValues } from "../boundary/raw.js";
import { insideOf, type Shape, shapeFor } from "../shape/shape.js";
import { Deformation } from "./deformation.js";
import {
  type Camera, type Hold, type Mirror, poseOf, type Profile, readCamera, readDrawing, readPairs, readPose,
  type SketchPose, type Stroke,
} from "./sketch_input.js";

export type { Camera, Hold, Mirror, Profile, SketchPose, Stroke };

export interface SketchOptions {
  camera: Camera;
  /** Drawn along the limb: one end is held, the other moved. */
  reference: Stroke;
  /**
   * Which end is held: the larger side of the shape, whichever way one draws ("larger", the default; the start where
   * both are about equal), or that where the stroke starts or ends.
   */
  hold?: Hold;
  /** Lines across the shape; what each cuts off the region becomes a rigid part. */
  partitions?: readonly Stroke[];
  /** Smooths the parameters over the region (eq. 9): true. */
  smooth?: boolean;
  /** The same on the limb mirrored in this plane, too. */
  mirror?: Mirror;
  /**
   * Takes over a region instead of choosing one: a label a vertex, as `labels()` gives them. Not with partitions or
   * mirror.
   */
  labels?: ArrayLike<number>;
}

/** Handles for a solver that finishes what the sketch began. */
export interface SketchSeed {
  /** For `setFixed`: the static part. */
  fixed: Uint32Array;
  /** For `addHandle`: the rigid parts whole, and spread vertices of the region. */
  vertices: Uint32Array;
  /** For `moveTo`: three numbers a vertex. */
  targets: Float64Array;
}

/** What refinement added. The input's n vertices come first, then the added ones. */
export interface Refinement {
  /** Two ids an added vertex, which lies in the middle between them; they may be added ones before it. */
  parents: Uint32Array;
  /** In place of the input's: three ids a triangle. */
  triangles: Uint32Array;
  /** Of each triangle, the input's it is a part of. */
  triangleParents: Uint32Array;
}

/**
 * What `sketch.state()` gives: plain data; fields as in docs/state-and-report.md. A bend takes a vertex v to T(s) + R
 * (v - C(s)): C and T are the reference and the target at s, linear between nodes of equal steps, R turns by its angle
 * about the normal.
 */
export interface SketchState {
  /** 0 static, 1 region, 2 and above rigid parts; one a vertex of the input. */
  labels: number[];
  s: number[];
  /** Radians, right-handed about `normals`; where nothing bends, those of the twist. */
  angles: number[];
  /** Nodes of the curves; with a mirror those of the mirrored side follow. */
  reference: number[][];
  target: number[][];
  /** Of the planes of the curves, one a side. */
  normals: number[][];
  /** The whole pose, as `pose()` gives it, and the part of the way to it that is shown. */
  pose: SketchPose;
  morph: number;
  /** With a mirror: 0 for a vertex of the drawn side, 1 for one of the mirrored. */
  sides?: number[];
  /**
   * With twist or scale: middles of the sections, nodes of a curve as `reference`; angles about it and factors of the
   * vertices, applied before the bend.
   */
  joints?: number[][];
  twists?: number[];
  scales?: number[];
  /** After refinement: where the added vertices are at rest, and the two that each lies between. */
  rest?: number[][];
  parents?: number[][];
  [field: string]: unknown;
}

export const defaultMaxAdded = 1_000_000;

/**
 * A shape, the region that a stroke chose on it, and its pose. Made by `pliant.sketch`.
 *
 * Bend, twist and scale add up; each call replaces what it set before and is cheap enough for every
 * event of a pen. `reset` keeps the region and smoothing. `restore` takes the pose and the morph of a state over the
 * same reference; vertices that refinement added have to be those of now, and a state without any takes them back.
 */
export class Sketch extends Deformation<SketchState, RawSketch> {
  /** @internal */
  constructor(core: Core, shape: Shape, options: SketchOptions) {
    shapeFor(core, shape);
    if (shape.dimension !== 3) {
      new Place("invalid-shape", "shape").reject("lies in the plane; expected a mesh in space to sketch on");
    }
    const drawing = readSketch(options);
    const raw = build(core, () => new core.raw.Sketch(), (unbuilt) =>
      insideOf(shape).owned.call((rawShape) => unbuilt.build(rawShape, ...core.stageValues(drawing))));
    super(core, shape, raw, "sketch");
  }

  /**
   * Another reference stroke over the same region, maybe seen from elsewhere; back to rest. Errors: invalid-option;
   * nothing changes then.
   */
  redraw(camera: Camera, reference: Stroke): void {
    const drawing = { ...readCamera(option("camera"), camera), reference: readPairs(option("reference"), reference) };
    this.owned.accept((raw) => raw.redraw(...this.owned.core.stageValues(drawing)));
  }

  /** The end of the reference that is held. */
  held(): "start" | "end" {
    return this.owned.call((raw) => (raw.heldAtEnd() ? "end" : "start"));
  }

  // -- Posing. --------------------------------------------------------------------------------------

  /**
   * Bends the reference curve into the target stroke, drawn the same way and moved so that the held ends are one. While
   * it is drawn: `unfinished` goes on by what is left of the reference, so that the limb keeps its
   * length. Errors: invalid-option.
   */
  bend(target: Stroke, options: { unfinished?: boolean } = {}): void {
    const place = option("options");
    const { unfinished = false } = fields(place, options, ["unfinished"]);
    const open = flag(place.at("unfinished"), unfinished);
    const samples = readPairs(option("target"), target);
    this.owned.accept((raw) => raw.bend(this.owned.core.stage(samples), open));
  }

  /** Takes the bend back; twist and scale stay. */
  unbend(): void {
    this.owned.call((raw) => raw.unbend());
  }

  /**
   * Twists the limb, right-handed about the stroke's direction, by any angle between its ends. Errors: invalid-option,
   * also where the stroke runs beside the shape.
   */
  twist(degrees: number): void {
    const radians = (finite(option("degrees"), degrees, "a finite number of degrees") * Math.PI) / 180;
    this.owned.accept((raw) => raw.twist(radians));
  }

  /** Scales the limb about the middle of its sections by factors above 0 over s. Errors: as `twist`. */
  scale(profile: Profile): void {
    this.#profile(profile, (raw, scratch) => raw.setScale(scratch));
  }

  /** Turns the target by F(s) - s radians a unit of s; [[0, 0], [1, 1]]: as drawn. Errors: invalid-option. */
  turning(profile: Profile): void {
    this.#profile(profile, (raw, scratch) => raw.setTurning(scratch));
  }

  /** The twist at s is F(s) times its angle; [[0, 0], [1, 1]]: evenly. Errors: invalid-option. */
  twistSpeed(profile: Profile): void {
    this.#profile(profile, (raw, scratch) => raw.setTwistSpeed(scratch));
  }

  /** Whether the parameters are smoothed over the region; the pose stays. */
  setSmooth(smooth: boolean): void {
    const value = flag(option("smooth"), smooth);
    this.owned.call((raw) => raw.setSmooth(value));
  }

  /** Shows the way from rest (0) to the pose (1) by lengths and angles. Errors: invalid-option. */
  morph(t: number): void {
    const checked = fraction(option("morph"), t);
    this.owned.accept((raw) => raw.setMorph(checked));
  }

  /** The whole pose, to be kept and set again. */
  pose(): SketchPose {
    return this.owned.call((raw) => poseOf(this.owned.core.stagedValues((scratch) => raw.pose(scratch))));
  }

  /**
   * Sets a pose, or what lies the part t of the way `toward` another. Its spline controls are in it: they return to
   * the identity. Errors: invalid-option.
   */
  setPose(pose: SketchPose, toward?: SketchPose, t = 0): void {
    const from = readPose(option("pose"), pose);
    const to = toward === undefined ? {} : readPose(option("toward"), toward, "toward/");
    const checked = fraction(option("t"), t);
    this.owned.accept((raw) => raw.setPose(...this.owned.core.stageValues({ ...from, ...to }), checked));
  }

  // -- Refinement. ----------------------------------------------------------------------------------

  /**
   * Splits edges that the pose stretches and bends, again and again; later poses move the added vertices too.
   * `maxAdded`: 1,000,000. Errors: invalid-option, too-large.
   */
  refine(options: { maxAdded?: number } = {}): Refinement {
    const place = option("options");
    const { maxAdded = defaultMaxAdded } = fields(place, options, ["maxAdded"]);
    const most = integer(place.at("maxAdded"), maxAdded, 0, 2 ** 31 - 1);
    const { core } = this.owned;
    this.owned.accept((raw) =>
      core.stageOnce([], insideOf(this.shape).triangles, (scratch) => raw.refine(scratch, most)),
    );
    return this.refinement!;
  }

  /** Takes the refinement back. */
  unrefine(): void {
    this.owned.call((raw) => raw.unrefine());
  }

  /** What `refine` added; undefined without it. */
  get refinement(): Refinement | undefined {
    return this.owned.call((raw) =>
      raw.added() < 0
        ? undefined
        : {
            parents: Uint32Array.from(raw.parents()),
            triangles: raw.triangles().slice(),
            triangleParents: raw.triangleParents().slice(),
          },
    );
  }

  override get vertices(): number {
    return this.shape.report.vertices + Math.max(0, this.owned.call((raw) => raw.added()));
  }

  // -- Results. -------------------------------------------------------------------------------------

  /** 0 static, 1 region, 2 and above rigid parts; one a vertex of the input. They do not change. */
  labels(): Uint32Array {
    return this.owned.call((raw) => Uint32Array.from(raw.labels()));
  }

  /** Normalised arc length s of every vertex along the reference, from its held end; 0 in the static part. */
  parameters(): Float32Array;
  parameters<T extends FloatArray>(out: T): T;
  parameters(out?: FloatArray): FloatArray {
    return this.into(out, 1, (raw, result) => result.set(raw.parameters()));
  }

  /** The reference curve in space, three numbers a node. */
  reference(): Float64Array {
    return this.owned.call((raw) => raw.reference().slice());
  }

  /** The curve as it is bent now, as many nodes. */
  target(): Float64Array {
    return this.owned.call((raw) => raw.target().slice());
  }

  /** Positions at rest, of added vertices too. */
  restPositions(): Float32Array;
  restPositions<T extends FloatArray>(out: T): T;
  restPositions(out?: FloatArray): FloatArray {
    return this.into(out, 3, (raw, result) => result.set(raw.rest()));
  }

  /**
   * Targets for any deformer over the same shape. `spacing`: of region vertices, in diagonals of the shape (0.05).
   * Errors: invalid-option.
   */
  seed(options: { spacing?: number } = {}): SketchSeed {
    const place = option("options");
    const { spacing = 0.05 } = fields(place, options, ["spacing"]);
    const diagonals = notNegative(place.at("spacing"), spacing);
    return this.owned.call((raw) => {
      raw.seed(diagonals);
      return {
        fixed: Uint32Array.from(raw.seedFixed()),
        vertices: Uint32Array.from(raw.seedVertices()),
        targets: raw.seedTargets().slice(),
      };
    });
  }

  /** @internal */
  protected override get optionalFields(): readonly string[] {
    return [...super.optionalFields, "handles", "sides", "joints", "twists", "scales", "rest", "parents"];
  }

  #profile(profile: Profile, set: (raw: RawSketch, scratch: RawScratch) => RawStatus): void {
    const samples = readPairs(option("profile"), profile);
    this.owned.accept((raw) => set(raw, this.owned.core.stage(samples)));
  }
}

function option(name: string): Place {
  return new Place("invalid-option", name);
}

/**
 * The limb under a pixel as a reference stroke, from the body to the place under the pixel: for a gesture that begins
 * on a limb and leaves the shape at once. Errors: invalid-option (beside the shape, or no limb there).
 */
export function limbStroke(
  core: Core, shape: Shape, options: { camera: Camera; pixel: ArrayLike<number> },
): [x: number, y: number][] {
  shapeFor(core, shape);
  const { camera, pixel } = fields(option("options"), options, ["camera", "pixel"]);
  const drawing = { ...readCamera(option("camera"), camera), reference: vector(option("pixel"), pixel, 2) };
  const raw = build(core, () => new core.raw.Sketch(), (finder) => insideOf(shape).owned.call((rawShape) =>
    finder.findLimb(rawShape, ...core.stageValues(drawing))));
  try {
    const numbers = raw.foundLimb();
    return Array.from({ length: numbers.length / 2 }, (_, i) => [numbers[2 * i], numbers[2 * i + 1]]);
  } finally {
    raw.delete();
  }
}

const known = ["camera", "reference", "hold", "partitions", "smooth", "mirror", "labels"];

function readSketch(value: unknown): RawValues {
  const options = fields(option("options"), value, known, "option of a sketch");
  const drawing = readDrawing(option(""), options);
  if (options.labels === undefined) return drawing;
  const given = filled(option("labels"), options.labels, "a label a vertex");
  return {
    ...drawing,
    labels: Array.from(given, (label, i) => integer(option("labels").item(i), label, 0, 2 ** 31 - 1, "a label")),
  };
}
