// The settings beside the view: shape, method and its options, what is shown, export.
import type { Session } from "../edit/session.ts";
import { download, type ExportKind } from "../files/export.ts";
import {
  isPainting, methodOf, methods, type MethodOption, type Options, type OptionValue, type Strokes,
} from "../methods.ts";
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
  /** Each shows its option as the document has it. */
  private controls: ((options: Options) => void)[] = [];
  private readonly clear = make("button", { class: "small", id: "clear-strokes" }, "Clear strokes");
  private shownMethod = "";
  private shown: readonly unknown[] = [];
  /** Options asked for that the document does not have yet. */
  private underWay = 0;

  constructor(private readonly session: Session, private readonly actions: PanelActions) {
    for (const { id, name } of catalog) this.addShape(id, name);
    for (const { id, label, help } of methods) this.choice.append(make("option", { value: id, title: help }, label));
    this.clear.addEventListener("click", () => this.ask("strokes", []));
    this.choice.addEventListener("change", () => void session.setMethod(this.choice.value));
    const file = byId<HTMLInputElement>("file");
    file.addEventListener("change", () => {
      if (file.files?.[0]) actions.openFile(file.files[0]);
      file.value = "";
    });
    const pace = byId<HTMLInputElement>("pace");
    const showPace = () =>
      ((pace.previousElementSibling as HTMLOutputElement).value = pace.value === "0" ? "auto" : pace.value);
    showPace();
    pace.addEventListener("input", () => {
      showPace();
      session.present.setPace(Number(pace.value));
    });
    this.check("graph", actions.watchGraph);
    this.check("wire", actions.wireframe);
    for (const kind of ["png", "svg", "obj", "glb", "script"] as ExportKind[]) {
      byId(`export-${kind}`).addEventListener("click", () => download(session.present, kind).catch(actions.problem));
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
    const { doc } = this.session.present;
    const shown = [doc.shape, doc.method, doc.options];
    if (!force && shown.every((part, i) => part === this.shown[i])) return;
    // While the document is behind the controls the next press of a key goes on from what they say.
    if (this.underWay > 0 && doc.method === this.shownMethod) return;
    this.shown = shown;
    const known = catalog.some((entry) => entry.id === doc.shape.id);
    for (const radio of this.shapes.querySelectorAll("input")) {
      radio.checked = known && radio.value === doc.shape.id;
    }
    const invitation = known ? "Open a file…" : `${doc.shape.name} · open another…`;
    byId("shapes").querySelector(".file span")!.textContent = invitation;
    for (const kind of ["png", "svg"]) byId(`export-${kind}`).hidden = doc.shape.dimension !== 2 || !doc.shape.picture;
    this.choice.value = doc.method;
    if (doc.method !== this.shownMethod) this.makeOptions(doc.method);
    byId("graph").parentElement!.hidden = !methodOf(doc.method).draws.includes("graph");
    for (const control of this.controls) control(doc.options);
    this.clear.hidden = !isPainting(doc.method, doc.options) || (doc.options["strokes"] as Strokes).length === 0;
  }

  /** Carries out what a control says. */
  private ask(key: string, value: OptionValue): void {
    this.underWay++;
    void this.session.setOption(key, value).then((well) => {
      this.underWay--;
      this.refresh(!well);
    });
  }

  private makeOptions(method: string): void {
    this.shownMethod = method;
    this.controls = [];
    this.options.replaceChildren(
      ...methodOf(method).options.map((option) =>
        "min" in option
          ? this.slider(option, methodOf(method).live)
          : "choices" in option
            ? this.select(option)
            : this.toggle(option),
      ),
      this.clear,
    );
  }

  private slider(
    { key, label, help, min, max, step, log }: Extract<MethodOption, { min: number }>, live: boolean,
  ): HTMLElement {
    // In the logarithm the left end stands for 0.
    const [low, high] = log ? [Math.log10(min) - step, Math.log10(max)] : [min, max];
    const valueAt = (place: number) =>
      !log ? place : place < low + step / 2 ? 0 : Number((10 ** place).toPrecision(2));
    const placeOf = (value: number) => (!log ? value : value <= 0 ? low : Math.log10(value));
    const input = make("input", {
      type: "range", id: `option-${key}`, name: key, min: `${low}`, max: `${high}`, step: `${step}`,
    });
    const output = make("output", { for: input.id });
    const set = () => this.ask(key, valueAt(Number(input.value)));
    input.addEventListener("input", () => {
      output.value = String(valueAt(Number(input.value)));
      if (live) set();
    });
    if (!live) input.addEventListener("change", set);
    this.controls.push((options) => {
      if (valueAt(Number(input.value)) !== options[key]) input.value = String(placeOf(options[key] as number));
      output.value = String(options[key]);
    });
    // Said whose label it is, for an output could be labelled too.
    return make("label", { class: "option", title: help, for: input.id }, label, output, input);
  }

  private select({ key, label, help, choices }: Extract<MethodOption, { choices: unknown }>): HTMLElement {
    const select = make(
      "select", { id: `option-${key}`, name: key }, ...choices.map(([value, text]) => make("option", { value }, text)),
    );
    select.addEventListener("change", () => this.ask(key, select.value));
    this.controls.push((options) => (select.value = options[key] as string));
    return make("label", { class: "option wide", title: help, for: select.id }, label, select);
  }

  private toggle({ key, label, help }: MethodOption): HTMLElement {
    const input = make("input", { type: "checkbox", id: `option-${key}`, name: key });
    input.addEventListener("change", () => this.ask(key, input.checked));
    this.controls.push((options) => (input.checked = options[key] as boolean));
    return make("label", { class: "check", title: help }, input, label);
  }
}
