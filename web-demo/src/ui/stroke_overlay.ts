// Lines over the picture: what is being drawn, the curve of the limb, and what a newcomer could draw.
import { isPosed } from "../edit/sketch_doc.ts";
import type { Pointer, Stage } from "../tools/tool.ts";
import { byId, makeSvg } from "./dom.ts";

interface Place {
  x: number;
  y: number;
}

const line = (points: readonly Place[]) =>
  points.length < 2 ? "" : `M${points.map(({ x, y }) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}`;

export class StrokeOverlay {
  private readonly root = byId<SVGElement>("ink");
  private readonly coach = byId("coach");
  private readonly ghost = makeSvg("path", { class: "ghost" });
  private readonly curve = makeSvg("path", { class: "curve" });
  private readonly joint = makeSvg("circle", { class: "joint", r: "5" });
  private readonly pen = makeSvg("path", { class: "pen" });
  private drawing = false;
  private greeting = true;

  constructor(private readonly stage: Stage, private readonly active: () => boolean) {
    this.root.append(this.ghost, this.curve, this.joint, this.pen);
  }

  draw(points: readonly Pointer[] | undefined): void {
    this.drawing = points !== undefined;
    const box = this.root.getBoundingClientRect();
    this.pen.setAttribute("d", line((points ?? []).map(({ x, y }) => ({ x: x - box.left, y: y - box.top }))));
    this.placeHints();
  }

  /** Puts everything where the camera sees it. */
  place(): void {
    const { present, viewport } = this.stage;
    const { sketch } = present.doc;
    const frame = this.active() && sketch ? present.sketched : undefined;
    const curve = frame ? viewport.curveOnScreen(frame.target) : [];
    this.curve.setAttribute("d", line(curve));
    this.joint.toggleAttribute("hidden", !frame);
    if (frame) {
      this.joint.setAttribute("cx", String(curve[0]!.x));
      this.joint.setAttribute("cy", String(curve[0]!.y));
    }
    this.placeHints();
  }

  /** For the first limb only: where to draw, then where to. */
  private placeHints(): void {
    const { present, viewport } = this.stage;
    const { sketch, opened, done } = present.doc;
    if ((sketch && isPosed(sketch)) || done.length > 0) this.greeting = false;
    const strokes = opened.start?.strokes;
    const on = this.greeting && this.active() && !this.drawing && strokes !== undefined;
    this.coach.hidden = !on;
    this.ghost.setAttribute("d", "");
    if (!on) return;
    const [from, to] = strokes.map((stroke) => viewport.curveOnScreen(stroke.flat()));
    const curve = sketch && present.sketched ? viewport.curveOnScreen(present.sketched.target) : undefined;
    const asHinted = !curve || Math.hypot(curve.at(-1)!.x - from!.at(-1)!.x, curve.at(-1)!.y - from!.at(-1)!.y) < 70;
    if (asHinted) this.ghost.setAttribute("d", line(curve ? to! : from!));
    this.coach.firstElementChild!.textContent = curve ? "Now draw where it should go" : "Draw along here";
    const at = !curve ? from![Math.floor(from!.length / 2)]! : asHinted ? to!.at(-1)! : curve[0]!;
    const half = this.coach.offsetWidth / 2;
    const x = Math.min(Math.max(at.x, half + 8), viewport.canvas.clientWidth - half - 8);
    this.coach.style.transform = `translate(${x - half}px, ${at.y - 62}px)`;
  }
}
