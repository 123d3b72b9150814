// Joins the parts: what happens in the session is shown, what the visitor does reaches the session.
import type { Present } from "./edit/present.ts";
import { Session } from "./edit/session.ts";
import { loadFile } from "./files/load_file.ts";
import { catalog, entryOf } from "./shapes/catalog.ts";
import { boundingBox, type Box, type ShapeData } from "./shapes/shape.ts";
import { isPosed } from "./edit/sketch_doc.ts";
import { SketchTool, type StrokeMode } from "./tools/sketch.ts";
import { makeTools } from "./tools/toolbox.ts";
import type { Stage } from "./tools/tool.ts";
import { byId } from "./ui/dom.ts";
import { HandleOverlay } from "./ui/handle_overlay.ts";
import { Input } from "./ui/input.ts";
import { bindChrome } from "./ui/chrome.ts";
import { LimbPanel } from "./ui/limb_panel.ts";
import { Panel } from "./ui/panel.ts";
import { Readout } from "./ui/readout.ts";
import { StrokeOverlay } from "./ui/stroke_overlay.ts";
import { Toolbar } from "./ui/toolbar.ts";
import { GraphView, graphIn } from "./view/graph_view.ts";
import { Layers } from "./view/layers.ts";
import { pick, type Hit } from "./view/picking.ts";
import { ShapeView } from "./view/shape_view.ts";
import { Viewport } from "./view/viewport.ts";

const strokeHints: Record<StrokeMode, (posed: boolean) => string> = {
  bend: (posed) => (posed ? "Draw again to change it, or start on another part." : "Now draw where it should go."),
  twist: () => "Drag across the limb to turn it about itself.",
  scale: () => "Drag away from the limb to make it thicker there, towards it thinner.",
  cut: () => "Draw a line across the limb: beyond it, it keeps its form.",
};

export class App {
  readonly viewport = new Viewport(byId<HTMLCanvasElement>("view"));
  readonly view = new ShapeView();
  readonly session: Session;
  private readonly graph = new GraphView();
  private readonly layers = new Layers();
  private readonly stage: Stage;
  private readonly overlay: HandleOverlay;
  private readonly strokes: StrokeOverlay;
  private readonly toolbar: Toolbar;
  private readonly limb: LimbPanel;
  private readonly input: Input;
  private readonly panel: Panel;
  private readonly readout: Readout;
  private readonly chrome: ReturnType<typeof bindChrome>;
  private box: Box = boundingBox([0, 0, 0]);
  private shown: ShapeData | undefined;
  private opened: ShapeData | undefined;
  private stale = true;
  private opening = false;
  private reading: AbortController | undefined;

  static async start(): Promise<App> {
    let app: App | undefined;
    const session = await Session.start(await catalog[0]!.make(), {
      change: () => app?.changed(),
      frame: () => app?.framed(),
      problem: (error) => app?.problem(error),
    });
    app = new App(session);
    app.changed();
    app.framed();
    return app;
  }

  private constructor(session: Session) {
    this.session = session;
    this.stage = this.makeStage();
    this.viewport.add(this.view.group);
    this.viewport.add(this.graph.group);
    this.overlay = new HandleOverlay(this.stage, byId("overlay"));
    const sketch = new SketchTool(this.stage);
    this.strokes = new StrokeOverlay(this.stage, () => this.sketching);
    this.toolbar = new Toolbar(makeTools(this.stage, sketch), () => this.toolChanged());
    this.limb = new LimbPanel(session, sketch, () => this.sayHint());
    this.input = new Input(this.stage, () => this.toolbar.current);
    this.readout = new Readout(session.present);
    this.panel = new Panel(session, {
      openEntry: (id) => void this.openEntry(id),
      openFile: (file) => void this.openFile(file),
      watchGraph: (on) => void this.watchGraph(on),
      wireframe: (on) => this.setWireframe(on),
      problem: (error) => this.problem(error),
    });
    this.chrome = bindChrome({
      undo: () => void session.undo(),
      redo: () => void session.redo(),
      reset: () => void session.reset(),
      home: () => this.viewport.goHome(),
      tool: (index) => this.toolbar.choose(index),
      stroke: (key) => this.sketching && this.limb.key(key),
      open: (file) => void this.openFile(file),
    });
    this.viewport.onDraw(() => this.draw());
    const narrow = matchMedia("(max-width: 720px)");
    const makeRoom = () => this.viewport.setInset(narrow.matches ? 0 : byId("panel").offsetWidth + 12);
    narrow.addEventListener("change", makeRoom);
    makeRoom();
    this.toolChanged();
  }

  private makeStage(): Stage {
    const { viewport, view, session, session: { present } } = this;
    return {
      session, present, viewport, view,
      pick: (x, y) => this.pick(x, y),
      radius: () => this.toolbar.size * this.box.diagonal,
      preview: (unmoved) => {
        view.paint(present.doc, unmoved);
        viewport.invalidate();
      },
      ink: (points) => this.strokes.draw(points),
      showBrush: (at) => this.showBrush(at),
    };
  }

  private get present(): Present {
    return this.session.present;
  }

  get diagonal(): number {
    return this.box.diagonal;
  }

  pick(x: number, y: number): Hit | undefined {
    return pick(this.viewport, this.view, this.present, x, y);
  }

  openEntry(id: string): Promise<void> {
    this.reading?.abort();
    return this.open(() => entryOf(id).make());
  }

  openFile(file: File): Promise<void> {
    return this.open(() => this.read(file));
  }

