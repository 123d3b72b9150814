// Handle: a press on the surface puts a handle there; dragging on moves it at once.
import type { Hit } from "../view/picking.ts";
import { HandleDrag } from "./handle_drag.ts";
import type { Pointer, Stage, Tool } from "./tool.ts";

/** A press whose handle is still being placed. */
interface Press {
  to: Pointer;
  ended: boolean;
}

export class AddHandle implements Tool {
  readonly id = "handle";
  readonly label = "Handle";
  readonly icon = "handle" as const;
  get hint(): string {
    const { dimension } = this.stage.present.doc.shape;
    if (dimension === 2) return "Click on the picture to pin it; drag a pin to bend it, its ring to turn it.";
    return "Press on the shape to place a handle; keep dragging to move it.";
  }
  readonly size = { min: 0, max: 0.12, start: 0.45 };
  private drag: HandleDrag | undefined;
  private press: Press | undefined;

  constructor(private readonly stage: Stage) {}

  down(at: Pointer): boolean {
    const hit = this.stage.pick(at.x, at.y);
    if (!hit || this.stage.present.doc.sketch) return false;
    const there = this.chosen(hit);
    if (there !== undefined) this.drag = new HandleDrag(this.stage, there, "shift", at);
    else void this.place(hit, at, (this.press = { to: at, ended: false }));
    return true;
  }
  move(at: Pointer): void {
    if (this.press) this.press.to = at;
    this.drag?.move(at);
  }
  up(): void {
    if (this.press) this.press.ended = true;
    this.drag?.end();
    this.drag = this.press = undefined;
  }
  hover(at: Pointer | undefined): void {
    const hit = at && this.stage.pick(at.x, at.y);
    this.stage.showBrush(at && hit ? { ...at, hit } : undefined);
  }
  act(at: Pointer): void {
    if (this.down(at)) this.up();
  }

  /** The handle that is there already. */
  private chosen({ vertex }: Hit): number | undefined {
    const { session, present } = this.stage;
    const there = present.doc.handles.find((h) => !h.held && h.vertices.includes(vertex));
    if (there) session.select(there.id);
    return there?.id;
  }

  /** What the pointer has done meanwhile is made up for. */
  private async place({ vertex, point, reach }: Hit, from: Pointer, press: Press): Promise<void> {
    // A pin in a picture can always be turned: it holds more than a point.
    const least = this.stage.present.doc.shape.dimension === 2 ? 1.01 * reach : 0;
    const radius = Math.max(least, this.stage.radius());
    const id = await this.stage.session.addHandle({ vertex, center: point.toArray() }, radius);
    if (id === undefined) return;
    const drag = new HandleDrag(this.stage, id, "shift", from);
    drag.move(press.to);
    if (press.ended) drag.end();
    else this.drag = drag;
  }
}
