// The tools at the bottom of the page, with a size where a tool has one.
import type { Tool } from "../tools/tool.ts";
import { byId, make } from "./dom.ts";
import { icon } from "./icons.ts";

const usable = (tool: Tool): boolean => tool.available?.() ?? true;

export class Toolbar {
  private readonly buttons: HTMLButtonElement[];
  private readonly slider = byId<HTMLInputElement>("size");
  private readonly row = byId("size-row");
  private readonly sizes = new Map<Tool, number>();
  current: Tool;

  constructor(private readonly tools: Tool[], private readonly changed: () => void) {
    this.current = tools[0]!;
    this.buttons = tools.map((tool, i) => {
      const button = make(
        "button",
        { role: "radio", id: `tool-${tool.id}`, title: `${tool.hint} (${i + 1})`, "aria-keyshortcuts": `${i + 1}` },
        icon(tool.icon),
        tool.label,
      );
      button.addEventListener("click", () => this.choose(i));
      button.addEventListener("keydown", (event) => this.key(event, i));
      return button;
    });
    for (const tool of tools) this.sizes.set(tool, tool.size?.start ?? 0);
    byId("tools").append(...this.buttons);
    this.slider.addEventListener("input", () => this.sizes.set(this.current, Number(this.slider.value) / 100));
    this.row.hidden = true;
    this.choose(this.tools.findIndex(usable));
  }

  /** Of the current tool, as a share of the shape's diagonal. */
  get size(): number {
    const { size } = this.current;
    return size ? size.min + (size.max - size.min) * this.sizes.get(this.current)! ** 1.6 : 0;
  }

  /** Shows the tools that can be used; where the current one cannot, the next takes over. */
  refresh(): void {
    this.tools.forEach((tool, i) => (this.buttons[i]!.hidden = !usable(tool)));
    if (!usable(this.current)) this.choose(this.tools.findIndex(usable));
  }

  chooseById(id: string): void {
    if (this.current.id !== id) this.choose(this.tools.findIndex((tool) => tool.id === id));
  }

  choose(index: number): void {
    const tool = this.tools[index];
    if (!tool || !usable(tool)) return;
    this.current = tool;
    this.buttons.forEach((button, i) => {
      button.setAttribute("aria-checked", String(i === index));
      button.tabIndex = i === index ? 0 : -1;
    });
    this.row.hidden = tool.size === undefined;
    this.slider.value = String(100 * this.sizes.get(tool)!);
    this.changed();
  }

  /** A radio group: arrows choose. */
  private key(event: KeyboardEvent, index: number): void {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (step === undefined) return;
    const count = this.tools.length;
    let next = index;
    do next = (next + step + count) % count;
    while (!usable(this.tools[next]!));
    this.choose(next);
    this.buttons[next]!.focus();
    event.preventDefault();
  }
}
