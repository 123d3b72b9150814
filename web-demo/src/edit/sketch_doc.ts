// A limb under two strokes, as the visitor made it: immutable, like the rest of the document.
import { followOf } from "../methods.ts";
import type { ShapeData } from "../shapes/shape.ts";
import type { DocumentStep } from "../solver/pliant.ts";
import type { Vec3 } from "./motion.ts";

/** Pixels of the picture the camera makes: origin at the top left, y down. */
export type Pixel = readonly [number, number];
export type Profile = readonly (readonly [number, number])[];

/** CAMERA of docs/edit-script.md. */
export interface SketchCamera {
  readonly eye: Vec3;
  readonly target: Vec3;
  readonly up: Vec3;
  readonly fovY: number;
  readonly width: number;
  readonly height: number;
}

/** The three spline controls. */
export const controls = ["turning", "scale", "twistSpeed"] as const;
export type Control = (typeof controls)[number];

/** A control by its values at s = 0, 1/4, 1/2, 3/4 and 1. */
export type Knots = readonly number[];

export interface SketchDoc {
  readonly camera: SketchCamera;
  /** Once it is chosen: from the held end on, and `hold` is "start". */
  readonly reference: readonly Pixel[];
  readonly hold: "larger" | "start";
  /** The region is not chosen by the reference: it was by another stroke, or is that of the step before (`labels`). */
  readonly region?: { readonly camera: SketchCamera; readonly reference: readonly Pixel[] } | "previous" | undefined;
  readonly labels?: ArrayLike<number> | undefined;
  /** Lines across the limb; what each cuts off follows rigidly. */
  readonly partitions: readonly (readonly [Pixel, Pixel])[];
  /** The plane the gesture is reflected in. */
  readonly mirror: { readonly normal: Vec3; readonly offset: number } | undefined;
  readonly target: readonly Pixel[] | undefined;
  /** The target is still being drawn. */
  readonly unfinished: boolean;
  /** Degrees, right-handed about the stroke. */
  readonly twist: number;
  readonly knots: Readonly<Record<Control, Knots>>;
  readonly smooth: boolean;
  readonly refine: boolean;
  readonly morph: number;
  /** The method that finishes it, or "" for the sketch as it is. */
  readonly finish: string;
}

/** What each control does at rest; turning is shown as the difference from "as drawn". */
export const restKnots: Readonly<Record<Control, Knots>> = {
  turning: [0, 0, 0, 0, 0],
  scale: [1, 1, 1, 1, 1],
  twistSpeed: [0, 0.25, 0.5, 0.75, 1],
};

export function newSketch(camera: SketchCamera, reference: readonly Pixel[], like?: SketchDoc): SketchDoc {
  return {
    camera, reference, hold: "larger", partitions: [], mirror: like?.mirror, target: undefined, unfinished: false,
    twist: 0, knots: restKnots, smooth: like?.smooth ?? true, refine: false, morph: 1, finish: like?.finish ?? "",
  };
}

/** A limb at rest seen through another camera, by the curve it lies on; `labels`: its region. */
export function seenAgain(
  old: SketchDoc, labels: ArrayLike<number>, camera: SketchCamera, reference: readonly Pixel[],
): SketchDoc {
  const fresh: SketchDoc = { ...newSketch(camera, reference, old), hold: "start" };
  if (old.mirror || (isPosed(old) && old.refine)) return fresh; // the region is chosen anew
  if (isPosed(old)) return { ...fresh, region: "previous", labels };
  const region = old.region ?? { camera: old.camera, reference: old.reference };
  return { ...fresh, region, labels: old.labels, partitions: old.partitions };
}

const reversed = <T>(line: readonly T[]): T[] => line.toReversed();

/** The limb as it was chosen, its stroke from the end that is held. */
export const fromHeld = (sketch: SketchDoc, held: "start" | "end"): SketchDoc =>
  ({ ...sketch, hold: "start", reference: held === "end" ? reversed(sketch.reference) : sketch.reference });

/**
 * The other end held: the same shape but for where it stands. The region is chosen anew, or by the other stroke
 * reversed.
 */
export function flipped({ reference, target, region, knots }: SketchDoc): Partial<SketchDoc> {
  const across = (control: Control, value: (there: number) => number) => reversed(knots[control]).map(value);
  const turned = knots.twistSpeed.at(-1)!;
  return {
    hold: "start", reference: reversed(reference), target: target && reversed(target), labels: undefined,
    region: typeof region === "object" ? { ...region, reference: reversed(region.reference) } : undefined,
    knots: {
      scale: across("scale", (x) => x),
      turning: across("turning", (x) => x),
      twistSpeed: across("twistSpeed", (x) => turned - x),
    },
  };
}

