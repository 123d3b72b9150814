// The present: a document, the solver that carries it out, and what of it is on the screen, kept in step.
import type { Options } from "../methods.ts";
import { Meter, type Measures } from "../shapes/measure.ts";
import { normalsOf } from "../shapes/normals.ts";
import { refinedShape } from "../shapes/refined.ts";
import type { ShapeData } from "../shapes/shape.ts";
import { topologyOf, type Topology } from "../shapes/topology.ts";
import { SolverClient, type Frame } from "../solver/client.ts";
import type { ShapeReport, State, StepReport } from "../solver/pliant.ts";
import type { SketchFrame } from "../solver/sketch_client.ts";
import { Calm } from "./calm.ts";
import { editScript, onTop, presentStep, recorded, withConstraints, withMotion, type Change, type Doc, type HandleDoc } from "./document.ts";
import type { Motion } from "./motion.ts";
import { Riding } from "./riding.ts";
import { isPosed, posed, type PoseChange, type SketchDoc } from "./sketch_doc.ts";

/** A moment to go back to. The deformation is absent at rest and until the solver has told it. */
export interface Moment {
  doc: Doc;
  deformation: State | undefined;
}

export interface PresentEvents {
  /** The document or the selection changed. */
  change(): void;
  /** The shape on the screen changed. */
  frame(): void;
  /** The shape has come to rest. */
  settled(): void;
  /** Something could not be done. */
  problem(error: Error): void;
}

export class Present {
  private solver!: SolverClient;
  private meter!: Meter;
  /** What the solver's deformer was built from. */
  private built: Pick<Doc, "shape" | "method" | "options"> | undefined;
  private readonly calm = new Calm();
  private readonly riding = new Riding();

  doc!: Doc;
  /** What the limb under strokes looks like; absent while handles work. */
  sketched: SketchFrame | undefined;
  /** The shape on the screen: the document's, or with what refinement added. */
  shown!: ShapeData;
  topology!: Topology;
  report!: ShapeReport & { diagonal: number };
  positions!: Float32Array;
  normals!: Float32Array;
  state: State | undefined;
  step: StepReport | undefined;
  selected: number | undefined;
  /** Something takes longer than a frame. */
  busy = false;

  private constructor(private readonly events: PresentEvents) {}

  static async start(doc: Doc, events: PresentEvents): Promise<Present> {
    const present = new Present(events);
    present.solver = await SolverClient.start({
      frame: (frame, change, iterations) => present.show(frame, change, iterations),
      settled: () => events.settled(),
      failed: (error) => events.problem(error),
    });
    await present.enter({ doc, deformation: undefined });
    return present;
  }

  // -- What it is ---------------------------------------------------------------------------------

  /** Whether the shape can be sketched on at all. */
  get sketchable(): boolean {
    return this.doc.shape.dimension === 3 && this.doc.shape.triangles.length > 0;
  }

  handle(id: number): HandleDoc | undefined {
    return this.doc.handles.find((h) => h.id === id);
  }

  /** A closed surface whose triangles look outwards: its inside is never seen. */
  get solid(): boolean {
    return (this.meter.volume ?? 0) > 0;
  }

  measures(): Measures {
    return this.meter.measure(this.positions);
  }

  /** Whether the shape is at rest, on its way, or goes to and fro. */
  get motion(): ReturnType<Calm["verdict"]> {
    return this.doc.sketch || !this.step ? "settled" : this.calm.verdict();
  }

  /** What was done as an edit script: replaying it gives the shape on the screen. */
  script(): ReturnType<typeof editScript> {
    return editScript(this.doc, this.riding.steps(this.doc, this.positions.slice()));
  }

  /** The deformation as it is now. */
  save(): Promise<State> {
    return this.solver.save();
  }

  // -- Another moment -----------------------------------------------------------------------------

  /** Makes a moment the present: rebuilds what differs, constrains, restores, solves on. */
  async enter({ doc, deformation }: Moment): Promise<void> {
    const old = this.doc as Doc | undefined;
    const report = await this.solver.take(doc.shape);
    if (doc.shape !== old?.shape) this.takeShape(doc, report);
    this.doc = doc;
    this.step = this.state = this.sketched = undefined;
    this.calm.reset();
    this.shown = doc.shape;
    if (!doc.handles.some((h) => h.id === this.selected && !h.held)) this.selected = doc.handles.find((h) => !h.held)?.id;
    if (doc.sketch) await this.enterSketch(doc.sketch);
    else await this.enterGrab(doc, deformation);
    this.events.change();
    this.events.frame();
    if (!doc.sketch) this.solver.wake();
  }

  private takeShape({ opened, shape }: Doc, report: ShapeReport & { diagonal: number }): void {
    const first = opened !== (this.doc as Doc | undefined)?.opened;
    this.report = report;
    this.topology = topologyOf(shape);
    this.riding.take(shape, this.topology);
    if (!first && this.meter) return;
    const closed = opened.triangles.length > 0 && report.boundaryEdges === 0 && report.nonManifoldEdges === 0;
    this.meter = new Meter(opened, shape === opened ? this.topology : topologyOf(opened), closed);
  }

