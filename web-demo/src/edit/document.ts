// What a visitor has made: immutable values, so that undo is a matter of keeping the old one.
import { boundingBox, vertexCount, type ShapeData } from "../shapes/shape.ts";
import { defaultOptions, followOf, hasLoad, methodOf, methods, scriptOptions, type Options } from "../methods.ts";
import { asTransform, atRest, centroid, inPlane, isAtRest, type Motion, type Vec3 } from "./motion.ts";
import type { DocumentStep, EditDocument, EditRun } from "../solver/pliant.ts";
import { chosenStep, isPosed, sketchStep, type SketchDoc } from "./sketch_doc.ts";

export interface HandleDoc {
  readonly id: number;
  readonly name: string;
  /** Ascending vertex ids. */
  readonly vertices: Uint32Array;
  /** Centroid of the vertices at rest. */
  readonly center: Vec3;
  readonly motion: Motion;
  /** How far in front it lies where a picture overlaps itself; absent: 0, unless others say otherwise. */
  readonly depth?: number;
  /** Held where it was when it was taken hold of, 3 numbers a vertex, instead of moved: not shown as a handle. */
  readonly held?: Float32Array;
}

/** What changed before some iterations of the solver. */
export interface DragEntry {
  readonly motions: ReadonlyMap<number, Motion>;
  /** All options, where some changed. */
  readonly options?: Options | undefined;
  /** As many as there were; while it is under way, as many as there may be. */
  readonly iterations: number;
}

/** One grab: motions and options when handles or the fixed region last changed, and what happened since. */
export interface Grab {
  readonly start: ReadonlyMap<number, Motion>;
  readonly options: Options;
  /**
   * Iterations of the step's own solve, and whether it came to rest; `cut`: it ended after so many, for a handle was
   * moved.
   */
  readonly solved: number;
  readonly settled: boolean;
  readonly cut?: number;
  readonly entries: readonly DragEntry[];
  /** What the last entry left. */
  readonly now: { readonly motions: ReadonlyMap<number, Motion>; readonly options: Options };
}

/** Finished steps, and the present one over their result: a sketch, or handles and a fixed region. */
export interface Doc {
  /** As it was opened. */
  readonly opened: ShapeData;
  /** Finished steps of the edit script. */
  readonly done: readonly DocumentStep[];
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

export function makeHandle(
  shape: ShapeData, id: number, name: string, vertices: Uint32Array, motion = atRest,
): HandleDoc {
  return { id, name, vertices, center: centroid(shape.positions, vertices), motion };
}

export const motionsOf = (handles: readonly HandleDoc[]): Map<number, Motion> =>
  new Map(handles.map((h) => [h.id, h.motion]));

/** A grab that starts from the handles as they are. */
export function freshGrab(handles: readonly HandleDoc[], options: Options): Grab {
  const start = motionsOf(handles);
  return { start, options, solved: 0, settled: false, entries: [], now: { motions: start, options } };
}

/** The same document with other constraints; the record of the session starts anew. */
export function withConstraints(doc: Doc, change: Partial<Pick<Doc, "fixed" | "handles">>): Doc {
  const next = { ...doc, ...change };
  return { ...next, grab: freshGrab(next.handles, next.options) };
}

/** The next step: over another rest shape, with the same regions, everything at rest in it. */
export function onTop(doc: Doc, shape: ShapeData, step: DocumentStep): Doc {
  const handles = doc.handles.filter((h) => !h.held).map((h) => makeHandle(shape, h.id, h.name, h.vertices));
  const grab = freshGrab(handles, doc.options);
  return { ...doc, shape, done: [...doc.done, step], handles, grab, sketch: undefined };
}

/** Nothing done: the shape as it was opened, the regions as they are. */
export function backAtRest(doc: Doc): Doc {
  const known = (v: number) => v < vertexCount(doc.opened);
  const handles = doc.handles.filter((h) => !h.held)
    .map((h) => makeHandle(doc.opened, h.id, h.name, h.vertices.filter(known))).filter((h) => h.vertices.length > 0);
  const fixed = doc.fixed.filter(known);
  return {
    ...doc, shape: doc.opened, done: [], fixed, handles, grab: freshGrab(handles, doc.options), sketch: undefined,
  };
}

export function withMotion(doc: Doc, id: number, motion: Motion): Doc {
  const possible = doc.shape.dimension === 2 ? inPlane(motion) : motion;
  return { ...doc, handles: doc.handles.map((h) => (h.id === id ? { ...h, motion: possible } : h)) };
}

/** With a handle in front of all others, or behind them. */
export function withDepth(doc: Doc, id: number, side: "front" | "back"): Doc {
  const others = doc.handles.filter((h) => h.id !== id).map(({ depth = 0 }) => depth);
  const depth = side === "front" ? Math.max(0, ...others) + 1 : Math.min(0, ...others) - 1;
  const handles = doc.handles.map((h) => (h.id === id ? { ...h, depth } : h));
  return { ...doc, handles, grab: { ...doc.grab, start: new Map(doc.grab.start) } }; // written down anew
}

function vertexIds(shape: ShapeData, inside: (v: number) => boolean): Uint32Array {
  const ids: number[] = [];
  for (let v = 0; v < vertexCount(shape); v++) if (inside(v)) ids.push(v);
  return Uint32Array.from(ids);
}

const point = (shape: ShapeData, v: number): [number, number, number] =>
  [shape.positions[3 * v]!, shape.positions[3 * v + 1]!, shape.positions[3 * v + 2]!];

/** The vertices in the lowest part of a shape, a share of its height. */
function lowest(shape: ShapeData, share: number): Uint32Array {
  const { min, max } = boundingBox(shape.positions);
  const low = min[1] + share * (max[1] - min[1]);
  return vertexIds(shape, (v) => shape.positions[3 * v + 1]! <= low);
}

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
  const moved = new Set(handles.flatMap((h) => [...h.vertices]));
  const rule = shape.start?.fixed;
  const fixed = rule ? vertexIds(shape, (v) => !moved.has(v) && rule(point(shape, v))) : lowest(shape, 0.1);
  return {
    opened: shape, shape, done: [], sketch: undefined, method: method.id, options, fixed, handles,
    grab: freshGrab(handles, options),
  };
}

