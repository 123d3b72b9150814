// Fix and free: a brush that adds vertices to the fixed region or takes them out.
import { patchAround } from "../shapes/topology.ts";
import type { IconName } from "../ui/icons.ts";
import type { Pointer, Stage, Tool } from "./tool.ts";

export class Paint implements Tool {
  readonly size = { min: 0.004, max: 0.16, start: 0.4 };
  readonly id: string;
  readonly label: string;
  readonly icon: IconName;
  readonly hint: string;
  private stroke: Set<number> | undefined;
  private last: Pointer | undefined;

  constructor(private readonly stage: Stage, private readonly adds: boolean) {
    this.id = adds ? "fix" : "free";
    this.label = adds ? "Fix" : "Free";
    this.icon = adds ? "fix" : "free";
    this.hint = adds
      ? "Paint what must not move: it stays where it is."
      : "Wipe over blue parts to let them move again.";
  }

  down(at: Pointer): boolean {
    if (!this.stage.pick(at.x, at.y)) return false;
    this.stroke = new Set(this.stage.session.unmoved);
    this.last = at;
    this.dab(at);
    return true;
  }

  move(at: Pointer): void {
    this.hover(at);
    if (!this.stroke || !this.last) return;
    // Dabs close enough to leave no gaps, however fast the pointer was.
    const distance = Math.hypot(at.x - this.last.x, at.y - this.last.y);
    const steps = Math.min(24, Math.max(1, Math.round(distance / 10)));
    for (let i = 1; i <= steps; i++) {
      const t = i / steps;
      this.dab({ x: this.last.x + t * (at.x - this.last.x), y: this.last.y + t * (at.y - this.last.y) });
    }
    this.last = at;
  }

  up(): void {
    if (this.stroke) void this.stage.session.setUnmoved(this.stroke);
    this.stroke = undefined;
    this.stage.preview();
  }

  hover(at: Pointer | undefined): void {
    this.stage.showBrush(at && { ...at, hit: this.stage.pick(at.x, at.y) });
  }

  act(at: Pointer): void {
    if (this.down(at)) this.up();
  }

  private dab({ x, y }: Pointer): void {
    const hit = this.stage.pick(x, y);
    if (!hit || !this.stroke) return;
    const { topology, positions, doc } = this.stage.present;
    const held = new Set(doc.handles.flatMap((h) => (h.held ? [] : [...h.vertices])));
    for (const v of patchAround(topology, positions, hit.vertex, hit.point.toArray(), this.stage.radius())) {
      if (!this.adds) this.stroke.delete(v);
      else if (!held.has(v)) this.stroke.add(v);
    }
    this.stage.preview(this.stroke);
  }
}
