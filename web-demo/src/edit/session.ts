// The session: the document, its history and the solver, kept in step. Whatever a visitor does is
// one of the calls below; views listen.
import { defaultOptions, methodOf, type Options, type OptionValue } from "../methods.ts";
import { Meter, type Measures } from "../shapes/measure.ts";
import { normalsOf } from "../shapes/normals.ts";
import { refinedShape } from "../shapes/refined.ts";
import type { ShapeData } from "../shapes/shape.ts";
import { topologyOf, type Topology } from "../shapes/topology.ts";
import { SolverClient, type Frame } from "../solver/client.ts";
import type { ShapeReport, State, StepReport } from "../solver/pliant.ts";
import type { SketchFrame } from "../solver/sketch_client.ts";
import {
  backAtRest, editScript, freshGrab, hasMoved, makeHandle, onTop, presentStep, recorded, startingDoc, withConstraints, withMotion, type Change, type Doc,
  type HandleDoc,
} from "./document.ts";
import { History } from "./history.ts";
import { bestMotion, type Motion } from "./motion.ts";
import { Calm } from "./calm.ts";
import { shared } from "./share.ts";
import { freshId, heldStill, stillIn, withoutHeld } from "./still.ts";
import { Riding } from "./riding.ts";
import { isPosed, newSketch, seenAgain, type Pixel, type SketchCamera, type SketchDoc } from "./sketch_doc.ts";

/** A moment to go back to. The deformation is absent at rest and until the solver has told it. */
interface Moment {
  doc: Doc;
  deformation: State | undefined;
}

export interface SessionEvents {
  /** The document, the history or the selection changed. */
  change(): void;
  /** The shape on the screen changed. */
  frame(): void;
  /** Something could not be done; the session stands as before. */
  problem(error: Error): void;
}

export class Session {
  private solver!: SolverClient;
  private history!: History<Moment>;
  private meter!: Meter;
  private work: Promise<unknown> = Promise.resolve();
  private lastSaved: State | undefined;
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
  dragging = false;
  /** Something takes longer than a frame. */
  busy = false;

  private constructor(private readonly events: SessionEvents) {}

  static async start(shape: ShapeData, events: SessionEvents): Promise<Session> {
    const session = new Session(events);
    session.solver = await SolverClient.start({
      frame: (frame, motions, iterations) => session.show(frame, motions, iterations),
      settled: () => void session.rest(),
      failed: (error) => events.problem(error),
    });
    const doc = startingDoc(shape);
    await session.enter({ doc, deformation: undefined });
    session.history = new History<Moment>({ doc, deformation: undefined });
    return session;
  }

  // -- What changes the scene ---------------------------------------------------------------------

  // These and the calls below resolve to whether it went well; if not, the visitor has been told.

  /** Shows another shape, in its starting pose, with the method as it is unless the shape has one of its own. */
  open(shape: ShapeData): Promise<boolean> {
    return this.replace(startingDoc(shape, this.doc));
  }

  setMethod(id: string): Promise<boolean> {
    return this.replace({ ...this.doc, method: id, options: defaultOptions(methodOf(id)) });
  }

  setOption(key: string, value: OptionValue): Promise<boolean> {
    const options: Options = { ...this.doc.options, [key]: value };
    if (!methodOf(this.doc.method).live || this.doc.sketch) return this.replace({ ...this.doc, options }, `option ${key}`);
    this.doc = { ...this.doc, options };
    if (this.built) this.built = { ...this.built, options };
    this.solver.setOptions(options);
    this.events.change();
    return this.exclusive(() => this.commit(this.doc, `option ${key}`));
  }

  /** Steps of the solver a frame; 0: as many as there is time for. */
  setPace(steps: number): void {
    this.solver.pace = steps;
  }

  /** Another shape, method or option: a new deformer solves from rest. */
  private replace(doc: Doc, label = ""): Promise<boolean> {
    return this.move({ ...doc, grab: freshGrab(doc.handles, doc.options) }, label);
  }

  /** Makes a document the present, with what it takes to show it; if that fails the old one stays. */
  private move(next: Doc | (() => Promise<Doc>), label = ""): Promise<boolean> {
    return this.exclusive(async () => {
      const before = this.history.current;
      const moment: Moment = { doc: typeof next === "function" ? await next() : next, deformation: undefined };
      try {
        await this.enter(moment);
      } catch (error) {
        await this.enter(before);
        throw error;
      }
      moment.doc = this.doc; // with what was found on the way
      this.history.push(moment, label);
    });
  }

  // -- What strokes do ------------------------------------------------------------------------------

  /** Whether the shape can be sketched on at all. */
  get sketchable(): boolean {
    return this.doc.shape.dimension === 3 && this.doc.shape.triangles.length > 0;
  }

  /** Chooses the limb under a stroke; what was done before becomes a finished step. */
  chooseLimb(camera: SketchCamera, reference: readonly Pixel[], mirror: SketchDoc["mirror"]): Promise<boolean> {
    return this.move(async () => {
      const doc = await this.finished();
      return { ...doc, sketch: { ...newSketch(camera, reference, this.doc.sketch), mirror } };
    });
  }

