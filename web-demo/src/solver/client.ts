// The one place that talks to the solver in its worker. Calls are made one after another; between
// them a loop steps until the shape is at rest, always towards the latest targets.
import type { Change, HandleDoc } from "../edit/document.ts";
import { asTransform, isAtRest, type Motion } from "../edit/motion.ts";
import { hasLoad, scriptOptions, type Options } from "../methods.ts";
import type { ShapeData } from "../shapes/shape.ts";
import { connect, type Deformer, type DeformerOptions, type Handle, type Pliant, type Shape, type ShapeReport, type State, type StepReport } from "./pliant.ts";
import { SketchClient } from "./sketch_client.ts";

/** What the screen shows after one run of the solver. */
export interface Frame {
  positions: Float32Array;
  normals: Float32Array;
  report: StepReport;
  /** Only while the graph is watched. */
  state?: State;
}

export interface SolverEvents {
  /** `change`: what was changed just before; `iterations`: steps taken since the last frame. */
  frame(frame: Frame, change: Change, iterations: number): void;
  /** At rest, or given up; not when a call cut the solving short. */
  settled(): void;
  failed(error: Error): void;
}

/** Solver time in one frame of the screen, in milliseconds: half of a 60th of a second. */
const frameBudget = 8;
/** Steps after the last change at which a shape that never comes to rest is left alone. */
const patience = 300;

/** Points of the plane, two numbers each, with z = 0. */
const inSpace = (flat: Float32Array) =>
  Float32Array.from({ length: (flat.length / 2) * 3 }, (_, i) => (i % 3 === 2 ? 0 : flat[2 * Math.floor(i / 3) + (i % 3)]!));

/** Where a handle starts: held parts at their places, others moved from rest. */
const flat = (held: Float32Array, dimension: 2 | 3) => (dimension === 2 ? held.filter((_, i) => i % 3 < 2) : held);

const nextFrame = () => new Promise<void>((resolve) => requestAnimationFrame(() => resolve()));

export class SolverClient {
  private constructor(private readonly pliant: Pliant, private readonly events: SolverEvents) {}

  static async start(events: SolverEvents): Promise<SolverClient> {
    return new SolverClient(await connect(), events);
  }

  private queue: Promise<unknown> = Promise.resolve();
  private data: ShapeData | undefined;
  private shape: Shape | undefined;
  private method = "";
  private options: Options = {};
  private deformer: Deformer | undefined;
  private dimension: 2 | 3 = 3;
  private handles = new Map<number, { remote: Handle; doc: HandleDoc }>();
  private pending = new Map<number, Motion>();
  private pendingOptions: Options | undefined;
  private stepsLeft = 0;
  private running: Promise<void> | undefined;
  private interrupted = false;
  private watching = false;
  /** Steps a frame; 0: as many as there is time for. */
  pace = 0;
  /** The limb under strokes, over the same shape. */
  readonly sketch = new SketchClient(() => this.pliant, () => this.shape!, (job) => this.exclusive(job));

  /** Runs a job when those before it are done. */
  private exclusive<T>(job: () => Promise<T>): Promise<T> {
    const result = this.queue.then(job);
    this.queue = result.catch(() => undefined);
    return result;
  }

  /** Another shape at rest; what was over the old one is freed once the new one stands. */
  take(data: ShapeData): Promise<ShapeReport & { diagonal: number }> {
    this.stop();
    return this.exclusive(async () => {
      if (this.data === data) return { ...this.shape!.report, diagonal: this.shape!.diagonal };
      const plane = data.dimension === 2;
      const source = data.exact ?? data.positions;
      const positions = plane ? source.filter((_, i) => i % 3 < 2) : source;
      const shape = await this.pliant.shape({ positions, triangles: data.triangles, ...(plane ? { dimension: 2 } : {}) });
      await this.release();
      await this.shape?.dispose();
      [this.shape, this.data, this.dimension] = [shape, data, data.dimension];
      return { ...shape.report, diagonal: shape.diagonal };
    });
  }

  private async release(): Promise<void> {
    await this.sketch.release();
    await this.deformer?.dispose();
    this.deformer = undefined;
    this.handles.clear();
  }

  /** A new method over the shape; the old deformer is freed only when the new one stands. */
  build(method: string, options: Options): Promise<void> {
    this.stop();
    return this.exclusive(async () => {
      const deformer = await this.make(method, options);
      await this.deformer?.dispose();
      [this.deformer, this.method, this.options] = [deformer, method, options];
      this.handles.clear();
    });
  }

  private make(method: string, options: Options): Promise<Deformer> {
    return this.pliant.deformer(this.shape!, { method, ...scriptOptions(method, options, this.data!) } as DeformerOptions);
  }

  /** Whether a deformer stands over the shape. */
  get ready(): boolean {
    return this.deformer !== undefined;
  }

