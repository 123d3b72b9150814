// Sketch: a stroke along a limb chooses it, the next ones say where it goes, how it turns, how thick it is.
import { scaledFrom, type Pixel, type PoseChange, type SketchDoc } from "../edit/sketch_doc.ts";
import { distance, fitted, lengthOf, pulled } from "./stroke.ts";
import type { Pointer, Stage, Tool } from "./tool.ts";

/** What a stroke on a chosen limb does. */
export const strokeModes = ["bend", "twist", "scale", "cut"] as const;
export type StrokeMode = (typeof strokeModes)[number];

type Gesture =
  | { kind: "reference" }
  | { kind: "bend" | "cut" }
  | { kind: "twist"; from: number; axis: Pixel }
  | { kind: "scale"; s: number; out: Pixel };

/** Pixels: how near the shape a stroke has to begin, and how long it has to be. */
const reach = 26;
const shortest = 12;
const degreesPerPixel = 0.75;
const pixelsPerDoubling = 110;
/** A stroke leaves the shape at once when less than a fifth of the places beyond a quarter of its length lie on it. */
const leavingShare = 0.25;
const stayingShare = 0.2;
const probes = 16;

export class SketchTool implements Tool {
  readonly id = "sketch";
  readonly label = "Sketch";
  readonly icon = "sketch" as const;
  readonly hint = "Draw along a limb, then where it should go. Drag beside it to look around.";
  mode: StrokeMode = "bend";
  /** The limb keeps its length however long the stroke is. */
  keepsLength = true;
  /** The plane gestures are reflected in, or none. */
  mirror: SketchDoc["mirror"];
  private gesture: Gesture | undefined;
  private ink: Pointer[] = [];
  private ready: Promise<boolean> = Promise.resolve(true);
  private isReady = true;
  /** Whether a limb is still being chosen: a stroke begun meanwhile says where it goes. */
  private choosing = false;
  private strokes = 0;

  constructor(private readonly stage: Stage) {}

  available(): boolean {
    return this.stage.present.sketchable;
  }

  down(at: Pointer): boolean {
    this.gesture = this.available() ? this.gestureFor(at) : undefined;
    if (!this.gesture) return false;
    this.ink = [at];
    this.strokes++;
    this.stage.session.dragging = true;
    this.followCamera();
    return true;
  }

  move(at: Pointer, samples: readonly Pointer[]): void {
    if (!this.gesture) return;
    for (const sample of samples) if (distance(sample, this.ink.at(-1)!) >= 1) this.ink.push(sample);
    const lasting = this.gesture.kind === "reference" || this.gesture.kind === "bend";
    this.stage.ink(lasting ? this.ink : this.gesture.kind === "cut" ? [this.ink[0]!, at] : undefined);
    const change = this.change(true);
    if (change && this.isReady && this.gesture.kind !== "cut") this.stage.present.preview(change);
  }

  up(): void {
    const { session } = this.stage;
    const gesture = this.gesture;
    const change = this.change(false);
    const label = `stroke ${this.strokes}`;
    this.end();
    if (gesture?.kind === "reference") {
      if (lengthOf(this.ink) >= shortest) this.choose();
      return;
    }
    if (change) void this.ready.then((went) => went && session.pose(change, label));
    else session.showAgain();
  }

  /** What a stroke runs along; or what it began on, pulled where it ends. */
  private choose(): void {
    const { session, viewport } = this.stage;
    const camera = viewport.sketchCamera();
    const pixels = this.pixels();
    const [from, to] = [pixels[0]!, pixels.at(-1)!];
    const target = (limb: readonly Pixel[]) => {
      const moved = pulled(limb, [to[0] - from[0], to[1] - from[1]]);
      return this.keepsLength ? fitted(moved, limb) : moved;
    };
    this.choosing = true;
    this.isReady = false;
    const done = this.leavesAtOnce()
      ? session.pullLimb(camera, from, this.mirror, target)
      : session.chooseLimb(camera, pixels, this.mirror);
    const ready = (this.ready = done.then((went) => {
      if (this.ready === ready) this.choosing = !(this.isReady = true);
      return went;
    }));
  }

  private leavesAtOnce(): boolean {
    const { ink } = this;
    if (!this.stage.pick(ink[0]!.x, ink[0]!.y)) return false;
    const whole = lengthOf(ink);
    const beyond = ink.filter((_, i) => lengthOf(ink.slice(0, i + 1)) > leavingShare * whole);
    const probed = beyond.filter((_, i) => i % Math.ceil(beyond.length / probes) === 0);
    return probed.filter(({ x, y }) => this.stage.pick(x, y)).length < stayingShare * probed.length;
  }

  cancel(): void {
    const posing = this.gesture && this.gesture.kind !== "reference";
    this.end();
    if (posing) this.stage.session.showAgain();
  }

  private end(): void {
    this.gesture = undefined;
    this.stage.session.dragging = false;
    this.stage.ink(undefined);
  }

  // -- What a press begins ------------------------------------------------------------------------

