// What tests and curious visitors can ask the page, as `window.pliantDemo`. Reading only, apart from
// waiting: everything is done through the page itself.
import { Vector3 } from "three";
import type { App } from "./app.ts";
import { editScript } from "./edit/document.ts";
import { placeOf } from "./tools/handle_drag.ts";

export interface PliantDemo {
  /** Resolves when every action is carried out and the shape is at rest. */
  idle(): Promise<void>;
  /** Deformed and rest positions, 3 n. */
  positions(): number[];
  rest(): number[];
  fixed(): number[];
  handles(): { id: number; name: string; vertices: number[]; x: number; y: number }[];
  shape(): { id: string; name: string; vertices: number; triangles: number; diagonal: number };
  /** Where a vertex is on the page, in pixels. */
  vertexAt(vertex: number): { x: number; y: number };
  /** The vertex under a place on the page, or -1. */
  pick(x: number, y: number): number;
  script(): unknown;
  selected(): number | undefined;
}

export function installHook(app: App): void {
  const { session, viewport } = app;
  const onPage = (p: Vector3) => {
    const box = viewport.canvas.getBoundingClientRect();
    const { x, y } = viewport.toScreen(p);
    return { x: box.left + x, y: box.top + y };
  };
  const hook: PliantDemo = {
    idle: () => session.idle(),
    positions: () => [...session.positions],
    rest: () => [...session.doc.shape.positions],
    fixed: () => [...session.doc.fixed],
    handles: () => session.doc.handles.map((h) => ({ id: h.id, name: h.name, vertices: [...h.vertices], ...onPage(placeOf(h)) })),
    shape: () => ({
      id: session.doc.shape.id, name: session.doc.shape.name, vertices: session.doc.shape.positions.length / 3,
      triangles: session.doc.shape.triangles.length / 3, diagonal: app.diagonal,
    }),
    vertexAt: (v) => onPage(new Vector3().fromArray(session.positions, 3 * v)),
    pick: (x, y) => app.pick(x, y)?.vertex ?? -1,
    script: () => editScript(session.doc),
    selected: () => session.selected,
  };
  Object.assign(window, { pliantDemo: hook });
}
