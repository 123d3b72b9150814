// The session: what a visitor does, one call after another, and the history of it. Views listen and
// read the present.
import { defaultOptions, methodOf, type Options, type OptionValue } from "../methods.ts";
import type { ShapeData } from "../shapes/shape.ts";
import { backAtRest, freshGrab, makeHandle, startingDoc, type Doc } from "./document.ts";
import { History } from "./history.ts";
import type { Motion } from "./motion.ts";
import { Present, type Moment, type PresentEvents } from "./present.ts";
import {
  newSketch, posed, seenAgain, type Pixel, type PoseChange, type SketchCamera, type SketchDoc,
} from "./sketch_doc.ts";
import { freshId, heldUnmoved, unmovedIn, withoutHeld } from "./unmoved.ts";
import { connect, type Spot } from "../solver/pliant.ts";

/** `change` also tells of the history; after a `problem` the session stands as before. */
export type SessionEvents = Omit<PresentEvents, "settled">;

export class Session {
  private work: Promise<unknown> = Promise.resolve();
  dragging = false;

  private constructor(
    readonly present: Present, private readonly history: History<Moment>, private readonly events: SessionEvents,
  ) {}

  static async start(shape: ShapeData, events: SessionEvents): Promise<Session> {
    let session: Session | undefined;
    await connect(); // methods are known from here on
    const doc = startingDoc(shape);
    const present = await Present.start(doc, { ...events, settled: () => void session?.rest() });
    session = new Session(present, new History<Moment>({ doc, edit: undefined }), events);
    return session;
  }

  // -- What changes the scene ---------------------------------------------------------------------

  // These and the calls below resolve to whether it went well; if not, the visitor has been told.

  /** Shows another shape, in its starting pose, with the method as it is unless the shape has one of its own. */
  open(shape: ShapeData): Promise<boolean> {
    return this.replace((doc) => startingDoc(shape, doc));
  }

  setMethod(id: string): Promise<boolean> {
    return this.replace((doc) => ({ ...doc, method: id, options: defaultOptions(methodOf(id)) }));
  }

  /** An option of the present method. */
  setOption(key: string, value: OptionValue): Promise<boolean> {
    const { method, options, sketch } = this.present.doc;
    const changed = (before: Options): Options => ({ ...before, [key]: value });
    if (!methodOf(method).live || sketch) {
      // On what the calls before this one leave, which may be another method.
      return this.replace(
        (doc) => (doc.method === method ? { ...doc, options: changed(doc.options) } : doc), `option ${key}`,
      );
    }
    this.present.setOptions(changed(options));
    return this.exclusive(() => this.commit(this.present.doc, `option ${key}`));
  }

  /** Everything back as it was opened; the regions stay. */
  reset(): Promise<boolean> {
    return this.move(async () => backAtRest(this.present.doc));
  }

  /** Another shape, method or option: a new deformer solves from rest. */
  private replace(change: (doc: Doc) => Doc, label = ""): Promise<boolean> {
    return this.move(async () => {
      const doc = change(this.present.doc);
      return { ...doc, grab: freshGrab(doc.handles, doc.options) };
    }, label);
  }

  /** Makes a document the present, with what it takes to show it; if that fails the old one stays. */
  private move(next: () => Promise<Doc>, label = ""): Promise<boolean> {
    return this.exclusive(async () => {
      const before = this.history.current;
      const moment: Moment = { doc: await next(), edit: undefined };
      try {
        await this.present.enter(moment);
      } catch (error) {
        await this.present.enter(before);
        throw error;
      }
      moment.doc = this.present.doc; // with what was found on the way
      this.history.push(moment, label);
    });
  }

  // -- What strokes do ------------------------------------------------------------------------------

  /** Chooses the limb under a stroke; what was done before becomes a finished step. */
  chooseLimb(camera: SketchCamera, reference: readonly Pixel[], mirror: SketchDoc["mirror"]): Promise<boolean> {
    return this.move(async () => {
      const doc = await this.present.finished();
      return { ...doc, sketch: { ...newSketch(camera, reference, this.present.doc.sketch), mirror } };
    });
  }

  /** Chooses the limb under a pixel and poses it in one go: for a stroke that leaves the shape at once. */
  pullLimb(
    camera: SketchCamera, pixel: Pixel, mirror: SketchDoc["mirror"], targetOf: (reference: readonly Pixel[]) => Pixel[],
  ): Promise<boolean> {
    return this.move(async () => {
      const doc = await this.present.finished();
      const reference = await this.present.limbStroke(doc, camera, pixel);
      const sketch = newSketch(camera, reference, this.present.doc.sketch);
      return { ...doc, sketch: { ...sketch, mirror, hold: "start", target: targetOf(reference) } };
    });
  }

  /** The limb seen from elsewhere, by the curve it lies on now: the region stays. */
  lookAgain(camera: SketchCamera, reference: readonly Pixel[], label: string): Promise<boolean> {
    return this.move(async () => {
      const { doc, sketched } = this.present;
      return {
        ...(await this.present.finished()), sketch: seenAgain(doc.sketch!, sketched!.labels, camera, reference),
      };
    }, label);
  }

