// The present: a document, the solver that carries it out, and what of it is on the screen, kept in step.
import type { Options } from "../methods.ts";
import { turn } from "../files/turn.ts";
import { Meter, type Measures } from "../shapes/measure.ts";
import { refinedShape } from "../shapes/refined.ts";
import { vertexCount, type ShapeData } from "../shapes/shape.ts";
import { EditClient, type Picture, type ShapeFacts } from "../solver/edit_client.ts";
import type { EditMoment, EditRun, SketchView, Spot, State } from "../solver/pliant.ts";
import {
  editScript, finishedDocument, finishedStep, liveDocument, onTop, withChanges, withConstraints, withDepth,
  withMotion, withRun,
  type Doc, type HandleDoc,
} from "./document.ts";
import { motionOf, type Motion } from "./motion.ts";
import { RestDetector } from "./rest_detector.ts";
import {
  fromHeld, isPosed, posed, type Pixel, type PoseChange, type SketchCamera, type SketchDoc,
} from "./sketch_doc.ts";

/** A moment to go back to. The edit's is absent at rest and until it has told it. */
export interface Moment {
  doc: Doc;
  edit: EditMoment | undefined;
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
  private client!: EditClient;
  private meter!: Meter;
  private readonly restDetector = new RestDetector();
  /** A pose that is shown and not in the document, yet. */
  private previewed: SketchDoc | undefined;

  doc!: Doc;
  /** What the limb under strokes looks like; absent while handles work. */
  sketched: SketchView | undefined;
  /** The shape on the screen: the document's, or with what refinement added. */
  shown!: ShapeData;
  /** A closed surface whose triangles look outwards: its inside is never seen. */
  solid = false;
  report!: ShapeFacts;
  positions!: Float32Array;
  normals!: Float32Array;
  state: State | undefined;
  /** The last iteration. */
  step: EditRun | undefined;
  selected: number | undefined;
  /** Something takes longer than a frame. */
  busy = false;

  private constructor(private readonly events: PresentEvents) {}

