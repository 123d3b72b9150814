// Handles on the screen: one button each, so that Tab, names and touch targets come for free, and a
// ring around the selected one that turns it.
import { HandleDrag, placeOf, type DragMode } from "../tools/handle_drag.ts";
import { rotated, translated, type Motion } from "../edit/motion.ts";
import { hasMoved, type HandleDoc } from "../edit/document.ts";
import type { Stage } from "../tools/tool.ts";
import { make, makeSvg } from "./dom.ts";

/** A nudge in pixels, a turn in radians; with Shift four times as much. */
const nudge = 6;
const turn = (5 * Math.PI) / 180;

export class HandleOverlay {
  private readonly buttons = new Map<number, HTMLButtonElement>();
  private readonly ring: SVGElement;
  private readonly grip: SVGElement;
  private readonly bubble = make("div", { class: "bubble", id: "drag-me" }, make("span", {}, "Drag me"));
  /** Beside the selected pin of a picture: to the front, to the back. */
  private readonly sides = make("div", { class: "sides", role: "group", "aria-label": "Order of the pin" });
  /** The hint points at the first handle until something has been moved. */
  private greeting = true;
  private hidden = false;

  constructor(private readonly stage: Stage, private readonly root: HTMLElement) {
    const catcher = makeSvg("circle", { class: "catch", cx: "58", cy: "58", r: "46" });
    this.grip = makeSvg("circle", { class: "grip", cx: "104", cy: "58", r: "7" });
    this.ring = makeSvg("svg", { class: "ring", viewBox: "0 0 116 116", "aria-hidden": "true" },
      makeSvg("circle", { class: "track", cx: "58", cy: "58", r: "46" }), catcher, this.grip);
    this.sides.append(...(["front", "back"] as const).map((side) => this.sideButton(side)));
    this.root.append(this.ring, this.sides, this.bubble);
    this.root.addEventListener("contextmenu", (event) => event.preventDefault()); // a long press
    this.follow(catcher, () => this.stage.present.selected, () => "turn");
  }

  private sideButton(side: "front" | "back"): HTMLButtonElement {
    const [text, key] = side === "front" ? ["To front", "PageUp"] : ["To back", "PageDown"];
    const title = `${text} of what it overlaps (${key})`;
    const button = make("button", { id: `to-${side}`, class: "small", title }, text);
    button.addEventListener("click", () => {
      const { selected } = this.stage.present;
      if (selected !== undefined) this.stage.session.layer(selected, side);
    });
    return button;
  }

  /** No handles while strokes are drawn. */
  hide(on: boolean): void {
    if (this.hidden === on) return;
    this.hidden = on;
    this.refresh();
  }

  /** Parts that are only held in place have no button. */
  private get shown(): readonly HandleDoc[] {
    return this.hidden || this.stage.present.doc.sketch ? [] : this.stage.present.doc.handles.filter((h) => !h.held);
  }

  /** Matches the buttons with the document. */
  refresh(): void {
    const { doc, selected } = this.stage.present;
    if (hasMoved(doc) || doc.done.length > 0) this.greeting = false;
    for (const [id, button] of this.buttons) {
      if (this.shown.some((h) => h.id === id)) continue;
      button.remove();
      this.buttons.delete(id);
    }
    for (const handle of this.shown) {
      const button = this.buttons.get(handle.id) ?? this.add(handle.id);
      button.setAttribute("aria-label", `Handle ${handle.name}`);
      button.setAttribute("aria-pressed", String(handle.id === selected));
    }
    this.place();
  }

  /** Puts everything where the camera sees it. */
  place(): void {
    const { viewport } = this.stage;
    for (const handle of this.shown) {
      const at = viewport.toScreen(placeOf(handle));
      const button = this.buttons.get(handle.id);
      if (!button) continue;
      button.style.transform = `translate(${at.x}px, ${at.y}px)`;
      button.hidden = at.depth > 1;
    }
    this.placeRing();
    this.placeBubble();
  }

  private placeRing(): void {
    const { present, viewport } = this.stage;
    const handle = present.selected === undefined || this.hidden ? undefined : present.handle(present.selected);
    const shown = handle !== undefined && handle.vertices.length > 1;
    this.ring.toggleAttribute("hidden", !shown);
    this.sides.hidden = !handle || !this.inPlane;
    if (!handle) return;
    const at = viewport.toScreen(placeOf(handle));
    this.ring.style.transform = `translate(${at.x}px, ${at.y}px)`;
    this.sides.style.transform = `translate(calc(${at.x}px - 50%), ${at.y + 66}px)`;
    const { forward } = viewport.axes();
    const roll = handle.motion.rotation.reduce((sum, r, k) => sum + r * forward.getComponent(k), -0.7);
    this.grip.setAttribute("cx", String(58 + 46 * Math.cos(roll)));
    this.grip.setAttribute("cy", String(58 + 46 * Math.sin(roll)));
  }