export const sameKnots = (a: Knots, b: Knots): boolean => a.every((x, i) => x === b[i]);
const atRest = (sketch: SketchDoc, control: Control) => sameKnots(sketch.knots[control], restKnots[control]);

/** Whether anything has been done to the limb. */
export const isPosed = (sketch: SketchDoc): boolean =>
  sketch.target !== undefined || sketch.twist !== 0 || !atRest(sketch, "turning") || !atRest(sketch, "scale");

/** What a control or a stroke changes: some parts, or what to make of those that are there when its turn comes. */
export type PoseChange = Partial<SketchDoc> | ((before: SketchDoc) => Partial<SketchDoc>);

export const posed = (sketch: SketchDoc, change: PoseChange): SketchDoc =>
  ({ ...sketch, unfinished: false, ...(typeof change === "function" ? change(sketch) : change) });

/** A smooth curve through knots at equal steps (Catmull and Rom), at t from 0 to 1. */
export function splineAt(knots: Knots, t: number): number {
  const last = knots.length - 1;
  const i = Math.min(last - 1, Math.floor(t * last));
  const u = t * last - i;
  const at = (k: number) => knots[Math.min(last, Math.max(0, k))]!;
  const [a, b] = [at(i), at(i + 1)];
  const [da, db] = [(b - at(i - 1)) / 2, (at(i + 2) - a) / 2];
  return a + u * (da + u * (3 * (b - a) - 2 * da - db + u * (2 * (a - b) + da + db)));
}

const samples = 24;

/** The control as the library takes it: turning is added to the straight line. */
export function profileOf(control: Control, knots: Knots): Profile {
  return Array.from({ length: samples + 1 }, (_, i) => {
    const s = i / samples;
    const value = splineAt(knots, s);
    return [s, control === "turning" ? s + value : control === "scale" ? Math.max(0.05, value) : value] as const;
  });
}

/** Thicker or thinner by `factor` from the place `s` on, smoothly from the held end. */
export const scaledFrom = (s: number, factor: number): Knots =>
  restKnots.scale.map((_, i) => {
    const u = Math.min(1, i / 4 / Math.max(s, 0.25));
    return 1 + (factor - 1) * u * u * (3 - 2 * u);
  });

const solve = { iterations: 300, tolerance: 1e-6 };

/** Nothing that is at rest is named. */
function profilesOf(sketch: SketchDoc) {
  const profile = (control: Control) =>
    (atRest(sketch, control) ? {} : { [control]: { profile: profileOf(control, sketch.knots[control]) } });
  const { twist } = sketch;
  return {
    ...(twist !== 0 ? { twist: { degrees: twist }, ...profile("twistSpeed") } : {}),
    ...profile("scale"), ...profile("turning"),
  };
}

function drawingOf({ camera, reference, hold, region, partitions, mirror, smooth }: SketchDoc) {
  return {
    method: "sketch" as const, camera, reference,
    ...(hold === "start" ? { hold } : {}),
    ...(region ? { region } : {}),
    ...(partitions.length > 0 ? { partitions } : {}),
    ...(mirror ? { mirror } : {}),
    smooth,
  };
}

const steps = new WeakMap<SketchDoc, DocumentStep>();

/** The step of the edit script (docs/edit-script.md), over its shape at rest; the same sketch gives the same object. */
export function sketchStep(sketch: SketchDoc, shape: ShapeData): DocumentStep {
  const known = steps.get(sketch);
  if (known) return known;
  const { target, unfinished, refine, morph, finish } = sketch;
  const step = {
    ...drawingOf(sketch),
    ...(target ? { bend: { target, ...(unfinished ? { unfinished } : {}) } } : {}),
    ...profilesOf(sketch),
    morph,
    ...(finish !== "" ? { finish: { method: finish, solve } } : { refine }),
    ...followOf(finish, shape),
  } as DocumentStep;
  steps.set(sketch, step);
  return step;
}

/** A limb that is chosen and stays at rest. */
export const chosenStep = (sketch: SketchDoc): DocumentStep =>
  ({ ...drawingOf(sketch), turning: { profile: [[0, 0], [1, 1]] } }) as DocumentStep;
