// The one place that talks to the living edit in its worker. Calls are made one after another; between them frames run
// until the shape is at rest, always towards the newest document. A frame is one message each way.
import type { Pixel, SketchCamera } from "../edit/sketch_doc.ts";
import type { ShapeData } from "../shapes/shape.ts";
import {
  connect, type EditDocument, type EditMoment, type EditRun, type Quality, type RigidTransform, type ShapeReport,
  type SketchView, type Spot, type State, type WorkerEdit, type WorkerPliant, type WorkerShape,
} from "./pliant.ts";

/** What the library says of a shape. `outwards`: a closed surface whose triangles look outwards. */
export interface ShapeFacts extends ShapeReport {
  diagonal: number;
  outwards: boolean;
}

/** What the screen shows after a run. */
export interface Picture {
  positions: Float32Array;
  normals: Float32Array;
  run: EditRun;
  /** Only while the method's inner state is watched. */
  state: State | undefined;
  /** Where the last step is a sketch. */
  sketch: SketchView | undefined;
}

export interface EditEvents {
  /** What is to be carried out now; undefined: the shape at rest. */
  document(): EditDocument | undefined;
  frame(picture: Picture): void;
  /** At rest, or given up; not when a call cut the running short. */
  settled(): void;
  failed(error: Error): void;
}

/** Solver time in one frame of the screen, in milliseconds: half of a 60th of a second. */
const frameBudget = 8;

/** Nothing done. */
const atRest: EditMoment = { format: "pliant-moment", version: 1, document: undefined, stages: [] };

/** As many numbers a point as the shape has dimensions; in space as they are. */
const flat = <T extends Float32Array | Float64Array>(positions: T, { dimension }: ShapeData): T =>
  (dimension === 3 ? positions : positions.filter((_, i) => i % 3 < 2)) as T;

/** Points of the plane, two numbers each, with z = 0. */
const inSpace = (flat: Float32Array) =>
  Float32Array.from({ length: (flat.length / 2) * 3 }, (_, i) =>
    i % 3 === 2 ? 0 : flat[2 * Math.floor(i / 3) + (i % 3)]!,
  );

const nextFrame = () => new Promise<void>((resolve) => requestAnimationFrame(() => resolve()));

export class EditClient {
  private constructor(private readonly pliant: WorkerPliant, private readonly events: EditEvents) {}

  static async start(events: EditEvents): Promise<EditClient> {
    return new EditClient(await connect(), events);
  }

  private queue: Promise<unknown> = Promise.resolve();
  private data: ShapeData | undefined;
  private shape!: WorkerShape;
  private edit!: WorkerEdit;
  /** A later step's shape at rest. */
  private later: { data: ShapeData; shape: WorkerShape } | undefined;
  private running: Promise<void> | undefined;
  private awake = false;
  private interrupted = false;
  private watching = false;
  /** Iterations a frame; 0: as many as there is time for. */
  pace = 0;

  /** Runs a job when those before it are done. */
  private exclusive<T>(job: () => Promise<T>): Promise<T> {
    const result = this.queue.then(job);
    this.queue = result.catch(() => undefined);
    return result;
  }

  /** Another shape at rest, with its loose parts known; the edit of the old one is freed once the new one stands. */
  open(data: ShapeData): Promise<ShapeFacts> {
    this.stop();
    return this.exclusive(async () => {
      if (this.data !== data) await this.replace(data);
      const { shape: { report, diagonal } } = this;
      const closed = report.triangles > 0 && report.boundaryEdges === 0 && report.nonManifoldEdges === 0;
      const volume = closed ? await this.shape.volume() : null;
      return { ...report, diagonal, outwards: volume !== null && volume > 0 };
    });
  }

  private async replace(data: ShapeData): Promise<void> {
    const shape = await this.made(data);
    const edit = await this.pliant.open(shape);
    const parts = data.loose || shape.report.components === 1 ? [] : await shape.looseParts();
    data.loose ??= parts.map(({ vertices, beside }) =>
      ({ select: { vertices: [...vertices] }, along: { vertices: [...beside] } }));
    await this.edit?.dispose();
    await this.shape?.dispose();
    [this.data, this.shape, this.edit] = [data, shape, edit];
  }

  private made(data: ShapeData): Promise<WorkerShape> {
    const { triangles, dimension, exact, positions } = data;
    return this.pliant.shape({ positions: flat(exact ?? positions, data), triangles, dimension });
  }

  /** The library's own of the shape that was opened, or of a later step at rest: the last one asked for is kept. */
  private async shapeOf(data: ShapeData): Promise<WorkerShape> {
    if (data === this.data) return this.shape;
    if (data !== this.later?.data) {
      await this.later?.shape.dispose();
      this.later = { data, shape: await this.made(data) };
    }
    return this.later.shape;
  }

