// Joins the parts: what happens in the session is shown, what the visitor does reaches the session.
import { Session } from "./edit/session.ts";
import { loadFile } from "./files/load_file.ts";
import { catalog } from "./shapes/catalog.ts";
import { boundingBox, type Box, type ShapeData } from "./shapes/shape.ts";
import { makeTools } from "./tools/toolbox.ts";
import type { Stage } from "./tools/tool.ts";
import { byId } from "./ui/dom.ts";
import { HandleOverlay } from "./ui/handle_overlay.ts";
import { Input } from "./ui/input.ts";
import { bindChrome } from "./ui/chrome.ts";
import { Panel } from "./ui/panel.ts";
import { Readout } from "./ui/readout.ts";
import { Toolbar } from "./ui/toolbar.ts";
import { GraphView, graphIn } from "./view/graph_view.ts";
import { pick, type Hit } from "./view/picking.ts";
import { ShapeView } from "./view/shape_view.ts";
import { Viewport } from "./view/viewport.ts";

export class App {
  readonly viewport = new Viewport(byId<HTMLCanvasElement>("view"));
  readonly view = new ShapeView();
  readonly session: Session;
  private readonly graph = new GraphView();
  private readonly stage: Stage;
  private readonly overlay: HandleOverlay;
  private readonly toolbar: Toolbar;
  private readonly input: Input;
  private readonly panel: Panel;
  private readonly readout: Readout;
  private readonly chrome: ReturnType<typeof bindChrome>;
  private box: Box = boundingBox([0, 0, 0]);
  private shown: ShapeData | undefined;
  private stale = true;

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
    const tools = makeTools(this.stage);
    this.toolbar = new Toolbar(tools, () => this.toolChanged());
    this.input = new Input(this.stage, () => this.toolbar.current);
    this.readout = new Readout(session);
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
    const { viewport, view, session } = this;
    return {
      session, viewport, view,
      pick: (x, y) => this.pick(x, y),
      radius: () => this.toolbar.size * this.box.diagonal,
      preview: (fixed) => {
        view.paint(session.doc, fixed);
        viewport.invalidate();
      },
      showBrush: (at) => this.showBrush(at),
    };
  }

  get diagonal(): number {
    return this.box.diagonal;
  }

  pick(x: number, y: number): Hit | undefined {
    return pick(this.viewport, this.view, this.session, x, y);
  }

  openEntry(id: string): Promise<void> {
    return this.open(() => catalog.find((entry) => entry.id === id)!.make());
  }

  openFile(file: File): Promise<void> {
    return this.open(() => loadFile(file));
  }

  /** Shows a shape when it is there; what goes wrong is told. */
  private async open(load: () => Promise<ShapeData>): Promise<void> {
    this.chrome.busy(true);
    try {
      if (await this.session.open(await load())) this.chrome.say("");
    } catch (error) {
      this.problem(error as Error);
    }
    this.chrome.busy(false);
  }

  /** Says what went wrong; the controls show again how things stand. */
  private problem(error: Error): void {
    this.chrome.say(error.message);
    this.panel.refresh(true);
  }

  private async watchGraph(on: boolean): Promise<void> {
    await this.session.watch(on);
    this.view.setVeiled(on);
    this.viewport.invalidate();
  }

  private setWireframe(on: boolean): void {
    this.view.setWireframe(on);
    this.viewport.invalidate();
  }

  /** Document, history or selection. */
  private changed(): void {
    const { session } = this;
    if (this.shown !== session.doc.shape) this.takeShape(session.doc.shape);
    this.view.paint(session.doc);
    this.overlay.refresh();
    this.panel.refresh();
    this.chrome.refresh(session);
    if (session.canUndo && this.toolbar.current.id === "pose") this.chrome.hint(""); // it has been understood
    this.viewport.invalidate();
  }

  private takeShape(shape: ShapeData): void {
    this.shown = shape;
    this.box = boundingBox(shape.positions);
    this.view.show(shape, this.session.solid);
    this.view.setWireframe(byId<HTMLInputElement>("wire").checked);
    this.view.setVeiled(byId<HTMLInputElement>("graph").checked);
    this.viewport.frame(this.box, shape.viewFrom, shape.dimension);
    this.stale = true;
  }

  /** New positions: uploaded with the next drawing. */
  private framed(): void {
    this.stale = true;
    this.viewport.invalidate();
  }

  private draw(): void {
    if (this.stale && this.shown) {
      this.stale = false;
      this.view.update(this.session.positions, this.session.normals);
      this.graph.show(graphIn(this.session.state), this.box.diagonal);
      this.readout.refresh();
    }
    this.overlay.place();
  }

  private toolChanged(): void {
    this.chrome?.hint(this.toolbar.current.hint);
    this.input?.refresh();
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
