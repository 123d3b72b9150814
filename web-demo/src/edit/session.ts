// The session: the document, its history and the solver, kept in step. Whatever a visitor does is
// one of the calls below; views listen.
import { defaultOptions, methodOf } from "../methods.ts";
import { Meter, type Measures } from "../shapes/measure.ts";
import type { ShapeData } from "../shapes/shape.ts";
import { topologyOf, type Topology } from "../shapes/topology.ts";
import { SolverClient, type Frame } from "../solver/client.ts";
import type { ShapeReport, State, StepReport } from "../solver/pliant.ts";
import {
  freshGrab, makeHandle, recorded, startingDoc, withConstraints, withMotion, type Doc, type HandleDoc,
} from "./document.ts";
import { History } from "./history.ts";
import { atRest, bestMotion, type Motion } from "./motion.ts";
import { shared } from "./share.ts";

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

  doc!: Doc;
  topology!: Topology;
  report!: ShapeReport;
  positions!: Float32Array;
  normals!: Float32Array;
  state: State | undefined;
  step: StepReport | undefined;
  selected: number | undefined;
  dragging = false;

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

  /** Shows another shape, in its starting pose, with the method as it is. */
  open(shape: ShapeData): Promise<boolean> {
    return this.replace({ ...startingDoc(shape, methodOf(this.doc.method)), options: this.doc.options });
  }

  setMethod(id: string): Promise<boolean> {
    return this.replace({ ...this.doc, method: id, options: defaultOptions(methodOf(id)) });
  }

  setOption(key: string, value: number | boolean): Promise<boolean> {
    return this.replace({ ...this.doc, options: { ...this.doc.options, [key]: value } }, `option ${key}`);
  }

  /** Another shape, method or option: a new deformer solves from rest. */
  private replace(doc: Doc, label = ""): Promise<boolean> {
    return this.exclusive(async () => {
      const before = this.history.current;
      const moment: Moment = { doc: { ...doc, grab: freshGrab(doc.handles) }, deformation: undefined };
      try {
        await this.enter(moment);
      } catch (error) {
        await this.enter(before);
        throw error;
      }
      this.history.push(moment, label);
    });
  }

  // -- What changes the constraints ---------------------------------------------------------------

  /** A handle on some vertices where they are now; those of other handles are left to them. Its id, at once; undefined: none are left. */
  addHandle(vertices: Uint32Array): number | undefined {
    const taken = new Set(this.doc.handles.flatMap((h) => [...h.vertices]));
    const own = vertices.filter((v) => !taken.has(v));
    if (own.length === 0) return undefined;
    const id = 1 + Math.max(0, ...this.doc.handles.map((h) => h.id));
    const motion = bestMotion(this.doc.shape.positions, this.positions, own);
    const handle = makeHandle(this.doc.shape, id, `handle-${id}`, own, motion);
    const mine = new Set(own);
    const fixed = this.doc.fixed.filter((v) => !mine.has(v));
    this.selected = id;
    void this.constrain({ fixed, handles: [...this.doc.handles, handle] });
    return id;
  }

  removeHandle(id: number): Promise<boolean> {
    if (this.selected === id) this.selected = undefined;
    return this.constrain({ handles: this.doc.handles.filter((h) => h.id !== id) });
  }

  /** Replaces the fixed region; vertices of handles stay with them. */
  setFixed(vertices: Iterable<number>): Promise<boolean> {
    const taken = new Set(this.doc.handles.flatMap((h) => [...h.vertices]));
    return this.constrain({ fixed: Uint32Array.from(vertices).filter((v) => !taken.has(v)).sort() });
  }

  private constrain(change: Partial<Pick<Doc, "fixed" | "handles">>): Promise<boolean> {
    this.doc = withConstraints(this.doc, change);
    const doc = this.doc;
    this.events.change();
    return this.exclusive(async () => {
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

  /** Every handle and the shape back to rest; the regions stay. */
  reset(): Promise<boolean> {
    const handles = this.doc.handles.map((h) => ({ ...h, motion: atRest }));
    const doc = { ...this.doc, handles, grab: freshGrab(handles) };
    return this.exclusive(async () => {
      const moment: Moment = { doc, deformation: undefined };
      await this.enter(moment);
      this.history.push(moment);
    });
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
    if (on) this.state = (await this.solver.look()).state;
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
    if (doc.shape !== old?.shape || doc.method !== old.method || doc.options !== old.options) {
      this.report = await this.solver.build(doc.shape, doc.method, doc.options);
    } else if (!deformation) {
      await this.solver.restore(undefined);
    }
    if (doc.shape !== old?.shape) this.takeShape(doc.shape);
    this.doc = doc;
    this.step = undefined;
    if (!doc.handles.some((h) => h.id === this.selected)) this.selected = doc.handles[0]?.id;
    await this.solver.constrain(doc.fixed, doc.handles);
    if (deformation) await this.solver.restore(deformation);
    Object.assign(this, await this.solver.look());
    this.events.change();
    this.events.frame();
    this.solver.wake();
  }

  private takeShape(shape: ShapeData): void {
    this.topology = topologyOf(shape);
    const closed = shape.triangles.length > 0 && this.report.boundaryEdges === 0 && this.report.nonManifoldEdges === 0;
    this.meter = new Meter(shape, this.topology, closed);
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
    if (this.dragging || !this.history) return;
    const moment = this.history.current;
    moment.doc = this.doc;
    await this.remember();
  }

  private show(frame: Frame, motions: ReadonlyMap<number, Motion>, iterations: number): void {
    this.positions = frame.positions;
    this.normals = frame.normals;
    this.state = frame.state;
    this.step = frame.report;
    this.doc = { ...this.doc, grab: recorded(this.doc.grab, motions, iterations) };
    this.events.frame();
  }
}