  /** What a brush of some size touches in places on a shape whose vertices are elsewhere now. */
  patch(
    data: ShapeData, spots: readonly Required<Spot>[], radius: number, positions: Float32Array,
  ): Promise<Uint32Array> {
    const there = spots.map(({ vertex, center }) => ({ vertex, center: Array.from(center).slice(0, data.dimension) }));
    return this.exclusive(async () => (await this.shapeOf(data)).patch(there, radius, flat(positions, data)));
  }

  /** The rigid motion that takes points closest to others. */
  rigidMotion(from: Float32Array, to: Float32Array): Promise<RigidTransform> {
    return this.pliant.rigidMotion(from, to);
  }

  /** Deformed positions of the shape that was opened against its rest. Errors: it is another one by now. */
  measure(data: ShapeData, positions: Float32Array): Promise<Quality> {
    if (data !== this.data) return Promise.reject(new Error("another shape is open"));
    return this.pliant.measure(this.shape, flat(positions, data), { intersections: false });
  }

  /**
   * A document or a moment, after a first frame. `fromRest`: not from the deformation as it is; `whole`: carried out to
   * its end.
   */
  enter(
    target: EditDocument | EditMoment | undefined, { fromRest, whole }: { fromRest: boolean; whole: boolean },
  ): Promise<Picture> {
    this.stop();
    return this.exclusive(async () => {
      const reset = fromRest ? this.edit.reset() : undefined;
      const limit = whole ? {} : { milliseconds: frameBudget };
      const [picture] = await Promise.all([this.picture(target ?? atRest, limit), reset]);
      return picture;
    });
  }

  /** Carries a document out to its end. */
  finish(document: EditDocument): Promise<Picture> {
    this.stop();
    return this.exclusive(async () => {
      await Promise.all([this.edit.apply(document), this.edit.settle()]);
      return this.picture(document, {});
    });
  }

  /** Coordinates in double of a document that is carried out. */
  exact(document: EditDocument, vertices: number): Promise<Float64Array> {
    return this.exclusive(async () => {
      const { edit } = this;
      const [, , exact] = await Promise.all([
        edit.apply(document), edit.run(), edit.positions(new Float64Array(3 * vertices)),
      ]);
      return exact;
    });
  }

  /** The limb of a mesh under a pixel of the picture, from the body to there. */
  limbStroke(data: ShapeData, camera: SketchCamera, pixel: Pixel): Promise<Pixel[]> {
    return this.exclusive(async () => this.pliant.limbStroke(await this.shapeOf(data), { camera, pixel: [...pixel] }));
  }

  /** The moment, and what `of` is just then. */
  save<T>(of: () => T): Promise<[EditMoment, T]> {
    return this.exclusive(async () => {
      const then = of();
      return [await this.edit.moment(), then];
    });
  }

  /** Runs until at rest. */
  wake(): void {
    this.awake = true;
    this.interrupted = false;
    this.running ??= this.run();
  }

  /** Ends the running; what has been run is told before this resolves. */
  halt(): Promise<void> {
    this.stop();
    return this.exclusive(async () => {});
  }

  /** Resolves when nothing moves any more. */
  async idle(): Promise<void> {
    while (this.running) await this.running;
    await this.queue;
  }

  /** While watched, pictures carry the state of the method; how it is now. */
  watch(on: boolean): Promise<State | undefined> {
    this.watching = on;
    return this.exclusive(async () => (on ? this.edit.state() : undefined));
  }

  private stop(): void {
    this.awake = false;
    this.interrupted = true;
  }

  private async run(): Promise<void> {
    try {
      while (this.awake) {
        await this.exclusive(() => this.frame());
        await nextFrame();
      }
    } catch (error) {
      this.stop();
      this.events.failed(error as Error);
    }
    this.running = undefined;
    if (!this.interrupted) this.events.settled();
  }

  private async frame(): Promise<void> {
    if (!this.awake) return; // stopped while waiting for its turn
    this.awake = false; // until something changes, or is left to do
    const limit = this.pace > 0 ? { iterations: this.pace } : { milliseconds: frameBudget };
    const picture = await this.picture(this.events.document() ?? atRest, limit);
    if (!picture.run.converged && !this.interrupted) this.awake = true;
    this.events.frame(picture);
  }

  /** Applies, runs, looks: one message each way. */
  private async picture(
    target: EditDocument | EditMoment, limit: { milliseconds?: number; iterations?: number },
  ): Promise<Picture> {
    const { edit, watching } = this;
    const [, run, flat, normals, sketch, state] = await Promise.all([
      edit.apply(target), edit.run(limit), edit.positions(), edit.normals(), edit.sketch(),
      watching ? edit.state() : undefined,
    ]);
    const positions = this.data!.dimension === 2 ? inSpace(flat) : flat;
    return { positions, normals, run, sketch, state };
  }
}
