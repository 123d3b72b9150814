// The settings beside the view: shape, method and its options, what is shown, export.
import type { Session } from "../edit/session.ts";
import { download, type ExportKind } from "../files/export.ts";
import { methodOf, methods, type MethodOption } from "../methods.ts";
import { catalog } from "../shapes/catalog.ts";
import { byId, make } from "./dom.ts";

export interface PanelActions {
  openEntry(id: string): void;
  openFile(file: File): void;
  watchGraph(on: boolean): void;
  wireframe(on: boolean): void;
  problem(error: Error): void;
}

export class Panel {
  private readonly shapes = byId("shapes").querySelector(".chips")!;
  private readonly choice = byId<HTMLSelectElement>("method-choice");
  private readonly options = byId("options");
  private shownMethod = "";
  private shown: readonly unknown[] = [];

  constructor(private readonly session: Session, private readonly actions: PanelActions) {
    for (const { id, name } of catalog) this.addShape(id, name);
    for (const { id, label, help } of methods) this.choice.append(make("option", { value: id, title: help }, label));
    this.choice.addEventListener("change", () => void session.setMethod(this.choice.value));
    const file = byId<HTMLInputElement>("file");
    file.addEventListener("change", () => {
      if (file.files?.[0]) actions.openFile(file.files[0]);
      file.value = "";
    });
    this.check("graph", actions.watchGraph);
    this.check("wire", actions.wireframe);
    for (const kind of ["obj", "glb", "script"] as ExportKind[]) {
      byId(`export-${kind}`).addEventListener("click", () => download(session, kind).catch(actions.problem));
    }
    const toggle = byId("panel-toggle");
    const narrow = matchMedia("(max-width: 720px)");
    const open = (on: boolean) => toggle.setAttribute("aria-expanded", String(on));
    toggle.addEventListener("click", () => open(toggle.getAttribute("aria-expanded") === "false"));
    narrow.addEventListener("change", () => open(!narrow.matches));
    open(!narrow.matches);
  }

  private addShape(id: string, name: string): HTMLInputElement {
    const radio = make("input", { type: "radio", name: "shape", value: id });
    radio.addEventListener("change", () => this.actions.openEntry(id));
    this.shapes.append(make("label", {}, radio, make("span", {}, name)));
    return radio;
  }

  private check(id: string, set: (on: boolean) => void): void {
    const box = byId<HTMLInputElement>(id);
    box.addEventListener("change", () => set(box.checked));
  }

  /** Matches the controls with the document; `force`: also where they were set but the document did not follow. */
  refresh(force = false): void {
    const { doc } = this.session;
    const shown = [doc.shape, doc.method, doc.options];
    if (!force && shown.every((part, i) => part === this.shown[i])) return;
    this.shown = shown;
    const known = catalog.some((entry) => entry.id === doc.shape.id);
    for (const radio of this.shapes.querySelectorAll("input")) {
      radio.checked = known && radio.value === doc.shape.id;
    }
    byId("shapes").querySelector(".file span")!.textContent = known ? "Open a file…" : `${doc.shape.name} · open another…`;
    this.choice.value = doc.method;
    if (doc.method !== this.shownMethod) this.makeOptions(doc.method);
    for (const input of this.options.querySelectorAll("input")) {
      const value = doc.options[input.name];
      if (typeof value === "boolean") input.checked = value;
      else (input.previousElementSibling as HTMLOutputElement).value = input.value = String(value);
    }
  }

  private makeOptions(method: string): void {
    this.shownMethod = method;
    this.options.replaceChildren(...methodOf(method).options.map((option) =>
      "min" in option ? this.slider(option) : this.toggle(option)));
  }

  private slider({ key, label, help, min, max, step }: Extract<MethodOption, { min: number }>): HTMLElement {
    const input = make("input", { type: "range", id: `option-${key}`, name: key, min: `${min}`, max: `${max}`, step: `${step}` });
    const output = make("output", { for: input.id });
    input.addEventListener("input", () => (output.value = input.value));
    input.addEventListener("change", () => void this.session.setOption(key, Number(input.value)));
    return make("label", { class: "option", title: help, for: input.id }, label, output, input); // an output could be labelled too
  }

  private toggle({ key, label, help }: MethodOption): HTMLElement {
    const input = make("input", { type: "checkbox", id: `option-${key}`, name: key });
    input.addEventListener("change", () => void this.session.setOption(key, input.checked));
    return make("label", { class: "check", title: help }, input, label);
  }
}