/** Iterations after the last change at which a shape that never comes to rest is left alone. */
const patience = 300;

/** With all that differs from what the grab says in an entry of its own, which is then under way. */
export function withChanges(doc: Doc): Doc {
  const { grab, handles, options } = doc;
  const moved = handles.filter((h) => !h.held && grab.now.motions.get(h.id) !== h.motion);
  const motions = motionsOf(moved);
  const otherOptions = grab.now.options !== options;
  if (doc.sketch || (motions.size === 0 && !otherOptions)) return doc;
  const entry: DragEntry = { motions, iterations: patience, ...(otherOptions ? { options } : {}) };
  const cut = grab.entries.length === 0 && !grab.settled ? { cut: Math.max(1, grab.solved) } : {};
  const now = { motions: new Map([...grab.now.motions, ...motions]), options };
  return { ...doc, grab: { ...grab, ...cut, now, entries: [...grab.entries, entry] } };
}

/** After a run: how many iterations what is under way has had. */
export function withRun(doc: Doc, { step, iterations, entry, done, converged }: EditRun): Doc {
  const { grab } = doc;
  const mine = iterations > 0 && step === doc.done.length;
  if (doc.sketch) return doc;
  if (grab.entries.length === 0) {
    return { ...doc, grab: { ...grab, solved: mine ? done : grab.solved, settled: converged } };
  }
  if (!mine || entry < 0) return doc;
  const entries = grab.entries.map((e, i) => (i === entry ? { ...e, iterations: Math.max(1, done) } : e));
  return { ...doc, grab: { ...grab, entries } };
}

/** Goes on with what is under way. */
function open(entries: readonly DragEntry[]): readonly DragEntry[] {
  const last = entries.at(-1);
  return last ? [...entries.slice(0, -1), { ...last, iterations: last.iterations + patience }] : entries;
}

const triples = (flat: ArrayLike<number>, dimension: 2 | 3 = 3): number[][] =>
  Array.from({ length: flat.length / 3 }, (_, i) => Array.from({ length: dimension }, (_, k) => flat[3 * i + k]!));

const tolerance = 1e-6;

const region = (fixed: Uint32Array) => (fixed.length > 0 ? { fixed: [{ vertices: [...fixed] }] } : {});

/** Only what differs from the options before: a drag may not name others. */
function changedOptions(doc: Doc, before: Options, after: Options): object {
  const [a, b] = [before, after].map((options) => scriptOptions(doc.method, options, doc.shape)) as [
    Record<string, unknown>, Record<string, unknown>,
  ];
  return Object.fromEntries(
    Object.entries(b).filter(([key, value]) => JSON.stringify(value) !== JSON.stringify(a[key])),
  );
}