  /** Replaces the fixed region and every handle; the deformation stays as it is. */
  constrain(fixed: Uint32Array, handles: readonly HandleDoc[]): Promise<void> {
    this.stop();
    return this.exclusive(async () => {
      const deformer = this.deformer!;
      for (const { remote } of this.handles.values()) await remote.remove();
      this.handles.clear();
      await deformer.setFixed(fixed);
      for (const doc of handles) {
        const remote = await deformer.addHandle(doc.vertices);
        if (doc.held) await remote.moveTo(flat(doc.held, this.dimension));
        else if (!isAtRest(doc.motion)) await remote.move(asTransform(doc.motion, doc.center, this.dimension));
        this.handles.set(doc.id, { remote, doc });
      }
    });
  }

  /** The newest motion of a handle; one that has not been solved for yet is dropped. */
  move(id: number, motion: Motion): void {
    this.pending.set(id, motion);
    this.wake();
  }

  /** Other values of options that can change while the shape moves. */
  setOptions(options: Options): void {
    this.pendingOptions = options;
    this.wake();
  }

  /** Steps until at rest. */
  wake(): void {
    this.stepsLeft = patience;
    this.interrupted = false;
    this.running ??= this.run();
  }

  /** Resolves when nothing moves any more. */
  async idle(): Promise<void> {
    while (this.running) await this.running;
    await this.sketch.idle();
    await this.queue;
  }

  /** While watched, frames carry the state of the method. */
  watch(on: boolean): void {
    this.watching = on;
  }

  save(): Promise<State> {
    return this.exclusive(() => this.deformer!.state());
  }

  restore(state: State | undefined): Promise<void> {
    return this.exclusive(() => (state ? this.deformer!.restore(state) : this.deformer!.reset()));
  }

  /** What the deformer holds now, without a step. */
  look(): Promise<Pick<Frame, "positions" | "normals" | "state">> {
    return this.exclusive(() => this.picture());
  }

  /** Coordinates in double. */
  exact(): Promise<Float64Array> {
    return this.exclusive(() => this.deformer!.positions(new Float64Array(this.data!.positions.length)));
  }

  /** Ends the stepping; what has been stepped is told before this resolves. */
  halt(): Promise<void> {
    this.stop();
    return this.exclusive(async () => {});
  }

  private stop(): void {
    this.pending.clear();
    this.pendingOptions = undefined;
    this.stepsLeft = 0;
    this.interrupted = true;
  }

  private async run(): Promise<void> {
    try {
      while (this.stepsLeft > 0) {
        await this.exclusive(() => this.advance());
        await nextFrame();
      }
    } catch (error) {
      this.stop();
      this.events.failed(error as Error);
    }
    this.running = undefined;
    if (!this.interrupted) this.events.settled();
  }

  private async advance(): Promise<void> {
    if (this.stepsLeft === 0) return; // stopped while waiting for its turn
    if (!this.deformer) return this.stop();
    const options = this.pendingOptions;
    this.pendingOptions = undefined;
    if (options) await this.change(options);
    if (this.handles.size === 0 && !options && !hasLoad(this.method, this.options)) return this.stop(); // nothing pulls
    const motions = this.pending;
    this.pending = new Map();
    for (const [id, motion] of motions) {
      const handle = this.handles.get(id);
      if (handle) await handle.remote.move(asTransform(motion, handle.doc.center, this.dimension));
    }
    const { report, iterations } = await this.steps();
    const more = this.pending.size > 0 || this.pendingOptions !== undefined;
    this.stepsLeft = report.converged && !more ? 0 : Math.max(0, this.stepsLeft - iterations);
    this.events.frame({ ...(await this.picture()), report }, { motions, options }, iterations);
  }

  private async change(options: Options): Promise<void> {
    const [before, after] = [this.options, options].map((values) => scriptOptions(this.method, values, this.data!));
    this.options = options;
    const changed = Object.entries(after!).filter(([key, value]) => JSON.stringify(value) !== JSON.stringify(before![key]));
    await this.deformer!.setOptions(Object.fromEntries(changed));
  }

  /** As many steps as fit into one frame of the screen, at least one; or as many as were asked for. */
  private async steps(): Promise<{ report: StepReport; iterations: number }> {
    let report = await this.deformer!.step();
    let iterations = 1;
    const goOn = (used: number) => (this.pace > 0 ? iterations < this.pace : used + report.milliseconds < frameBudget);
    for (let used = report.milliseconds; !report.converged && goOn(used); iterations++) {
      report = await this.deformer!.step();
      used += report.milliseconds;
    }
    return { report, iterations };
  }

  private async picture(): Promise<Pick<Frame, "positions" | "normals" | "state">> {
    const deformer = this.deformer!;
    const [flat, normals, state] = await Promise.all([
      deformer.positions(), deformer.normals(), this.watching ? deformer.state() : undefined,
    ]);
    const positions = this.dimension === 2 ? inSpace(flat) : flat;
    return { positions, normals, ...(state ? { state } : {}) };
  }
}