  private gestureFor(at: Pointer): Gesture | undefined {
    const { doc: { sketch }, sketched: frame } = this.stage.present;
    if (this.choosing) return this.mode === "bend" ? { kind: "bend" } : undefined;
    const hit = this.near(at);
    if (!sketch || !frame) return hit ? { kind: "reference" } : undefined;
    if (this.mode === "cut") return { kind: "cut" };
    const curve = this.curve(frame.target);
    const onLimb = hit !== undefined && (frame.labels[hit.vertex] ?? 1) > 0;
    // The region may begin further along than the stroke did; either place will do.
    const [x, y] = sketch.reference[0]!;
    const here = this.pixel(at);
    const gap = Math.min(distance(at, curve[0]!), Math.hypot(here[0] - x, here[1] - y));
    const byTheJoint = gap < Math.max(reach, 0.25 * lengthOf(curve));
    if (!onLimb && !(this.mode === "bend" && byTheJoint)) return hit ? { kind: "reference" } : undefined;
    if (this.mode === "bend") return { kind: "bend" };
    const along = unit(curve[0]!, curve.at(-1)!);
    if (this.mode === "twist") return { kind: "twist", from: sketch.twist, axis: [-along[1], along[0]] };
    return { kind: "scale", s: frame.parameters[hit!.vertex] ?? 1, out: outwards(at, curve) };
  }

  /** What lies under a press, or just beside it. */
  private near({ x, y }: Pointer) {
    for (const radius of [0, reach / 2, reach]) {
      for (let i = 0; i < (radius === 0 ? 1 : 8); i++) {
        const angle = (i * Math.PI) / 4;
        const hit = this.stage.pick(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
        if (hit) return hit;
      }
    }
    return undefined;
  }

  /**
   * Strokes are meant as they are seen. When the camera has turned since the limb was chosen, it is
   * chosen again from here, by the curve it lies on now.
   */
  private followCamera(): void {
    const { session, present: { doc: { sketch }, sketched }, viewport } = this.stage;
    if (this.choosing || !sketch || this.gesture!.kind === "reference" || !sketched) return;
    const camera = viewport.sketchCamera();
    if (JSON.stringify(camera) === JSON.stringify(sketch.camera)) return;
    this.isReady = false;
    if (this.gesture!.kind === "twist") this.gesture = { ...this.gesture!, from: 0 };
    this.ready = session
      .lookAgain(camera, viewport.curveInPicture(sketched.target), `stroke ${this.strokes}`)
      .then((went) => {
        this.isReady = true;
        return went;
      });
  }

  // -- What a stroke says -------------------------------------------------------------------------

  /**
   * What it finds in the sketch it takes from there when its turn comes: the limb may be seen from elsewhere by then.
   */
  private change(drawing: boolean): PoseChange | undefined {
    const { gesture } = this;
    if (
      !gesture ||
      gesture.kind === "reference" ||
      !(this.choosing || this.stage.present.doc.sketch) ||
      lengthOf(this.ink) < shortest
    ) {
      return undefined;
    }
    const [from, to] = [this.ink[0]!, this.ink.at(-1)!];
    const along = ([x, y]: Pixel) => (to.x - from.x) * x + (to.y - from.y) * y;
    switch (gesture.kind) {
      case "bend": {
        const target = this.pixels();
        if (!this.keepsLength) return { target, unfinished: drawing, morph: 1 };
        return ({ reference }) => ({ target: fitted(target, reference), morph: 1 });
      }
      case "twist":
        return { twist: Math.round(10 * (gesture.from + degreesPerPixel * along(gesture.axis))) / 10, morph: 1 };
      case "scale": {
        const factor = Math.min(3, Math.max(0.3, 2 ** (along(gesture.out) / pixelsPerDoubling)));
        return ({ knots }) => ({ knots: { ...knots, scale: scaledFrom(gesture.s, factor) }, morph: 1 });
      }
      case "cut": {
        const line = [this.pixel(from), this.pixel(to)] as const;
        return ({ partitions }) => ({ partitions: [...partitions, line], region: undefined, labels: undefined });
      }
    }
  }

  private pixel = ({ x, y }: Pointer): Pixel => this.stage.viewport.toPicture(x, y);
  private pixels = (): Pixel[] => this.ink.map(this.pixel);

  /** A curve in space as places on the page. */
  private curve(nodes: ArrayLike<number>): Pointer[] {
    const box = this.stage.viewport.canvas.getBoundingClientRect();
    return this.stage.viewport.curveOnScreen(nodes).map(({ x, y }) => ({ x: x + box.left, y: y + box.top }));
  }
}

function unit(a: Pointer, b: Pointer): Pixel {
  const length = distance(a, b) || 1;
  return [(b.x - a.x) / length, (b.y - a.y) / length];
}

/** Away from a curve, seen from a place beside it; upwards on it. */
function outwards(at: Pointer, curve: readonly Pointer[]): Pixel {
  const nearest = curve.reduce((best, p) => (distance(at, p) < distance(at, best) ? p : best));
  return distance(at, nearest) < 6 ? [0, -1] : unit(nearest, at);
}
