// What a visitor has made: immutable values, so that undo is a matter of keeping the old one.
import type { Rider } from "../shapes/riders.ts";
import { boundingBox, vertexCount, type ShapeData } from "../shapes/shape.ts";
import { defaultOptions, hasLoad, methodOf, methods, scriptOptions, type Options } from "../methods.ts";
import { asTransform, atRest, centroid, inPlane, isAtRest, type Motion, type Vec3 } from "./motion.ts";
import { isPosed, sketchStep, type SketchDoc } from "./sketch_doc.ts";

export interface HandleDoc {
  readonly id: number;
  readonly name: string;
  /** Ascending vertex ids. */
  readonly vertices: Uint32Array;
  /** Centroid of the vertices at rest. */
  readonly center: Vec3;
  readonly motion: Motion;
  /** Held where it was when it was taken hold of, 3 numbers a vertex, instead of moved: not shown as a handle. */
  readonly held?: Float32Array;
}

/** What changed before some iterations of the solver. */
export interface Change {
  readonly motions: ReadonlyMap<number, Motion>;
  /** All options, where some changed. */
  readonly options?: Options | undefined;
}

export interface DragEntry extends Change {
  readonly iterations: number;
}

/** One grab: motions and options when handles or the fixed region last changed, and what happened since. */
export interface Grab {
  readonly start: ReadonlyMap<number, Motion>;
  readonly options: Options;
  readonly entries: readonly DragEntry[];
}