  private async enterSketch(sketch: SketchDoc): Promise<void> {
    this.showSketch(await this.solver.sketch.apply(sketch), false);
    if (sketch.finish === "" || !isPosed(sketch)) return;
    this.busy = true;
    this.events.change();
    try {
      this.positions = Float32Array.from(await this.solver.sketch.finished(sketch));
    } finally {
      this.busy = false;
    }
    this.findRiders();
    this.riding.carry(this.doc, this.positions);
    this.normals = normalsOf(this.positions, this.doc.shape.triangles, this.topology);
  }

  private async enterGrab(doc: Doc, deformation: State | undefined): Promise<void> {
    const fresh = await this.prepare(doc);
    if (!fresh && !deformation) await this.solver.restore(undefined);
    await this.solver.constrain(doc.fixed, doc.handles);
    if (deformation) await this.solver.restore(deformation);
    this.findRiders();
    Object.assign(this, await this.solver.look());
    this.riding.carry(this.doc, this.positions, this.normals);
  }

  /** A deformer for the document; whether it is a new one. */
  private async prepare({ shape, method, options }: Doc): Promise<boolean> {
    const { built } = this;
    if (this.solver.ready && built?.shape === shape && built.method === method && built.options === options) return false;
    await this.solver.build(method, options);
    this.built = { shape, method, options };
    return true;
  }

  private findRiders(): void {
    this.riding.find(this.doc, this.sketched?.labels);
  }

  /** The document with the present step among the finished ones, if it did anything. */
  async finished(): Promise<Doc> {
    await this.solver.halt();
    const { doc } = this;
    const step = presentStep(doc);
    if (!step || (!doc.sketch && !this.sketchable)) return { ...doc, sketch: undefined };
    const exact = await this.exact();
    const steps = [step, ...this.riding.steps(doc, exact)];
    return onTop(doc, { ...this.shown, positions: Float32Array.from(exact), exact }, steps);
  }

  private async exact(): Promise<Float64Array> {
    const { sketch } = this.doc;
    if (!sketch) return this.solver.exact();
    if (sketch.finish !== "") return this.solver.sketch.finished(sketch);
    return this.solver.sketch.exact(this.shown.positions.length / 3);
  }

  // -- What changes in it while it stays ------------------------------------------------------------

  /** Other values of options that can change while the shape moves. */
  setOptions(options: Options): void {
    this.doc = { ...this.doc, options };
    if (this.built) this.built = { ...this.built, options };
    this.solver.setOptions(options);
    this.events.change();
  }

  moveHandle(id: number, motion: Motion): void {
    this.doc = withMotion(this.doc, id, motion);
    this.solver.move(id, this.handle(id)!.motion);
    this.events.change();
  }

  /** Other constraints, for the document; the solver has them after `constrain`. */
  setConstraints(change: Partial<Pick<Doc, "fixed" | "handles">>): void {
    this.doc = withConstraints(this.doc, change);
    this.findRiders();
    this.events.change();
  }

  /** Gives the solver the constraints of the document. */
  async constrain(): Promise<void> {
    await this.prepare(this.doc);
    await this.solver.constrain(this.doc.fixed, this.doc.handles); // a handle may be under way by now
  }

  /** Solves on. */
  wake(): void {
    this.solver.wake();
  }

  /** Shows a pose of the limb; the document stays. */
  preview(change: PoseChange): void {
    if (!this.doc.sketch) return;
    const sketch = posed({ ...this.doc.sketch, refine: false, finish: "" }, change);
    this.solver.sketch.preview(sketch, (frame) => this.showSketch(frame), (error) => this.events.problem(error));
  }

  // -- The screen -----------------------------------------------------------------------------------

  /** Steps of the solver a frame; 0: as many as there is time for. */
  setPace(steps: number): void {
    this.solver.pace = steps;
  }

  /** While watched, `state` follows the method's inner state. */
  async watch(on: boolean): Promise<void> {
    this.solver.watch(on);
    this.state = undefined;
    if (on && !this.doc.sketch) this.state = (await this.solver.look()).state;
    this.events.frame();
  }

  /** Resolves when the shape is at rest. */
  idle(): Promise<void> {
    return this.solver.idle();
  }

  private showSketch(frame: SketchFrame, tell = true): void {
    this.sketched = frame;
    this.shown = refinedShape(this.doc.shape, frame.refinement);
    Object.assign(this, { positions: frame.positions, normals: frame.normals });
    this.findRiders();
    this.riding.carry(this.doc, this.positions, this.normals);
    if (tell) this.events.frame();
  }

  private show(frame: Frame, change: Change, iterations: number): void {
    if (this.doc.sketch) return; // the last of a run that a stroke has ended
    const before = this.positions;
    this.positions = frame.positions;
    this.normals = frame.normals;
    this.riding.carry(this.doc, this.positions, this.normals);
    this.calm.saw(before, this.positions, frame.report.converged);
    this.state = frame.state;
    this.step = frame.report;
    this.doc = { ...this.doc, grab: recorded(this.doc.grab, change, iterations) };
    this.events.frame();
  }
}
