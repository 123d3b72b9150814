// What can be set on the limb under strokes: what a stroke does, morph, smoothing, the spline controls.
import type { Session } from "../edit/session.ts";
import {
  controls, flipped, restKnots, type Control, type Knots, type PoseChange, type SketchDoc,
} from "../edit/sketch_doc.ts";
import { methods } from "../methods.ts";
import { boundingBox } from "../shapes/shape.ts";
import { strokeModes, type SketchTool, type StrokeMode } from "../tools/sketch.ts";
import { byId, make } from "./dom.ts";
import { SplineBox, type SplineRange } from "./spline_box.ts";

const ranges: Record<Control, Omit<SplineRange, "rest">> = {
  turning: { label: "Turn", help: "Turns the limb further, or back, along its length.", min: -5, max: 5 },
  scale: { label: "Thickness", help: "How thick it is along its length.", min: 0.2, max: 2.2 },
  twistSpeed: { label: "Twist", help: "Where along the limb the twist happens.", min: -0.5, max: 1.5 },
};

const modeNames: Record<StrokeMode, [label: string, help: string]> = {
  bend: ["Bend", "Draw where the limb should go (B)"],
  twist: ["Twist", "Drag across the limb to turn it about itself (T)"],
  scale: ["Scale", "Drag away from the limb to make it thicker there (S)"],
  cut: ["Cut", "Draw a line across the limb: beyond it, it stays as it is (C)"],
};

export class LimbPanel {
  private readonly modes: HTMLButtonElement[];
  private readonly splines = new Map<Control, SplineBox>();
  private readonly morph = byId<HTMLInputElement>("morph");
  private readonly finish = byId<HTMLSelectElement>("finish");
  /** Poses that were asked for here and are not carried out yet. */
  private underWay = 0;

  constructor(
    private readonly session: Session, private readonly tool: SketchTool, private readonly changed: () => void,
  ) {
    this.modes = strokeModes.map((mode) => this.modeButton(mode));
    byId("stroke-modes").append(...this.modes);
    byId("limb-done").addEventListener("click", () => void session.leaveLimb());
    byId("limb-flip").addEventListener("click", () => this.pose(flipped));
    this.morph.addEventListener("input", () => {
      this.showMorph(Number(this.morph.value));
      session.present.preview({ morph: Number(this.morph.value) / 100 });
    });
    this.morph.addEventListener("change", () => this.pose({ morph: Number(this.morph.value) / 100 }, "morph"));
    this.check("smooth", (smooth) => this.pose({ smooth }));
    this.check("refine", (refine) => this.pose({ refine }));
    this.check("keep-length", (on) => (tool.keepsLength = on));
    this.check("mirror", (on) => this.setMirror(on));
    this.finish.append(
      make("option", { value: "" }, "Nothing"),
      ...methods.map(({ id, short, help }) => make("option", { value: id, title: help }, short)),
    );
    this.finish.addEventListener("change", () => this.pose({ finish: this.finish.value }));
    for (const control of controls) this.addSpline(control);
  }

  get mode(): StrokeMode {
    return this.tool.mode;
  }

  setMode(mode: StrokeMode): void {
    this.tool.mode = mode;
    this.modes.forEach((button, i) => {
      button.setAttribute("aria-checked", String(strokeModes[i] === mode));
      button.tabIndex = strokeModes[i] === mode ? 0 : -1;
    });
    this.changed();
  }

  /** The key of a mode, or the one that lets go of the limb; whether it was one. */
  key(key: string): boolean {
    if (!this.session.present.doc.sketch) return false;
    const mode = strokeModes.find((name) => name[0] === key);
    if (mode) this.setMode(mode);
    else if (key === "escape") void this.session.leaveLimb();
    else return false;
    return true;
  }

  /** Matches the controls with the document; `active`: the sketch tool is in use. */
  refresh(active: boolean): void {
    const { sketch } = this.session.present.doc;
    byId("limb").hidden = byId("limb-bar").hidden = !(sketch && active);
    if (sketch) this.show(sketch);
    else if (this.tool.mode !== "bend") this.setMode("bend");
  }

  /** Carries out what a control says. */
  private pose(change: PoseChange, label = ""): void {
    this.underWay++;
    void this.session.pose(change, label).then(() => {
      this.underWay--;
      const { sketch } = this.session.present.doc;
      if (sketch) this.show(sketch);
    });
  }

  /** Not while the document is behind the controls: the next press of a key goes on from what they say. */
  private show(sketch: SketchDoc): void {
    if (this.underWay > 0) return;
    this.showMorph(Math.round(100 * sketch.morph));
    byId<HTMLInputElement>("smooth").checked = sketch.smooth;
    byId<HTMLInputElement>("refine").checked = sketch.refine;
    byId<HTMLInputElement>("mirror").checked = sketch.mirror !== undefined;
    this.tool.mirror = sketch.mirror;
    this.finish.value = sketch.finish;
    byId<HTMLInputElement>("refine").disabled = sketch.finish !== "";
    for (const [control, box] of this.splines) box.show(sketch.knots[control]);
  }

  private modeButton(mode: StrokeMode): HTMLButtonElement {
    const [label, help] = modeNames[mode];
    const button = make(
      "button", { role: "radio", id: `stroke-${mode}`, title: help, "aria-checked": String(mode === "bend") }, label,
    );
    button.addEventListener("click", () => this.setMode(mode));
    button.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      const next = (strokeModes.indexOf(mode) + step + strokeModes.length) % strokeModes.length;
      this.setMode(strokeModes[next]!);
      this.modes[next]!.focus();
      event.preventDefault();
    });
    return button;
  }

  private showMorph(percent: number): void {
    this.morph.value = String(percent);
    (this.morph.previousElementSibling as HTMLOutputElement).value = `${percent}%`;
  }

  private check(id: string, set: (on: boolean) => void): void {
    const box = byId<HTMLInputElement>(id);
    box.addEventListener("change", () => set(box.checked));
  }

  private setMirror(on: boolean): void {
    const { opened } = this.session.present.doc;
    this.tool.mirror = on
      ? { normal: [1, 0, 0], offset: opened.mirrorAt ?? boundingBox(opened.positions).center[0] }
      : undefined;
    this.pose({ mirror: this.tool.mirror });
  }

  private addSpline(control: Control): void {
    const change = (value: Knots): PoseChange => ({ knots }) => ({ knots: { ...knots, [control]: value } });
    const box = new SplineBox({ ...ranges[control], rest: restKnots[control] },
      (value) => this.session.present.preview(change(value)),
      (value) => this.session.present.doc.sketch && this.pose(change(value), `knots ${control}`));
    this.splines.set(control, box);
    byId("curves").append(box.element);
  }
}
