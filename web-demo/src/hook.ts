// What tests and curious visitors can ask the page, as `window.pliantDemo`. Reading only, apart from
// waiting: everything is done through the page itself.
import { Vector3 } from "three";
import type { App } from "./app.ts";
import { placeOf } from "./tools/handle_drag.ts";

export interface PliantDemo {
  /** Resolves when every action is carried out and the shape is at rest. */
  idle(): Promise<void>;
  /** Deformed and rest positions, 3 n. */
  positions(): number[];
  rest(): number[];
  /** Of the shape as it was opened, 3 m. */
  triangles(): number[];
  fixed(): number[];
  handles(): { id: number; name: string; vertices: number[]; x: number; y: number }[];
  shape(): { id: string; name: string; vertices: number; triangles: number; diagonal: number };
  /** Where a vertex is on the page, in pixels. */
  vertexAt(vertex: number): { x: number; y: number };
  /** Where a point in space is on the page. */
  project(point: [number, number, number]): { x: number; y: number };
  /** The vertex under a place on the page, or -1. */
  pick(x: number, y: number): number;
  script(): unknown;
  /** The limb under strokes: a label and a parameter a vertex, and the curve it lies on, on the page. */
  limb(): { labels: number[]; s: number[]; curve: { x: number; y: number }[] } | undefined;
  /** Whether the shape is at rest, on its way, or goes to and fro. */
  motion(): string;
  selected(): number | undefined;
}

export function installHook(app: App): void {
  const { session, session: { present }, viewport } = app;
  const onPage = (p: Vector3) => {
    const box = viewport.canvas.getBoundingClientRect();
    const { x, y } = viewport.toScreen(p);
    return { x: box.left + x, y: box.top + y };
  };
  const hook: PliantDemo = {
    idle: () => session.idle(),
    positions: () => [...present.positions],
    rest: () => [...present.doc.opened.positions],
    triangles: () => [...present.doc.opened.triangles],
    fixed: () => [...present.doc.fixed],
    handles: () =>
      present.doc.handles
        .filter((h) => !h.held)
        .map((h) => ({ id: h.id, name: h.name, vertices: [...h.vertices], ...onPage(placeOf(h)) })),
    shape: () => ({
      id: present.doc.shape.id, name: present.doc.shape.name, vertices: present.shown.positions.length / 3,
      triangles: present.shown.triangles.length / 3, diagonal: app.diagonal,
    }),
    vertexAt: (v) => onPage(new Vector3().fromArray(present.positions, 3 * v)),
    project: (point) => onPage(new Vector3(...point)),
    pick: (x, y) => app.pick(x, y)?.vertex ?? -1,
    script: () => present.script(),
    limb: () => {
      const { sketched } = present;
      if (!sketched) return undefined;
      const points = Array.from({ length: sketched.target.length / 3 }, (_, i) =>
        new Vector3().fromArray(sketched.target, 3 * i),
      );
      return {
        labels: [...Array.from(sketched.labels)], s: [...Array.from(sketched.parameters)], curve: points.map(onPage),
      };
    },
    motion: () => present.motion,
    selected: () => present.selected,
  };
  Object.assign(window, { pliantDemo: hook });
}
