// A control over the limb's length: a curve through five knots that are dragged up and down.
import { splineAt, type Knots } from "../edit/sketch_doc.ts";
import { make, makeSvg } from "./dom.ts";

export interface SplineRange {
  label: string;
  help: string;
  min: number;
  max: number;
  rest: Knots;
}

const [width, height, margin] = [220, 64, 7];

export class SplineBox {
  readonly element: HTMLElement;
  private readonly curve = makeSvg("path", { class: "curve" });
  private readonly dots: SVGElement[];
  private knots: Knots;
  private dragging = false;

  /** `preview`: while a knot is dragged; `commit`: when it is let go. */
  constructor(
    private readonly range: SplineRange,
    private readonly preview: (knots: Knots) => void,
    private readonly commit: (knots: Knots) => void,
  ) {
    this.knots = range.rest;
    this.dots = range.rest.map((_, i) => this.dot(i));
    const zero = makeSvg("path", { class: "zero", d: this.path(range.rest) });
    const box = makeSvg(
      "svg", { viewBox: `0 0 ${width} ${height}`, preserveAspectRatio: "none" }, zero, this.curve, ...this.dots,
    );
    this.element = make("div", { class: "spline", title: `${range.help} Double-click: as it was.` }, range.label, box);
    box.addEventListener("dblclick", () => this.commit(range.rest));
    this.show(range.rest);
  }

  show(knots: Knots): void {
    if (this.dragging) return;
    this.knots = knots;
    this.draw();
  }

  private x = (t: number) => margin + t * (width - 2 * margin);
  private y = (value: number) => {
    const { min, max } = this.range;
    return height - margin - ((Math.min(max, Math.max(min, value)) - min) / (max - min)) * (height - 2 * margin);
  };

  private path(knots: Knots): string {
    const at = (t: number) => `${this.x(t).toFixed(1)} ${this.y(splineAt(knots, t)).toFixed(1)}`;
    return `M${Array.from({ length: 41 }, (_, i) => at(i / 40)).join("L")}`;
  }

  private draw(): void {
    this.curve.setAttribute("d", this.path(this.knots));
    this.dots.forEach((dot, i) => {
      dot.setAttribute("cx", String(this.x(i / (this.dots.length - 1))));
      dot.setAttribute("cy", String(this.y(this.knots[i]!)));
      dot.setAttribute("aria-valuenow", this.knots[i]!.toFixed(2));
    });
  }

  private set(index: number, value: number): void {
    const { min, max } = this.range;
    this.knots = this.knots.map((k, i) => (i === index ? Math.min(max, Math.max(min, value)) : k));
    this.draw();
  }

  private dot(index: number): SVGElement {
    const { label, min, max, rest } = this.range;
    const dot = makeSvg("circle", {
      class: "knot", r: "5", tabindex: "0", role: "slider", "aria-label": `${label} at ${index} of ${rest.length - 1}`,
      "aria-valuemin": String(min), "aria-valuemax": String(max),
    });
    const on = (type: string, listener: (event: PointerEvent) => void) =>
      dot.addEventListener(type, listener as EventListener);
    on("pointerdown", (event) => {
      dot.setPointerCapture(event.pointerId);
      this.dragging = true;
      event.preventDefault();
    });
    on("pointermove", (event) => {
      if (!this.dragging) return;
      const box = dot.ownerSVGElement!.getBoundingClientRect();
      const fraction = 1 - ((event.clientY - box.top) * (height / box.height) - margin) / (height - 2 * margin);
      this.set(index, min + fraction * (max - min));
      this.preview(this.knots);
    });
    const end = (kept: boolean) => () => {
      if (!this.dragging) return;
      this.dragging = false;
      if (kept) this.commit(this.knots);
    };
    on("pointerup", end(true));
    on("pointercancel", end(true));
    dot.addEventListener("keydown", (event) => {
      const sign = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
      if (!sign) return;
      this.set(index, this.knots[index]! + (sign * (max - min)) / 40);
      this.commit(this.knots);
      event.preventDefault();
    });
    return dot;
  }
}