  /** The limb seen from elsewhere, by the curve it lies on now: the region stays. */
  lookAgain(camera: SketchCamera, reference: readonly Pixel[], label: string): Promise<boolean> {
    return this.move(async () => {
      const [old, labels] = [this.doc.sketch!, this.sketched!.labels];
      return { ...(await this.finished()), sketch: seenAgain(old, labels, camera, reference) };
    }, label);
  }

  /** Poses the limb, for good; every call is one step back. `label` joins calls of one control. */
  pose(change: Partial<SketchDoc>, label = ""): Promise<boolean> {
    return this.move(async () => this.posed(change), label);
  }

  /** Shows a pose while the hand still moves. */
  previewPose(change: Partial<SketchDoc>): void {
    if (!this.doc.sketch) return;
    const sketch = { ...this.doc.sketch, refine: false, finish: "", ...change };
    this.solver.sketch.preview(sketch, (frame) => this.showSketch(frame), (error) => this.events.problem(error));
  }

  /** The limb as the document has it, after a preview that came to nothing. */
  showAgain(): void {
    if (this.doc.sketch) void this.exclusive(() => this.enter(this.history.current));
  }

  private posed(change: Partial<SketchDoc>): Doc {
    const { sketch } = this.doc;
    return sketch ? { ...this.doc, sketch: { ...sketch, unfinished: false, ...change } } : this.doc;
  }

  /** Lets go of the limb: its pose becomes a finished step. */
  leaveLimb(): Promise<boolean> {
    if (!this.doc.sketch) return Promise.resolve(true);
    return this.move(() => this.finished());
  }

  /** The document with the present step among the finished ones, if it did anything. */
  private async finished(): Promise<Doc> {
    await this.solver.halt();
    const { doc } = this;
    const step = presentStep(doc);
    if (!step || (!doc.sketch && !this.sketchable)) return { ...doc, sketch: undefined };
    const exact = await this.exact();
    const steps = [step, ...this.riding.steps(doc, exact)];
    return onTop(doc, { ...this.shown, positions: Float32Array.from(exact), exact }, steps);
  }

  /** The session as an edit script: replaying it gives the shape on the screen. */
  script(): ReturnType<typeof editScript> {
    return editScript(this.doc, this.riding.steps(this.doc, this.positions.slice()));
  }

  private async exact(): Promise<Float64Array> {
    const { sketch } = this.doc;
    if (!sketch) return this.solver.exact();
    if (sketch.finish !== "") return this.solver.sketch.finished(sketch);
    return this.solver.sketch.exact(this.shown.positions.length / 3);
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
    this.riding.find(this.doc, this.sketched?.labels);
    this.riding.carry(this.doc, this.positions);
    this.normals = normalsOf(this.positions, this.doc.shape.triangles, this.topology);
  }

  private showSketch(frame: SketchFrame, tell = true): void {
    this.sketched = frame;
    this.shown = refinedShape(this.doc.shape, frame.refinement);
    Object.assign(this, { positions: frame.positions, normals: frame.normals });
    this.riding.find(this.doc, this.sketched?.labels);
    this.riding.carry(this.doc, this.positions, this.normals);
    if (tell) this.events.frame();
  }

  // -- What changes the constraints ---------------------------------------------------------------

  /** A handle on some vertices where they are now; those of other handles are left to them. Its id, at once; undefined: none are left. */
  addHandle(vertices: Uint32Array): number | undefined {
    if (this.doc.sketch) return undefined;
    const taken = new Set(this.doc.handles.filter((h) => !h.held).flatMap((h) => [...h.vertices]));
    const own = vertices.filter((v) => !taken.has(v));
    if (own.length === 0) return undefined;
    const id = freshId(this.doc);
    const motion = bestMotion(this.doc.shape.positions, this.positions, own);
    const handle = makeHandle(this.doc.shape, id, `handle-${id}`, own, motion);
    const mine = new Set(own);
    const fixed = this.doc.fixed.filter((v) => !mine.has(v));
    this.selected = id;
    void this.constrain({ fixed, handles: [...withoutHeld(this.doc.handles, mine), handle] });
    return id;
  }

  removeHandle(id: number): Promise<boolean> {
    if (this.selected === id) this.selected = undefined;
    return this.constrain({ handles: this.doc.handles.filter((h) => h.id !== id) });
  }

  /** The vertices that do not move: fixed at rest, or held where they are. */
  get still(): Uint32Array {
    return stillIn(this.doc);
  }

  /** Replaces what does not move; vertices of handles stay with them. What has left its rest is held where it is now. */
  setStill(vertices: Iterable<number>): Promise<boolean> {
    if (this.doc.sketch) return Promise.resolve(false);
    return this.constrain(heldStill(this.doc, vertices, this.positions, 1e-4 * this.report.diagonal));
  }