type Remembered = { handles?: unknown; fixed?: unknown };
/** Of grabs: what stays while they last is one object, which nobody has to look at again. */
const remembered = new WeakMap<Grab["start"], Remembered>();
const entrySteps = new WeakMap<DragEntry, object>();

function regionsOf(doc: Doc): Remembered {
  const known = remembered.get(doc.grab.start);
  if (known) return known;
  const { dimension } = doc.shape;
  const handles = doc.handles.map((h) => ({
    name: h.name,
    select: { vertices: [...h.vertices] },
    ...(h.depth === undefined ? {} : { depth: h.depth }),
    ...(h.held
      ? { targets: triples(h.held, dimension) }
      : { move: asTransform(doc.grab.start.get(h.id) ?? atRest, h.center, dimension) }),
  }));
  const regions = { ...region(doc.fixed), ...(handles.length > 0 ? { handles } : {}) };
  remembered.set(doc.grab.start, regions);
  return regions;
}

function entryStep(doc: Doc, entry: DragEntry, before: Options): object {
  const known = entrySteps.get(entry);
  if (known) return known;
  const byId = new Map(doc.handles.map((h) => [h.id, h]));
  const handles = [...entry.motions].map(([id, motion]) => {
    const { name, center } = byId.get(id)!;
    return { name, move: asTransform(motion, center, doc.shape.dimension) };
  });
  const options = entry.options ? { options: changedOptions(doc, before, entry.options) } : {};
  const step = { ...(handles.length > 0 ? { handles } : {}), ...options, iterations: entry.iterations };
  entrySteps.set(entry, step);
  return step;
}

function grabStep(doc: Doc, entries: readonly DragEntry[], iterations: number): DocumentStep {
  let { options } = doc.grab;
  const drag = entries.map((entry) => {
    const step = entryStep(doc, entry, options);
    options = entry.options ?? options;
    return step;
  });
  return {
    method: doc.method,
    options: scriptOptions(doc.method, doc.grab.options, doc.shape),
    ...regionsOf(doc),
    solve: { iterations, tolerance },
    ...followOf(doc.method, doc.shape),
    ...(drag.length > 0 ? { drag } : {}),
  } as DocumentStep;
}

/** The present step as it stands, without what is still to come of it; undefined: it changes nothing. */
export function finishedStep(doc: Doc): DocumentStep | undefined {
  if (doc.sketch) return isPosed(doc.sketch) ? sketchStep(doc.sketch, doc.shape) : undefined;
  const { entries, solved, settled, cut = settled ? patience : Math.max(1, solved) } = doc.grab;
  return asksForSomething(doc) ? grabStep(doc, entries, cut) : undefined;
}

const asksForSomething = (doc: Doc) =>
  hasMoved(doc) || hasLoad(doc.method, doc.grab.options) || hasLoad(doc.method, doc.options);

const documentOf = (steps: readonly DocumentStep[]): EditDocument => ({
  format: "pliant-edit", version: 1, steps, seed: 1,
});
const documents = new WeakMap<Doc, EditDocument>();

/** What the living edit is to carry out; undefined: the shape is at rest. The same document gives the same object. */
export function liveDocument(doc: Doc): EditDocument | undefined {
  const known = documents.get(doc);
  if (known) return known;
  const present = liveStep(doc);
  if (!present && doc.done.length === 0) return undefined;
  const document = documentOf(present ? [...doc.done, present] : doc.done);
  documents.set(doc, document);
  return document;
}

function liveStep(doc: Doc): DocumentStep | undefined {
  if (doc.sketch) return isPosed(doc.sketch) ? sketchStep(doc.sketch, doc.shape) : chosenStep(doc.sketch);
  const { entries, cut = patience } = doc.grab;
  return doc.handles.length > 0 || hasLoad(doc.method, doc.grab.options)
    ? grabStep(doc, open(entries), cut)
    : undefined;
}

/** A document that ends as the present stands: see `finishedStep`. */
export const finishedDocument = (doc: Doc, step: DocumentStep): EditDocument => documentOf([...doc.done, step]);

/** The document as an edit script (docs/edit-script.md). */
export function editScript(doc: Doc): EditDocument {
  const grab = asksForSomething(doc) || doc.done.length === 0 ? grabStep(doc, doc.grab.entries, patience) : undefined;
  const present = doc.sketch ? finishedStep(doc) : grab;
  return documentOf(present ? [...doc.done, present] : doc.done);
}

export const hasMoved = (doc: Doc): boolean =>
  doc.grab.entries.length > 0 || doc.handles.some((h) => h.held !== undefined || !isAtRest(h.motion));