  /** Poses the limb, for good; every call is one step back. `label` joins calls of one control. */
  pose(change: PoseChange, label = ""): Promise<boolean> {
    return this.move(async () => {
      const { doc } = this.present;
      return doc.sketch ? { ...doc, sketch: posed(doc.sketch, change) } : doc;
    }, label);
  }

  /** The limb as the document has it, after a preview that came to nothing. */
  showAgain(): void {
    if (this.present.doc.sketch) void this.exclusive(() => this.present.enter(this.history.current));
  }

  /** Lets go of the limb: its pose becomes a finished step. */
  leaveLimb(): Promise<boolean> {
    if (!this.present.doc.sketch) return Promise.resolve(true);
    return this.move(() => this.present.finished());
  }

  // -- What changes the constraints ---------------------------------------------------------------

  /**
   * A handle on a patch of the shape where it is now; vertices of other handles are left to them. Its id; undefined:
   * none are left.
   */
  async addHandle(spot: Required<Spot>, radius: number): Promise<number | undefined> {
    let id: number | undefined;
    await this.exclusive(async () => {
      const patch = await this.present.patch([spot], radius);
      const { doc } = this.present;
      const taken = new Set(doc.handles.filter((h) => !h.held).flatMap((h) => [...h.vertices]));
      const own = patch.filter((v) => !taken.has(v));
      if (doc.sketch || own.length === 0) return;
      id = this.placeHandle(own, await this.present.motionOf(own));
    });
    if (id !== undefined) void this.exclusive(() => this.commit(this.present.doc));
    return id;
  }

  private placeHandle(vertices: Uint32Array, motion: Motion): number {
    const { doc } = this.present;
    const id = freshId(doc);
    const handle = makeHandle(doc.shape, id, `handle-${id}`, vertices, motion);
    const mine = new Set(vertices);
    this.present.selected = id;
    const fixed = doc.fixed.filter((v) => !mine.has(v));
    this.present.setConstraints({ fixed, handles: [...withoutHeld(doc.handles, mine), handle] });
    return id;
  }

  removeHandle(id: number): Promise<boolean> {
    const { present } = this;
    if (present.selected === id) present.selected = undefined;
    return this.constrain({ handles: present.doc.handles.filter((h) => h.id !== id) });
  }

  /** The vertices that do not move: fixed at rest, or held where they are. */
  get unmoved(): Uint32Array {
    return unmovedIn(this.present.doc);
  }

  /**
   * Replaces what does not move, once it is known; vertices of handles stay with them. What has left its rest is held
   * where it is then.
   */
  setUnmoved(painted: Promise<Iterable<number>>): Promise<boolean> {
    return this.exclusive(async () => {
      const vertices = await painted;
      const { doc, positions, report } = this.present;
      if (doc.sketch) return;
      this.present.setConstraints(heldUnmoved(doc, vertices, positions, 1e-4 * report.diagonal));
      await this.commit(this.present.doc);
    });
  }

  private constrain(change: Partial<Pick<Doc, "fixed" | "handles">>): Promise<boolean> {
    this.present.setConstraints(change);
    const { doc } = this.present;
    return this.exclusive(() => this.commit(doc));
  }

  // -- What moves handles -------------------------------------------------------------------------

  select(id: number | undefined): void {
    if (this.present.selected === id) return;
    this.present.selected = id;
    this.events.change();
  }

  /** Moves a handle; a pointer says when the gesture begins and ends, a key press is a gesture of its own. */
  beginDrag(): void {
    this.dragging = true;
  }
  drag(id: number, motion: Motion): void {
    this.present.moveHandle(id, motion);
  }
  endDrag(): void {
    if (!this.dragging) return;
    this.dragging = false;
    void this.exclusive(() => this.commit(this.present.doc));
  }
  nudge(id: number, motion: Motion): void {
    this.drag(id, motion);
    void this.exclusive(() => this.commit(this.present.doc, `nudge ${id}`));
  }

  /** Puts a handle of a picture in front of the others, or behind them. */
  layer(id: number, side: "front" | "back"): void {
    const { present } = this;
    if (present.doc.shape.dimension !== 2 || !present.handle(id)) return;
    present.layer(id, side);
    void this.exclusive(() => this.commit(present.doc));
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
    return this.exclusive(() => this.present.enter(go()));
  }

  /** Resolves when every call is carried out and the shape is at rest. */
  async idle(): Promise<void> {
    for (let work: unknown; work !== this.work;) {
      work = this.work;
      await this.work;
      await this.present.idle();
    }
  }

  /** Runs a job when those before it are done. Resolves to whether it went well; if not, it was told. */
  private exclusive(job: () => Promise<void>): Promise<boolean> {
    const done = this.work.then(job).then(() => true, (error: Error) => {
      this.events.problem(error);
      return false;
    });
    this.work = done.then(() => this.events.change());
    return done;
  }

  /** Writes the present into the history, now and again when the shape has come to rest. */
  private async commit(doc: Doc, label = ""): Promise<void> {
    this.history.push({ doc, edit: undefined }, label);
    await this.remember();
  }

  private async remember(): Promise<void> {
    const moment = this.history.current;
    Object.assign(moment, await this.present.save());
  }

  private async rest(): Promise<void> {
    if (this.dragging || this.present.doc.sketch) return;
    await this.remember();
  }
}
