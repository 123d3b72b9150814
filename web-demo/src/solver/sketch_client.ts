// The limb under strokes, in the worker. A picture is asked for at every event of the pen; while one
// is being made only the latest wish waits, so that the preview never lags behind the hand.
import { controls, profileOf, restKnots, sameKnots, sketchStep, type SketchDoc } from "../edit/sketch_doc.ts";
import type { EditScript, Pliant, Shape, Sketch } from "./pliant.ts";

/** What a stroke chose. */
export interface Limb {
  /** A label a vertex: 0 static, 1 region, 2.. rigid parts; and the normalised arc length. */
  labels: ArrayLike<number>;
  s: ArrayLike<number>;
  /** The reference curve in space, three numbers a node. */
  reference: Float64Array;
}

/** What a sketch shows. */
export interface SketchFrame extends Limb {
  positions: Float32Array;
  normals: Float32Array;
  /** The curve as it is bent, three numbers a node. */
  target: Float64Array;
  /** Vertices that refinement added, in the middle of their parents, and the triangles then. */
  refinement: { parents: ArrayLike<number>; triangles: Uint32Array } | undefined;
}

type Exclusive = <T>(job: () => Promise<T>) => Promise<T>;

export class SketchClient {
  private remote: Sketch | undefined;
  private applied: SketchDoc | undefined;
  private refined: SketchFrame["refinement"];
  private limb: Limb | undefined;
  private wish: { doc: SketchDoc; show: (frame: SketchFrame) => void; fail: (error: Error) => void } | undefined;
  private running: Promise<void> | undefined;

  constructor(private readonly pliant: () => Pliant, private readonly shape: () => Shape, private readonly exclusive: Exclusive) {}

  /** Chooses the limb if another one is drawn on, poses it, and tells what is to be seen. */
  apply(doc: SketchDoc): Promise<SketchFrame> {
    this.wish = undefined;
    return this.exclusive(() => this.follow(doc));
  }

  /** As `apply`, while the hand still moves: wishes that are overtaken are dropped. */
  preview(doc: SketchDoc, show: (frame: SketchFrame) => void, fail: (error: Error) => void): void {
    this.wish = { doc, show, fail };
    this.running ??= this.run();
  }

  async idle(): Promise<void> {
    while (this.running) await this.running;
  }

  /** The pose as a method finishes it, as the edit script says: coordinates. */
  async finished(doc: SketchDoc): Promise<Float64Array> {
    const script = { format: "pliant-edit", version: 1, steps: [sketchStep(doc)], seed: 1 } as unknown as EditScript;
    return this.exclusive(async () => Float64Array.from((await this.pliant().edit(this.shape(), script)).positions));
  }

  /** Coordinates in double, of added vertices too. */
  exact(count: number): Promise<Float64Array> {
    return this.exclusive(() => this.remote!.positions(new Float64Array(3 * count)));
  }

  /** Forgets the limb; called by the owner of the queue. */
  async release(): Promise<void> {
    await this.remote?.dispose();
    this.remote = this.applied = this.refined = this.limb = undefined;
  }

  private async run(): Promise<void> {
    while (this.wish) {
      const { doc, show, fail } = this.wish;
      this.wish = undefined;
      try {
        const frame = await this.exclusive(() => this.follow(doc));
        if (!this.wish) show(frame);
      } catch (error) {
        fail(error as Error);
      }
    }
    this.running = undefined;
  }

  private async follow(doc: SketchDoc): Promise<SketchFrame> {
    if (!this.remote || !sameLimb(this.applied!, doc)) await this.choose(doc);
    await this.pose(this.remote!, doc);
    return this.picture(this.remote!);
  }

  private async choose({ camera, reference, region, labels, partitions, mirror, smooth }: SketchDoc): Promise<void> {
    const more = { smooth, ...(mirror ? { mirror } : {}), ...(labels ? { labels } : { partitions }) };
    const drawn = typeof region === "object" ? region : { camera, reference };
    const remote = await this.pliant().sketch(this.shape(), { ...drawn, ...more });
    if (drawn === region) await remote.redraw(camera, reference);
    await this.release();
    this.remote = remote;
  }

  /** Calls for what differs from before; they travel together and are carried out in order. */
  private async pose(remote: Sketch, doc: SketchDoc): Promise<void> {
    const old = this.applied;
    this.applied = doc;
    const calls: Promise<unknown>[] = [];
    if (this.refined) calls.push(remote.unrefine());
    if (this.refined || doc.refine || (old && old.smooth !== doc.smooth)) this.limb = undefined;
    this.refined = undefined;
    if (doc.target !== old?.target || doc.unfinished !== old?.unfinished) {
      if (doc.target) calls.push(remote.bend(doc.target, doc.unfinished ? { unfinished: true } : {}));
      else if (old?.target) calls.push(remote.unbend());
    }
    for (const control of controls) {
      const before = old?.knots[control] ?? restKnots[control];
      if (!sameKnots(before, doc.knots[control])) calls.push(remote[control](profileOf(control, doc.knots[control])));
    }
    if (doc.twist !== (old?.twist ?? 0)) calls.push(remote.twist(doc.twist));
    if (old && doc.smooth !== old.smooth) calls.push(remote.setSmooth(doc.smooth));
    if (doc.morph !== (old?.morph ?? 1)) calls.push(remote.morph(doc.morph));
    try {
      await Promise.all(calls);
    } catch (error) {
      await Promise.allSettled(calls);
      await this.release(); // what was carried out is not known: the next call starts anew
      throw error;
    }
    if (doc.refine) this.refined = await remote.refine();
  }

  private async picture(remote: Sketch): Promise<SketchFrame> {
    const [positions, normals, target] = await Promise.all([remote.positions(), remote.normals(), remote.target()]);
    this.limb ??= await this.describe(remote);
    return { ...this.limb, positions, normals, target, refinement: this.refined };
  }

  /** What stays while the limb is posed. */
  private async describe(remote: Sketch): Promise<Limb> {
    const [labels, s, reference] = await Promise.all([remote.labels(), remote.parameters(), remote.reference()]);
    return { labels, s, reference };
  }
}

const sameLimb = (a: SketchDoc, b: SketchDoc): boolean =>
  a.camera === b.camera && a.reference === b.reference && a.region === b.region && a.partitions === b.partitions && a.mirror === b.mirror;