  static async start(doc: Doc, events: PresentEvents): Promise<Present> {
    const present = new Present(events);
    present.client = await EditClient.start({
      document: () => present.document(),
      frame: (picture) => present.show(picture),
      settled: () => events.settled(),
      failed: (error) => events.problem(error),
    });
    await present.enter({ doc, edit: undefined });
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

  /** The vertices that a brush touches in some places on the screen, ascending. */
  patch(spots: readonly Required<Spot>[], radius: number): Promise<Uint32Array> {
    const { shape } = this.doc;
    return this.client.patch(shape, spots, radius, this.positions.subarray(0, 3 * vertexCount(shape)));
  }

  /** How some vertices have moved from rest, as a whole. */
  async motionOf(vertices: Uint32Array): Promise<Motion> {
    const at = (positions: Float32Array) =>
      Float32Array.from([...vertices].flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)]));
    return motionOf(await this.client.rigidMotion(at(this.doc.shape.positions), at(this.positions)));
  }

  /** The newest figures there are; a frame is told when there are others. */
  measures(): Measures {
    return this.meter.measure(this.positions);
  }

  /** Whether the shape is at rest, on its way, or goes to and fro. */
  get motion(): ReturnType<RestDetector["verdict"]> {
    return this.doc.sketch || !this.step ? "settled" : this.restDetector.verdict();
  }

  /** What was done as an edit script: replaying it gives the shape on the screen. */
  script(): ReturnType<typeof editScript> {
    return editScript(this.doc);
  }

  /** How it is now, to come back to. */
  async save(): Promise<Moment> {
    const [edit, doc] = await this.client.save(() => this.doc);
    return { doc, edit };
  }

  // -- Another moment -----------------------------------------------------------------------------

  /** Makes a moment the present: what differs is carried out, and solved on. */
  async enter({ doc, edit }: Moment): Promise<void> {
    const old = this.doc as Doc | undefined;
    if (doc.opened !== old?.opened) await turn(); // it may be large, and was looked through just now
    const report = await this.client.open(doc.opened);
    if (doc.shape !== old?.shape) this.takeShape(doc, report);
    this.doc = doc;
    this.step = this.state = this.previewed = undefined;
    // Until its next pose is computed the limb stays as it is seen: strokes begun meanwhile are on it.
    if (!doc.sketch || doc.sketch.reference !== old?.sketch?.reference) this.sketched = undefined;
    this.restDetector.reset();
    this.shown = doc.shape;
    if (!doc.handles.some((h) => h.id === this.selected && !h.held)) {
      this.selected = doc.handles.find((h) => !h.held)?.id;
    }
    if (!edit && doc.sketch && doc.sketch.finish !== "" && isPosed(doc.sketch)) await this.finishSketch();
    else this.look(await this.client.enter(edit ?? liveDocument(withChanges(doc)), {
      fromRest: !edit && !doc.sketch && doc.done.length === 0, whole: doc.sketch !== undefined,
    }));
    const { sketch } = this.doc;
    if (sketch?.hold === "larger" && this.sketched) {
      this.doc = { ...this.doc, sketch: fromHeld(sketch, this.sketched.held) };
    }
    this.events.change();
    this.events.frame();
    if (!doc.sketch) this.client.wake();
  }

  private takeShape({ opened, shape }: Doc, facts: ShapeFacts): void {
    const first = opened !== (this.doc as Doc | undefined)?.opened;
    this.report = { ...facts, vertices: vertexCount(shape), triangles: shape.triangles.length / 3 };
    if (!first && this.meter) return;
    this.solid = facts.outwards;
    this.meter?.end();
    this.meter = new Meter(opened, (positions) => this.client.measure(opened, positions), () => this.events.frame());
  }

  private async finishSketch(): Promise<void> {
    this.busy = true;
    this.events.change();
    try {
      this.look(await this.client.finish(liveDocument(this.doc)!));
    } finally {
      this.busy = false;
    }
  }

  /** What is to be carried out now. */
  private document(): ReturnType<typeof liveDocument> {
    if (this.previewed) return liveDocument({ ...this.doc, sketch: this.previewed });
    this.doc = withChanges(this.doc);
    return liveDocument(this.doc);
  }

  /** The limb of a shape under a pixel, from the body to there. */
  limbStroke({ shape }: Doc, camera: SketchCamera, pixel: Pixel): Promise<Pixel[]> {
    return this.client.limbStroke(shape, camera, pixel);
  }

  /** The document with the present step among the finished ones, if it did anything. */
  async finished(): Promise<Doc> {
    await this.client.halt();
    const { doc } = this;
    const step = finishedStep(doc);
    if (!step || (!doc.sketch && !this.sketchable)) return { ...doc, sketch: undefined };
    const exact = await this.client.exact(finishedDocument(doc, step), vertexCount(this.shown));
    return onTop(doc, { ...this.shown, positions: Float32Array.from(exact), exact }, step);
  }

  // -- What changes in it while it stays ------------------------------------------------------------

  /** Other values of options that can change while the shape moves. */
  setOptions(options: Options): void {
    this.doc = { ...this.doc, options };
    this.client.wake();
    this.events.change();
  }

  moveHandle(id: number, motion: Motion): void {
    this.doc = withMotion(this.doc, id, motion);
    this.client.wake();
    this.events.change();
  }

  layer(id: number, side: "front" | "back"): void {
    this.doc = withDepth(this.doc, id, side);
    this.client.wake();
    this.events.change();
  }

  /** Other constraints; the edit has them with the next frame. */
  setConstraints(change: Partial<Pick<Doc, "fixed" | "handles">>): void {
    this.doc = withConstraints(this.doc, change);
    this.events.change();
    this.client.wake();
  }

  /** Shows a pose of the limb; the document stays. */
  preview(change: PoseChange): void {
    if (!this.doc.sketch) return;
    this.previewed = posed({ ...this.doc.sketch, refine: false, finish: "" }, change);
    this.client.wake();
  }

  // -- The screen -----------------------------------------------------------------------------------

  /** Iterations a frame; 0: as many as there is time for. */
  setPace(iterations: number): void {
    this.client.pace = iterations;
  }

  /** While watched, `state` follows the method's inner state. */
  async watch(on: boolean): Promise<void> {
    const state = await this.client.watch(on);
    this.state = this.doc.sketch ? undefined : state;
    this.events.frame();
  }

  /** Resolves when the shape is at rest. */
  idle(): Promise<void> {
    return this.client.idle();
  }

  /** Takes a picture over. */
  private look({ positions, normals, sketch, state, run }: Picture): void {
    const limb = this.doc.sketch ? sketch : undefined;
    this.sketched = limb;
    this.shown = refinedShape(this.doc.shape, limb?.refinement);
    Object.assign(this, { positions, normals, state: limb ? undefined : state });
    this.doc = withRun(this.doc, run);
  }

  private show(picture: Picture): void {
    const before = this.positions as Float32Array | undefined;
    this.look(picture);
    if (!this.doc.sketch) {
      const { run } = picture;
      if (before) this.restDetector.saw(before, this.positions, run.converged);
      this.step = { ...run, milliseconds: run.milliseconds / Math.max(1, run.iterations) };
    }
    this.events.frame();
  }
}
