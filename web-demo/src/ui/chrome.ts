// Everything around the view that belongs to no tool: history, help, notices, drops, global keys.
import type { Session } from "../edit/session.ts";
import { byId } from "./dom.ts";
import { icon, type IconName } from "./icons.ts";

export interface ChromeActions {
  undo(): void;
  redo(): void;
  reset(): void;
  home(): void;
  tool(index: number): void;
  /** A way of using strokes, by its first letter; "Escape" lets go of the limb. Whether it was of use. */
  stroke(key: string): boolean;
  open(file: File): void;
}

export interface Chrome {
  refresh(session: Session): void;
  hint(text: string): void;
  /** A notice that stays until dismissed; empty: none. */
  say(text: string): void;
  /** Something is being made ready. */
  busy(on: boolean): void;
  /** A file is being read: how much of it, from 0 to 1; undefined: none is. `cancel` follows a wish to stop. */
  reading(name: string, fraction: number | undefined, cancel?: () => void): void;
}

export function bindChrome(actions: ChromeActions): Chrome {
  const help = byId<HTMLDialogElement>("help");
  const notice = byId("notice");
  const button = (id: string, name: IconName, act: () => void) => {
    byId(id).append(icon(name));
    byId(id).addEventListener("click", act);
  };
  button("undo", "undo", actions.undo);
  button("redo", "redo", actions.redo);
  button("reset", "reset", actions.reset);
  button("home", "home", actions.home);
  button("help-open", "help", () => help.showModal());
  help.querySelector("button")!.append(icon("close"));
  notice.querySelector("button")!.append(icon("close"));
  notice.querySelector("button")!.addEventListener("click", () => (notice.hidden = true));
  bindKeys(actions, help);
  bindDrop(actions.open);
  return {
    refresh: ({ canUndo, canRedo }) => {
      byId<HTMLButtonElement>("undo").disabled = !canUndo;
      byId<HTMLButtonElement>("redo").disabled = !canRedo;
    },
    hint: (text) => (byId("hint").textContent = text),
    busy: (on) => byId("stage").setAttribute("aria-busy", String(on)),
    reading: showReading,
    say: (text) => {
      notice.hidden = text === "";
      notice.querySelector("span")!.textContent = text;
    },
  };
}

function showReading(name: string, fraction: number | undefined, cancel?: () => void): void {
  const box = byId("reading");
  box.hidden = fraction === undefined;
  if (fraction === undefined) return;
  box.querySelector("span")!.textContent = `Reading ${name}: ${Math.round(100 * fraction)} %`;
  box.querySelector("progress")!.value = fraction;
  byId("reading-cancel").onclick = cancel ?? null;
}

function bindKeys(actions: ChromeActions, help: HTMLDialogElement): void {
  const click = (id: string) => () => byId(id).click();
  const plain: Record<string, () => void> = {
    r: actions.reset, 0: actions.home, g: click("graph"), w: click("wire"), "?": () => help.showModal(),
    ...Object.fromEntries([0, 1, 2, 3, 4, 5].map((i) => [i + 1, () => actions.tool(i)])),
  };
  document.addEventListener("keydown", (event) => {
    if (help.open) return;
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      if (key !== "z" && key !== "y") return;
      (key === "y" || event.shiftKey ? actions.redo : actions.undo)();
    } else {
      const typing = event.target instanceof HTMLSelectElement || event.altKey;
      if (typing) return;
      const act = plain[key];
      if (act) act();
      else if (!actions.stroke(key)) return;
    }
    event.preventDefault();
  });
}

function bindDrop(open: (file: File) => void): void {
  const veil = byId("drop");
  const hasFile = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  document.addEventListener("dragover", (event) => {
    if (!hasFile(event)) return;
    event.preventDefault();
    veil.hidden = false;
  });
  document.addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) veil.hidden = true;
  });
  document.addEventListener("drop", (event) => {
    veil.hidden = true;
    const file = event.dataTransfer?.files[0];
    if (!file) return;
    event.preventDefault();
    open(file);
  });
}
