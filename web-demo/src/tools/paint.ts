// Fix and free: a brush that adds vertices to the fixed region or takes them out.
import type { IconName } from "../ui/icons.ts";
import type { Pointer, Stage, Tool } from "./tool.ts";

export class Paint implements Tool {
  readonly size = { min: 0.004, max: 0.16, start: 0.4 };
  readonly id: string;
  readonly label: string;
  readonly icon: IconName;
  readonly hint: string;
  /** What is still as the stroke leaves it, and what has to be found out before that is so: one dab after the other. */
  private stroke = new Set<number>();
  private work: Promise<unknown> = Promise.resolve();
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
    this.later(() => (this.stroke = new Set(this.stage.session.unmoved)));
    this.last = at;
    this.dab([at]);
    return true;
  }

  move(at: Pointer): void {
    this.hover(at);
    const { last } = this;
    if (!last) return;
    // Dabs close enough to leave no gaps, however fast the pointer was.
    const distance = Math.hypot(at.x - last.x, at.y - last.y);
    const steps = Math.min(24, Math.max(1, Math.round(distance / 10)));
    this.dab(Array.from({ length: steps }, (_, i) => {
      const t = (i + 1) / steps;
      return { x: last.x + t * (at.x - last.x), y: last.y + t * (at.y - last.y) };
    }));
    this.last = at;
  }

  up(): void {
    if (!this.last) return;
    this.last = undefined;
    this.work = this.stage.session.setUnmoved(this.work.then(() => this.stroke)).then(() => this.stage.preview());
  }

  hover(at: Pointer | undefined): void {
    this.stage.showBrush(at && { ...at, hit: this.stage.pick(at.x, at.y) });
  }

  act(at: Pointer): void {
    if (this.down(at)) this.up();
  }

  private dab(places: readonly Pointer[]): void {
    const { present } = this.stage;
    const hits = places.map(({ x, y }) => this.stage.pick(x, y)).filter((hit) => hit !== undefined);
    if (hits.length === 0) return;
    const spots = hits.map(({ vertex, point }) => ({ vertex, center: point.toArray() }));
    const patch = present.patch(spots, this.stage.radius()).catch(() => []); // another shape has been opened meanwhile
    this.later(async () => {
      const vertices = await patch;
      const held = new Set(present.doc.handles.flatMap((h) => (h.held ? [] : [...h.vertices])));
      for (const v of vertices) {
        if (!this.adds) this.stroke.delete(v);
        else if (!held.has(v)) this.stroke.add(v);
      }
      this.stage.preview(this.stroke);
    });
  }

  private later(job: () => unknown): void {
    this.work = this.work.then(job);
  }
}