  private get inPlane(): boolean {
    const { shape } = this.stage.present.doc;
    return shape.dimension === 2 && shape.triangles.length > 0;
  }

  private placeBubble(): void {
    const { viewport } = this.stage;
    const first = this.shown[0];
    this.bubble.hidden = !this.greeting || !first;
    if (!first) return;
    const at = viewport.toScreen(placeOf(first));
    this.bubble.style.transform = `translate(calc(${at.x}px - 50%), ${at.y - 104}px)`;
  }

  private add(id: number): HTMLButtonElement {
    const button = make("button", {
      class: "handle", "aria-keyshortcuts": "ArrowUp ArrowDown ArrowLeft ArrowRight [ ] Delete",
    });
    this.follow(button, () => id, (event) => (event.shiftKey ? "tilt" : "shift"));
    button.addEventListener("focus", () => this.stage.session.select(id));
    button.addEventListener("keydown", (event) => this.key(event, id));
    this.buttons.set(id, button);
    this.root.insertBefore(button, this.bubble);
    return button;
  }

  /** Makes an element drag a handle. */
  private follow(element: Element, id: () => number | undefined, mode: (event: PointerEvent) => DragMode): void {
    let drag: HandleDrag | undefined;
    const on = (type: string, listener: (event: PointerEvent) => void) =>
      element.addEventListener(type, listener as EventListener);
    on("pointerdown", (event) => {
      const handle = id();
      if (event.button !== 0 || drag || handle === undefined) return;
      element.setPointerCapture(event.pointerId);
      this.stage.session.select(handle);
      drag = new HandleDrag(this.stage, handle, mode(event), { x: event.clientX, y: event.clientY });
    });
    on("pointermove", (event) => {
      drag?.move({ x: event.clientX, y: event.clientY });
    });
    for (const type of ["pointerup", "pointercancel"]) {
      on(type, () => {
        drag?.end();
        drag = undefined;
      });
    }
  }

  private key(event: KeyboardEvent, id: number): void {
    const handle = this.stage.present.handle(id);
    if (!handle || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Delete" || event.key === "Backspace") this.remove(id);
    else if (this.inPlane && event.key === "PageUp") this.stage.session.layer(id, "front");
    else if (this.inPlane && event.key === "PageDown") this.stage.session.layer(id, "back");
    else if (event.key === "Escape") this.stage.viewport.canvas.focus();
    else {
      const motion = this.moved(handle, event);
      if (!motion) return;
      this.stage.session.nudge(id, motion);
    }
    event.preventDefault();
    event.stopPropagation();
  }

  private moved(handle: HandleDoc, event: KeyboardEvent): Motion | undefined {
    const { viewport } = this.stage;
    const times = event.shiftKey ? 4 : 1;
    const shift = (dx: number, dy: number) =>
      translated(handle.motion, viewport.shiftAt(placeOf(handle), dx * nudge * times, dy * nudge * times).toArray());
    const { forward } = viewport.axes();
    const push = (sign: number) => {
      const step = viewport.shiftAt(placeOf(handle), nudge * times, 0).length();
      return translated(handle.motion, forward.clone().multiplyScalar(sign * step).toArray());
    };
    switch (event.key) {
      case "ArrowLeft": return shift(-1, 0);
      case "ArrowRight": return shift(1, 0);
      case "ArrowUp": return shift(0, -1);
      case "ArrowDown": return shift(0, 1);
      case "PageUp": return push(1);
      case "PageDown": return push(-1);
      case "[": case "{": return rotated(handle.motion, forward.toArray(), -turn * times);
      case "]": case "}": return rotated(handle.motion, forward.toArray(), turn * times);
      default: return undefined;
    }
  }

  private remove(id: number): void {
    const ids = this.shown.map((h) => h.id);
    const next = ids[ids.indexOf(id) + 1] ?? ids[ids.indexOf(id) - 1];
    void this.stage.session.removeHandle(id);
    (next === undefined ? this.stage.viewport.canvas : this.buttons.get(next)!).focus();
  }
}
