// Handle: a press on the surface puts a handle there; dragging on moves it at once.
import { patchAround } from "../shapes/topology.ts";
import { HandleDrag } from "./handle_drag.ts";
import type { Pointer, Stage, Tool } from "./tool.ts";

export class AddHandle implements Tool {
  readonly id = "handle";
  readonly label = "Handle";
  readonly icon = "handle" as const;
  readonly hint = "Press on the shape to place a handle; keep dragging to move it.";
  readonly size = { min: 0, max: 0.12, start: 0.45 };
  private drag: HandleDrag | undefined;

  constructor(private readonly stage: Stage) {}

  down(at: Pointer): boolean {
    const id = this.place(at);
    if (id !== undefined) this.drag = new HandleDrag(this.stage, id, "shift", at);
    return id !== undefined;
  }
  move(at: Pointer): void {
    this.drag?.move(at);
  }
  up(): void {
    this.drag?.end();
    this.drag = undefined;
  }
  hover(at: Pointer | undefined): void {
    const hit = at && this.stage.pick(at.x, at.y);
    this.stage.showBrush(at && hit ? { ...at, hit } : undefined);
  }
  act(at: Pointer): void {
    this.place(at);
  }

  /** The id of the new handle, or of the one that is there already. */
  private place({ x, y }: Pointer): number | undefined {
    const hit = this.stage.pick(x, y);
    if (!hit) return undefined;
    const { session, present } = this.stage;
    const there = present.doc.handles.find((h) => !h.held && h.vertices.includes(hit.vertex));
    if (there) {
      session.select(there.id);
      return there.id;
    }
    return session.addHandle(
      patchAround(present.topology, present.positions, hit.vertex, hit.point.toArray(), this.stage.radius()),
    );
  }
}
