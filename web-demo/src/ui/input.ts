// Pointer and keys on the view: what the tool does not take is the camera's.
import type { Stage, Tool } from "../tools/tool.ts";
import { byId } from "./dom.ts";

/** Pixels: what touches in a larger patch is a palm. */
const palm = 48;
/** Pixels that a finger may have moved before a second one makes it a gesture of the camera. */
const fingerSlack = 24;

const isPalm = (event: PointerEvent): boolean =>
  event.pointerType === "touch" && Math.max(event.width, event.height) > palm;

export class Input {
  private holder: number | undefined; // the pointer the tool has
  private first: PointerEvent | undefined; // how it went down
  private travelled = 0;
  private readonly pens = new Set<number>();
  private readonly replayed = new WeakSet<Event>();
  private readonly cross = byId("cross");

  constructor(private readonly stage: Stage, private readonly tool: () => Tool) {
    const { canvas } = stage.viewport;
    // Before the camera's own listener, on the way down.
    byId("stage").addEventListener("pointerdown", (event) => this.down(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const type of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(type, (event) => this.up(event));
    }
    canvas.addEventListener("pointerleave", () => this.tool().hover?.(undefined));
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("focus", () => this.useKeys(canvas.matches(":focus-visible")));
    canvas.addEventListener("blur", () => this.useKeys(false));
  }

  /** Whether the visitor works in the view with the keyboard: its frame shows, and the cross. */
  private useKeys(on: boolean): void {
    this.stage.viewport.canvas.toggleAttribute("data-keys", on);
    this.refresh();
  }

  /** The cross stands in the middle while the keyboard is in the view and the tool can use it. */
  refresh(): void {
    const { canvas, middle } = this.stage.viewport;
    this.cross.style.transform = `translate(${middle.x}px, ${middle.y}px)`;
    this.cross.hidden = !(canvas.hasAttribute("data-keys") && this.tool().act);
    canvas.dataset["tool"] = this.tool().id;
    this.stage.showBrush();
  }

  private down(event: PointerEvent): void {
    const { canvas } = this.stage.viewport;
    if (event.target !== canvas || this.replayed.has(event)) return;
    this.useKeys(false);
    if (isPalm(event) || (event.pointerType === "touch" && this.pens.size > 0)) return event.stopPropagation();
    if (event.pointerType === "pen") this.penDown(event.pointerId);
    if (event.button !== 0) return;
    if (this.holder !== undefined) return this.second(event);
    if (!this.tool().down({ x: event.clientX, y: event.clientY })) return;
    this.holder = event.pointerId;
    this.first = event;
    canvas.setPointerCapture(event.pointerId);
    event.stopPropagation();
  }

  /** A pen takes over from the hand it rests on. */
  private penDown(id: number): void {
    this.pens.add(id);
    if (this.first?.pointerType === "touch") this.letGo();
  }

  /** A second finger: both are the camera's, unless the first has drawn already. */
  private second(event: PointerEvent): void {
    if (event.pointerType !== "touch" || this.first?.pointerType !== "touch" || this.travelled > fingerSlack) {
      return event.stopPropagation();
    }
    const first = new PointerEvent("pointerdown", this.first);
    this.letGo();
    this.replayed.add(first);
    this.stage.viewport.canvas.dispatchEvent(first);
  }

  private letGo(): void {
    this.holder = this.first = undefined;
    this.travelled = 0;
    this.tool().cancel?.();
  }

  private move(event: PointerEvent): void {
    const at = { x: event.clientX, y: event.clientY };
    if (event.pointerId !== this.holder) {
      if (event.buttons === 0) this.tool().hover?.(at);
      return;
    }
    if (isPalm(event)) return this.letGo();
    this.travelled = Math.max(this.travelled, Math.hypot(at.x - this.first!.clientX, at.y - this.first!.clientY));
    const samples = event.getCoalescedEvents().map(({ clientX: x, clientY: y }) => ({ x, y }));
    this.tool().move?.(at, samples.length > 0 ? samples : [at]);
  }

  private up(event: PointerEvent): void {
    this.pens.delete(event.pointerId);
    if (event.pointerId !== this.holder) return;
    if (event.type === "pointercancel" && this.tool().cancel) return this.letGo();
    this.holder = this.first = undefined;
    this.travelled = 0;
    this.tool().up?.();
    if (event.pointerType !== "mouse") this.tool().hover?.(undefined);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { viewport } = this.stage;
    const step = event.shiftKey ? 0.4 : 0.1;
    switch (event.key) {
      case "ArrowLeft": viewport.orbit(-step, 0); break;
      case "ArrowRight": viewport.orbit(step, 0); break;
      case "ArrowUp": viewport.orbit(0, -step); break;
      case "ArrowDown": viewport.orbit(0, step); break;
      case "+": case "=": viewport.zoom(0.9); break;
      case "-": viewport.zoom(1 / 0.9); break;
      case "Enter": case " ": this.act(); break;
      default: return;
    }
    this.useKeys(true);
    event.preventDefault();
  }

  private act(): void {
    const { canvas, middle } = this.stage.viewport;
    const box = canvas.getBoundingClientRect();
    this.tool().act?.({ x: box.left + middle.x, y: box.top + middle.y });
  }
}
