// One gesture on one handle, from the pointer's path: shift in the view plane, turn in it, or tilt.
import { Vector3 } from "three";
import { rotated, translated, type Motion } from "../edit/motion.ts";
import type { HandleDoc } from "../edit/document.ts";
import type { Pointer, Stage } from "./tool.ts";

export type DragMode = "shift" | "turn" | "tilt";

/** Radians a pixel. */
const tiltSpeed = 0.011;

/** Where a handle is now. */
export const placeOf = ({ center, motion }: HandleDoc): Vector3 =>
  new Vector3(...center).add(new Vector3(...motion.translate));

export class HandleDrag {
  private last: Pointer;
  private begun = false;

  constructor(private readonly stage: Stage, readonly id: number, private readonly mode: DragMode, start: Pointer) {
    this.last = start;
  }

  move(to: Pointer): void {
    const handle = this.stage.present.handle(this.id);
    if (!handle || (to.x === this.last.x && to.y === this.last.y)) return;
    if (!this.begun) this.stage.session.beginDrag();
    this.begun = true;
    this.stage.session.drag(this.id, this.next(handle, to));
    this.last = to;
  }

  end(): void {
    if (this.begun) this.stage.session.endDrag();
    this.begun = false;
  }

  private next(handle: HandleDoc, to: Pointer): Motion {
    const { viewport } = this.stage;
    const [dx, dy] = [to.x - this.last.x, to.y - this.last.y];
    const { right, up, forward } = viewport.axes();
    if (this.mode === "shift") return translated(handle.motion, viewport.shiftAt(placeOf(handle), dx, dy).toArray());
    if (this.mode === "tilt") {
      return rotated(rotated(handle.motion, up.toArray(), dx * tiltSpeed), right.toArray(), dy * tiltSpeed);
    }
    const center = viewport.toScreen(placeOf(handle));
    const box = viewport.canvas.getBoundingClientRect();
    const angle = (p: Pointer) => Math.atan2(p.y - box.top - center.y, p.x - box.left - center.x);
    const turn = Math.atan2(Math.sin(angle(to) - angle(this.last)), Math.cos(angle(to) - angle(this.last)));
    return rotated(handle.motion, forward.toArray(), turn);
  }
}