  private constrain(change: Partial<Pick<Doc, "fixed" | "handles">>): Promise<boolean> {
    this.doc = withConstraints(this.doc, change);
    const doc = this.doc;
    this.riding.find(this.doc, this.sketched?.labels);
    this.events.change();
    return this.exclusive(async () => {
      await this.prepare(this.doc);
      await this.solver.constrain(this.doc.fixed, this.doc.handles); // a handle may be under way by now
      await this.commit(doc);
      this.solver.wake();
    });
  }

  // -- What moves handles -------------------------------------------------------------------------

  handle(id: number): HandleDoc | undefined {
    return this.doc.handles.find((h) => h.id === id);
  }

  select(id: number | undefined): void {
    if (this.selected === id) return;
    this.selected = id;
    this.events.change();
  }

  /** Moves a handle; a pointer says when the gesture begins and ends, a key press is a gesture of its own. */
  beginDrag(): void {
    this.dragging = true;
  }
  drag(id: number, motion: Motion): void {
    this.doc = withMotion(this.doc, id, motion);
    this.solver.move(id, this.handle(id)!.motion);
    this.events.change();
  }
  endDrag(): void {
    if (!this.dragging) return;
    this.dragging = false;
    void this.exclusive(() => this.commit(this.doc));
  }
  nudge(id: number, motion: Motion): void {
    this.drag(id, motion);
    void this.exclusive(() => this.commit(this.doc, `nudge ${id}`));
  }

  /** Everything back as it was opened; the regions stay. */
  reset(): Promise<boolean> {
    return this.move(async () => backAtRest(this.doc));
  }

  // -- Time ---------------------------------------------------------------------------------------

  get canUndo(): boolean {
    return this.history.canUndo;
  }
  get canRedo(): boolean {
    return this.history.canRedo;
  }
  undo(): Promise<boolean> {
    return this.travel(() => this.history.undo());
  }
  redo(): Promise<boolean> {
    return this.travel(() => this.history.redo());
  }

  private travel(go: () => Moment): Promise<boolean> {
    if (this.dragging) return Promise.resolve(false);
    return this.exclusive(() => this.enter(go()));
  }

  /** Resolves when every call is carried out and the shape is at rest. */
  async idle(): Promise<void> {
    for (let work: unknown; work !== this.work;) {
      work = this.work;
      await this.work;
      await this.solver.idle();
    }
  }

  /** While watched, `state` follows the method's inner state. */
  async watch(on: boolean): Promise<void> {
    this.solver.watch(on);
    this.state = undefined;
    if (on && !this.doc.sketch) this.state = (await this.solver.look()).state;
    this.events.frame();
  }

  /** A closed surface whose triangles look outwards: its inside is never seen. */
  get solid(): boolean {
    return (this.meter.volume ?? 0) > 0;
  }

  measures(): Measures {
    return this.meter.measure(this.positions);
  }

  // -- Inside -------------------------------------------------------------------------------------

  /** Runs a job when those before it are done. Resolves to whether it went well; if not, it was told. */
  private exclusive(job: () => Promise<void>): Promise<boolean> {
    const done = this.work.then(job).then(() => true, (error: Error) => {
      this.events.problem(error);
      return false;
    });
    this.work = done.then(() => this.events.change());
    return done;
  }

  /** Makes a moment the present: rebuilds what differs, constrains, restores, solves on. */
  private async enter({ doc, deformation }: Moment): Promise<void> {
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

  private async enterGrab(doc: Doc, deformation: State | undefined): Promise<void> {
    const fresh = await this.prepare(doc);
    if (!fresh && !deformation) await this.solver.restore(undefined);
    await this.solver.constrain(doc.fixed, doc.handles);
    if (deformation) await this.solver.restore(deformation);
    this.riding.find(this.doc, this.sketched?.labels);
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

  private takeShape({ opened, shape }: Doc, report: ShapeReport & { diagonal: number }): void {
    const first = opened !== (this.doc as Doc | undefined)?.opened;
    this.report = report;
    this.topology = topologyOf(shape);
    this.riding.take(shape, this.topology);
    if (!first && this.meter) return;
    const closed = opened.triangles.length > 0 && report.boundaryEdges === 0 && report.nonManifoldEdges === 0;
    this.meter = new Meter(opened, shape === opened ? this.topology : topologyOf(opened), closed);
  }

  /** Writes the present into the history, now and again when the shape has come to rest. */
  private async commit(doc: Doc, label = ""): Promise<void> {
    this.history.push({ doc, deformation: undefined }, label);
    await this.remember();
  }

  private async remember(): Promise<void> {
    const moment = this.history.current;
    moment.deformation = this.lastSaved = shared(this.lastSaved, await this.solver.save());
  }

  private async rest(): Promise<void> {
    if (this.dragging || !this.history || this.doc.sketch) return;
    const moment = this.history.current;
    moment.doc = this.doc;
    await this.remember();
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

  /** Whether the shape is at rest, on its way, or goes to and fro. */
  get motion(): ReturnType<Calm["verdict"]> {
    return this.doc.sketch || !this.step ? "settled" : this.calm.verdict();
  }

  /** Whether anything has been done to the shape. */
  get touched(): boolean {
    return this.doc.done.length > 0 || this.doc.sketch !== undefined || hasMoved(this.doc);
  }
}