  /** Reads a file while the page goes on; the visitor sees how far it is and may stop it, as another file does. */
  private async read(file: File): Promise<ShapeData> {
    this.reading?.abort();
    const own = new AbortController();
    this.reading = own;
    const show = (fraction: number | undefined) => {
      if (this.reading === own) this.chrome.reading(file.name, fraction, () => own.abort());
    };
    show(0);
    try {
      return await loadFile(file, { signal: own.signal, onProgress: ({ fraction }) => show(fraction) });
    } finally {
      show(undefined);
    }
  }

  /** Shows a shape when it is there; what goes wrong is told. */
  private async open(load: () => Promise<ShapeData>): Promise<void> {
    this.opening = true;
    this.chrome.busy(true);
    try {
      if (await this.session.open(await load())) {
        this.chrome.say("");
        const { dimension, start } = this.present.doc.opened;
        if (dimension === 2 && start?.handles.length === 0) this.toolbar.chooseById("handle"); // pins come first
        else if (start?.method) this.toolbar.chooseById("pose"); // it shows a method, not strokes
      }
    } catch (error) {
      this.problem(error as Error);
    }
    this.opening = false;
    this.chrome.busy(this.present.busy);
  }

  /** Says what went wrong; the controls show again how things stand. */
  private problem(error: Error): void {
    this.chrome.say(error.message);
    this.panel.refresh(true);
  }

  private async watchGraph(on: boolean): Promise<void> {
    await this.present.watch(on);
    this.view.setVeiled(on);
    this.viewport.invalidate();
  }

  private setWireframe(on: boolean): void {
    this.view.setWireframe(on);
    this.viewport.invalidate();
  }

  /** Strokes are drawn, handles are out of sight. */
  private get sketching(): boolean {
    return this.toolbar.current.id === "sketch";
  }

  /** Document, history or selection. */
  private changed(): void {
    const { session, present } = this;
    if (present.doc.sketch) this.toolbar.chooseById("sketch"); // by undo, perhaps
    this.toolbar.refresh();
    this.takeShape();
    this.layer();
    this.paint();
    this.overlay.refresh();
    this.panel.refresh();
    this.limb.refresh(this.sketching);
    this.chrome.refresh(session);
    this.chrome.busy(present.busy || this.opening);
    this.sayHint();
    this.viewport.invalidate();
  }

  /** The shape on the screen; the camera stays unless another one was opened. */
  private takeShape(): void {
    const { shown, doc, solid } = this.present;
    if (this.shown === shown) return;
    if (this.shown?.triangles === shown.triangles && this.shown.colors === shown.colors) { // only its rest has moved
      this.shown = shown;
      return;
    }
    this.shown = shown;
    this.view.show(shown, solid);
    this.view.setWireframe(byId<HTMLInputElement>("wire").checked);
    this.view.setVeiled(byId<HTMLInputElement>("graph").checked);
    this.stale = true;
    if (this.opened === doc.opened) return;
    this.opened = doc.opened;
    this.box = boundingBox(doc.opened.positions);
    this.viewport.frame(this.box, doc.opened);
  }

  /** What of a picture lies over what. */
  private layer(): void {
    if (this.shown?.dimension === 2 && this.shown.picture) this.view.layer(this.layers.of(this.present.doc));
  }

  private paint(): void {
    if (!this.shown) return;
    const { doc, sketched } = this.present;
    if (this.sketching) this.view.paintLimb(sketched, doc.sketch !== undefined && isPosed(doc.sketch));
    else this.view.paint(doc);
  }

  /** New positions: uploaded with the next drawing. */
  private framed(): void {
    this.takeShape();
    if (this.sketching) this.paint();
    this.stale = true;
    this.viewport.invalidate();
  }

  private draw(): void {
    if (this.stale && this.shown) {
      this.stale = false;
      this.view.update(this.present.positions, this.present.normals);
      this.graph.show(graphIn(this.present.state), this.box.diagonal);
      this.readout.refresh();
    }
    this.overlay.place();
    this.strokes.place();
  }

  private toolChanged(): void {
    if (!this.input) return; // being made
    if (!this.sketching) void this.session.leaveLimb();
    this.viewport.setDrawing(this.sketching);
    this.overlay.hide(this.sketching);
    this.limb.refresh(this.sketching);
    document.body.dataset["tool"] = this.toolbar.current.id;
    byId("method").hidden = this.sketching;
    this.paint();
    this.sayHint();
    this.input.refresh();
    this.viewport.invalidate();
  }

  /** One line on what to do next; none once it has been understood. */
  private sayHint(): void {
    const { session, present, toolbar } = this;
    const { sketch } = present.doc;
    if (sketch && this.sketching) this.chrome?.hint(strokeHints[this.limb.mode](isPosed(sketch)));
    else if (session.canUndo && ["pose", "sketch"].includes(toolbar.current.id)) this.chrome?.hint("");
    else this.chrome?.hint(toolbar.current.hint);
  }

  private showBrush(at: Parameters<Stage["showBrush"]>[0]): void {
    const brush = byId<SVGElement>("brush");
    brush.toggleAttribute("hidden", !at);
    if (!at) return;
    const center = at.hit?.point ?? this.viewport.controls.target;
    const perPixel = this.viewport.shiftAt(center, 1, 0).length();
    brush.style.transform = `translate(${at.x}px, ${at.y}px)`;
    brush.dataset["tool"] = this.toolbar.current.id;
    brush.style.opacity = at.hit ? "1" : "0.35";
    brush.firstElementChild!.setAttribute("r", String(Math.max(4, this.stage.radius() / perPixel)));
  }
}
