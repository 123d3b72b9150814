// What a visitor has made: immutable values, so that undo is a matter of keeping the old one.
import { boundingBox, vertexCount, type ShapeData } from "../shapes/shape.ts";
import { defaultOptions, fittingOptions, methods, type Options } from "../methods.ts";
import { asTransform, atRest, centroid, inPlane, isAtRest, type Motion, type Vec3 } from "./motion.ts";

export interface HandleDoc {
  readonly id: number;
  readonly name: string;
  /** Ascending vertex ids. */
  readonly vertices: Uint32Array;
  /** Centroid of the vertices at rest. */
  readonly center: Vec3;
  readonly motion: Motion;
}

/** Some iterations of the solver, and the handles that were moved just before. */
export interface DragEntry {
  readonly motions: ReadonlyMap<number, Motion>;
  readonly iterations: number;
}

/** One grab: the motions when handles or the fixed region last changed, and what happened since. */
export interface Grab {
  readonly start: ReadonlyMap<number, Motion>;
  readonly entries: readonly DragEntry[];
}

export interface Doc {
  readonly shape: ShapeData;
  readonly method: string;
  readonly options: Options;
  /** Ascending vertex ids. */
  readonly fixed: Uint32Array;
  readonly handles: readonly HandleDoc[];
  readonly grab: Grab;
}

export function makeHandle(shape: ShapeData, id: number, name: string, vertices: Uint32Array, motion = atRest): HandleDoc {
  return { id, name, vertices, center: centroid(shape.positions, vertices), motion };
}

export const motionsOf = (handles: readonly HandleDoc[]): Map<number, Motion> =>
  new Map(handles.map((h) => [h.id, h.motion]));

/** A grab that starts from the handles as they are. */
export const freshGrab = (handles: readonly HandleDoc[]): Grab => ({ start: motionsOf(handles), entries: [] });

/** The same document with other constraints; the record of the session starts anew. */
export function withConstraints(doc: Doc, change: Partial<Pick<Doc, "fixed" | "handles">>): Doc {
  const next = { ...doc, ...change };
  return { ...next, grab: freshGrab(next.handles) };
}

export function withMotion(doc: Doc, id: number, motion: Motion): Doc {
  const possible = doc.shape.dimension === 2 ? inPlane(motion) : motion;
  return { ...doc, handles: doc.handles.map((h) => (h.id === id ? { ...h, motion: possible } : h)) };
}

const vertexIds = (shape: ShapeData, inside: (v: number) => boolean): Uint32Array =>
  Uint32Array.from({ length: vertexCount(shape) }, (_, v) => v).filter(inside);

const point = (shape: ShapeData, v: number): [number, number, number] =>
  [shape.positions[3 * v]!, shape.positions[3 * v + 1]!, shape.positions[3 * v + 2]!];

/** The pose a visitor finds: the catalog's, or for a file the lowest tenth fixed and no handle. */
export function startingDoc(shape: ShapeData, method = methods[0]!): Doc {
  const handles: HandleDoc[] = [];
  for (const { name, center, radius } of shape.start?.handles ?? []) {
    const near = (v: number) => Math.hypot(...point(shape, v).map((x, k) => x - center[k]!)) <= radius;
    const vertices = vertexIds(shape, near);
    if (vertices.length > 0) handles.push(makeHandle(shape, handles.length + 1, name, vertices));
  }
  const { min, max } = boundingBox(shape.positions);
  const low = min[1] + 0.1 * (max[1] - min[1]);
  const rule = shape.start?.fixed ?? (([, y]: readonly number[]) => y! <= low);
  const moved = new Set(handles.flatMap((h) => [...h.vertices]));
  const fixed = vertexIds(shape, (v) => !moved.has(v) && rule(point(shape, v)));
  return { shape, method: method.id, options: defaultOptions(method), fixed, handles, grab: freshGrab(handles) };
}

/** One more run of the solver; runs under unchanged targets are one entry. */
export function recorded(grab: Grab, motions: ReadonlyMap<number, Motion>, iterations: number): Grab {
  const last = grab.entries.at(-1);
  if (motions.size === 0 && last) {
    const longer = { ...last, iterations: last.iterations + iterations };
    return { ...grab, entries: [...grab.entries.slice(0, -1), longer] };
  }
  if (motions.size === 0) return grab; // settling after the grab itself: the step's own solve
  return { ...grab, entries: [...grab.entries, { motions, iterations }] };
}

/** The session as an edit script (contract, section 3): replaying it gives the pose on the screen. */
export function editScript(doc: Doc) {
  const byId = new Map(doc.handles.map((h) => [h.id, h]));
  const entry = (e: DragEntry) => ({
    handles: [...e.motions].map(([id, motion]) => {
      const { name, center } = byId.get(id)!;
      return { name, move: asTransform(motion, center, doc.shape.dimension) };
    }),
    iterations: e.iterations,
  });
  const step = {
    method: doc.method,
    options: fittingOptions(doc.options, vertexCount(doc.shape)),
    ...(doc.fixed.length > 0 ? { fixed: [{ vertices: [...doc.fixed] }] } : {}),
    handles: doc.handles.map((h) => ({
      name: h.name,
      select: { vertices: [...h.vertices] },
      move: asTransform(doc.grab.start.get(h.id) ?? atRest, h.center, doc.shape.dimension),
    })),
    solve: { iterations: 100, tolerance: 1e-6 },
    ...(doc.grab.entries.length > 0 ? { drag: doc.grab.entries.map(entry) } : {}),
  };
  return { format: "pliant-edit", version: 1, steps: [step], seed: 1 };
}

export const hasMoved = (doc: Doc): boolean => doc.handles.some((h) => !isAtRest(h.motion));
