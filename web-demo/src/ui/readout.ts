// Figures of the present: what the solver did and what it did to the shape.
import type { Present } from "../edit/present.ts";
import { byId, make } from "./dom.ts";

const percent = (x: number | undefined) => (x === undefined ? "–" : `${(100 * x).toFixed(1)} %`);

function figure(x: number | undefined): string {
  if (x === undefined) return "–";
  if (x === 0) return "0";
  return x < 1e-3 || x >= 1e5 ? x.toExponential(2) : x.toPrecision(4);
}

export class Readout {
  private readonly values = new Map<string, HTMLElement>();

  constructor(private readonly present: Present) {
    const list = byId("readout");
    for (const [id, label] of [
      ["state", "State"], ["energy", "Energy"], ["iterations", "Iterations"], ["ms", "Time a step"],
      ["volume", "Volume"], ["stretch", "Mean stretch"], ["vertices", "Vertices"],
    ] as const) {
      const value = make("dd", { id: `readout-${id}` }, "–");
      if (id === "state") value.replaceChildren(make("span", { class: "state" }));
      const kind = { class: ["state", "energy", "iterations", "ms"].includes(id) ? "solver" : "" };
      value.className = kind.class;
      list.append(make("dt", kind, label), value);
      this.values.set(id, value);
    }
  }

  refresh(): void {
    const { step, report, motion } = this.present;
    this.set("state", { settled: "settled", moving: "on its way", swinging: "to and fro" }[motion]);
    this.values.get("state")!.firstElementChild?.setAttribute("data-motion", motion);
    this.set("energy", figure(step?.energy));
    this.set("iterations", step ? String(step.iteration) : "–");
    this.set("ms", step ? `${step.milliseconds.toFixed(1)} ms` : "–");
    const { stretch, volume } = this.present.measures();
    this.set("volume", percent(volume));
    this.set("stretch", percent(stretch));
    this.set("vertices", report.vertices.toLocaleString("en"));
  }

  private set(id: string, text: string): void {
    const place = this.values.get(id)!;
    const element = place.firstElementChild ?? place;
    if (element.textContent !== text) element.textContent = text;
  }
}
