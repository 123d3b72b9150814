// The one place that talks to the solver in its worker. Calls are made one after another; between
// them a loop steps until the shape is at rest, always towards the latest targets.
import type { HandleDoc } from "../edit/document.ts";
import { asTransform, isAtRest, type Motion } from "../edit/motion.ts";
import { fittingOptions, type Options } from "../methods.ts";
import { vertexCount, type ShapeData } from "../shapes/shape.ts";
import { connect, type Deformer, type DeformerOptions, type Handle, type Pliant, type ShapeReport, type State, type StepReport } from "./pliant.ts";

/** What the screen shows after one run of the solver. */
export interface Frame {
  positions: Float32Array;
  normals: Float32Array;
  report: StepReport;
  /** Only while the graph is watched. */
  state?: State;
}

export interface SolverEvents {
  /** `motions`: the handles moved just before; `iterations`: steps taken since the last frame. */
  frame(frame: Frame, motions: ReadonlyMap<number, Motion>, iterations: number): void;
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

const nextFrame = () => new Promise<void>((resolve) => requestAnimationFrame(() => resolve()));

export class SolverClient {
  private constructor(private readonly pliant: Pliant, private readonly events: SolverEvents) {}

  static async start(events: SolverEvents): Promise<SolverClient> {
    return new SolverClient(await connect(), events);
  }

  private queue: Promise<unknown> = Promise.resolve();
  private deformer: Deformer | undefined;
  private dimension: 2 | 3 = 3;
  private handles = new Map<number, { remote: Handle; doc: HandleDoc }>();
  private pending = new Map<number, Motion>();
  private stepsLeft = 0;
  private running: Promise<void> | undefined;
  private interrupted = false;
  private watching = false;

  /** Runs a job when those before it are done. */
  private exclusive<T>(job: () => Promise<T>): Promise<T> {
    const result = this.queue.then(job);
    this.queue = result.catch(() => undefined);
    return result;
  }

  /** A new shape or method; the old deformer is freed only when the new one stands. */
  build(data: ShapeData, method: string, options: Options): Promise<ShapeReport> {
    this.stop();
    return this.exclusive(async () => {
      const plane = data.dimension === 2;
      const positions = plane ? data.positions.filter((_, i) => i % 3 < 2) : data.positions;
      const shape = await this.pliant.shape({ positions, triangles: data.triangles, ...(plane ? { dimension: 2 } : {}) });
      const deformer = await this.pliant.deformer(shape, { method, ...fittingOptions(options, vertexCount(data)) } as DeformerOptions)
        .finally(() => shape.dispose());
      await this.deformer?.dispose();
      this.deformer = deformer;
      this.dimension = data.dimension;
      this.handles.clear();
      return shape.report;
    });
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
        if (!isAtRest(doc.motion)) await remote.move(asTransform(doc.motion, doc.center, this.dimension));
        this.handles.set(doc.id, { remote, doc });
      }
    });
  }

  /** The newest motion of a handle; one that has not been solved for yet is dropped. */
  move(id: number, motion: Motion): void {
    this.pending.set(id, motion);
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

  private stop(): void {
    this.pending.clear();
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
    if (this.handles.size === 0) return this.stop(); // nothing pulls
    const motions = this.pending;
    this.pending = new Map();
    for (const [id, motion] of motions) {
      const handle = this.handles.get(id);
      if (handle) await handle.remote.move(asTransform(motion, handle.doc.center, this.dimension));
    }
    const { report, iterations } = await this.steps();
    this.stepsLeft = report.converged && this.pending.size === 0 ? 0 : Math.max(0, this.stepsLeft - iterations);
    this.events.frame({ ...(await this.picture()), report }, motions, iterations);
  }

  /** As many steps as fit into one frame of the screen, at least one. */
  private async steps(): Promise<{ report: StepReport; iterations: number }> {
    let report = await this.deformer!.step();
    let iterations = 1;
    for (let used = report.milliseconds; !report.converged && used + report.milliseconds < frameBudget; iterations++) {
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