/** Finished steps, and the present one over their result: a sketch, or handles and a fixed region. */
export interface Doc {
  /** As it was opened. */
  readonly opened: ShapeData;
  /** Finished steps of the edit script. */
  readonly done: readonly object[];
  /** What they made of it: the rest shape of the present step. */
  readonly shape: ShapeData;
  readonly sketch: SketchDoc | undefined;
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
export const freshGrab = (handles: readonly HandleDoc[], options: Options): Grab =>
  ({ start: motionsOf(handles), options, entries: [] });

/** The same document with other constraints; the record of the session starts anew. */
export function withConstraints(doc: Doc, change: Partial<Pick<Doc, "fixed" | "handles">>): Doc {
  const next = { ...doc, ...change };
  return { ...next, grab: freshGrab(next.handles, next.options) };
}

/** The next step: over another rest shape, with the same regions, everything at rest in it. */
export function onTop(doc: Doc, shape: ShapeData, steps: readonly object[]): Doc {
  const handles = doc.handles.filter((h) => !h.held).map((h) => makeHandle(shape, h.id, h.name, h.vertices));
  const grab = freshGrab(handles, doc.options);
  return { ...doc, shape, done: [...doc.done, ...steps], handles, grab, sketch: undefined };
}

/** Nothing done: the shape as it was opened, the regions as they are. */
export function backAtRest(doc: Doc): Doc {
  const known = (v: number) => v < vertexCount(doc.opened);
  const handles = doc.handles.filter((h) => !h.held)
    .map((h) => makeHandle(doc.opened, h.id, h.name, h.vertices.filter(known))).filter((h) => h.vertices.length > 0);
  const fixed = doc.fixed.filter(known);
  return { ...doc, shape: doc.opened, done: [], fixed, handles, grab: freshGrab(handles, doc.options), sketch: undefined };
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
export function startingDoc(shape: ShapeData, like?: Pick<Doc, "method" | "options">): Doc {
  const method = shape.start?.method ? methodOf(shape.start.method) : like ? methodOf(like.method) : methods[0]!;
  const options = shape.start?.method || !like ? { ...defaultOptions(method), ...shape.start?.options } : like.options;
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
  return {
    opened: shape, shape, done: [], sketch: undefined, method: method.id, options, fixed, handles,
    grab: freshGrab(handles, options),
  };
}

/** One more run of the solver; runs with nothing changed are one entry. */
export function recorded(grab: Grab, change: Change, iterations: number): Grab {
  const last = grab.entries.at(-1);
  const changed = change.motions.size > 0 || change.options;
  if (!changed && last) {
    const longer = { ...last, iterations: last.iterations + iterations };
    return { ...grab, entries: [...grab.entries.slice(0, -1), longer] };
  }
  if (!changed) return grab; // settling after the grab itself: the step's own solve
  return { ...grab, entries: [...grab.entries, { ...change, iterations }] };
}

const triples = (flat: ArrayLike<number>, dimension: 2 | 3 = 3): number[][] =>
  Array.from({ length: flat.length / 3 }, (_, i) => Array.from({ length: dimension }, (_, k) => flat[3 * i + k]!));

const solve = { iterations: 300, tolerance: 1e-6 };

const region = (fixed: Uint32Array) => (fixed.length > 0 ? { fixed: [{ vertices: [...fixed] }] } : {});

/** Only what differs from the options before: a drag may not name others. */
function changedOptions(doc: Doc, before: Options, after: Options): object {
  const [a, b] = [before, after].map((options) => scriptOptions(doc.method, options, doc.shape)) as [Record<string, unknown>, Record<string, unknown>];
  return Object.fromEntries(Object.entries(b).filter(([key, value]) => JSON.stringify(value) !== JSON.stringify(a[key])));
}

function grabStep(doc: Doc) {
  const { dimension } = doc.shape;
  const byId = new Map(doc.handles.map((h) => [h.id, h]));
  let options = doc.grab.options;
  const entry = (e: DragEntry) => {
    const changed = e.options ? { options: changedOptions(doc, options, e.options) } : {};
    options = e.options ?? options;
    const handles = [...e.motions].map(([id, motion]) => {
      const { name, center } = byId.get(id)!;
      return { name, move: asTransform(motion, center, dimension) };
    });
    return { ...(handles.length > 0 ? { handles } : {}), ...changed, iterations: e.iterations };
  };
  const handles = doc.handles.map((h) => ({
    name: h.name,
    select: { vertices: [...h.vertices] },
    ...(h.held ? { targets: triples(h.held, dimension) } : { move: asTransform(doc.grab.start.get(h.id) ?? atRest, h.center, dimension) }),
  }));
  return {
    method: doc.method,
    options: scriptOptions(doc.method, doc.grab.options, doc.shape),
    ...region(doc.fixed),
    ...(handles.length > 0 ? { handles } : {}),
    solve,
    ...(doc.grab.entries.length > 0 ? { drag: doc.grab.entries.map(entry) } : {}),
  };
}

/** The present step of the edit script; undefined: it changes nothing. */
export function presentStep(doc: Doc): object | undefined {
  if (doc.sketch) return isPosed(doc.sketch) ? sketchStep(doc.sketch) : undefined;
  return hasMoved(doc) || hasLoad(doc.method, doc.options) ? grabStep(doc) : undefined;
}

/** Loose parts are put where they ride, the rest stays; `positions` are those after it. */
export function riderStep(riders: readonly Rider[], positions: ArrayLike<number>) {
  const vertices = riders.flatMap((rider) => [...rider.vertices]).sort((a, b) => a - b);
  const targets = vertices.map((v) => [positions[3 * v]!, positions[3 * v + 1]!, positions[3 * v + 2]!]);
  const select = { vertices };
  return { method: "arap", fixed: [{ not: select }], handles: [{ name: "riders", select, targets }], solve: { iterations: 1 } };
}

/** The document as an edit script (contract, section 3), with steps that follow the present one. */
export function editScript(doc: Doc, after: readonly object[] = []) {
  const present = presentStep(doc) ?? (doc.done.length === 0 ? grabStep(doc) : undefined);
  return { format: "pliant-edit", version: 1, steps: present ? [...doc.done, present, ...after] : doc.done, seed: 1 };
}

export const hasMoved = (doc: Doc): boolean =>
  doc.grab.entries.length > 0 || doc.handles.some((h) => h.held !== undefined || !isAtRest(h.motion));
