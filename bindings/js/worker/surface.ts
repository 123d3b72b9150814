// What a page may call in its worker, and how each call travels: the one table that both sides go by.
//
// A class of the package gets a row here, a line in `classes` of host.ts, and a class in objects.ts, whose types are
// made from its own. A call that is listed is there on the page, answers by a promise, and keeps its name, arguments,
// result and documentation.

import type { Deformer } from "../deform/deformer.js";
import type { Handle } from "../deform/handle.js";
import type { Sketch } from "../deform/sketch.js";
import type { Edit } from "../edit/living.js";
import type { Files } from "../io/files.js";
import type { Picture } from "../picture/picture.js";
import type { Pliant } from "../pliant.js";
import type { Shape } from "../shape/shape.js";

/** The classes of the package whose objects live in a worker. */
export interface Classes {
  Pliant: Pliant;
  Shape: Shape;
  Picture: Picture;
  Deformer: Deformer;
  Handle: Handle;
  Sketch: Sketch;
  Edit: Edit;
  Files: Files;
}

export type ClassName = keyof Classes;

/** How a call travels, where there is more to it than plain data both ways. */
export interface Travel {
  /** It answers with an object of this class, which stays in the worker. */
  readonly gives?: ClassName;
  /** Which argument is options with callbacks and signals, which stay on the page. */
  readonly options?: number;
  /** Which argument, the last, is the caller's own array for the results, which stays on the page. */
  readonly into?: number;
  /** The first argument is any iterable of vertex ids, called so in errors; what travels is a list. */
  readonly ids?: string;
  /**
   * Which argument is an immutable value, given again and again: what travels is how it differs from the one before.
   */
  readonly changes?: number;
  /** The object is gone after it, and may be gone before. */
  readonly ends?: true;
}

export interface Row {
  /** Properties that never change: they travel once, with the object. */
  readonly constants: readonly string[];
  readonly calls: Readonly<Record<string, Travel>>;
}

type Rows = {
  readonly [Name in ClassName]: {
    readonly constants: readonly (keyof Classes[Name])[];
    readonly calls: { readonly [Call in keyof Classes[Name]]?: Travel };
  };
};

const plain = {};
const into = { into: 0 } as const;
const ends = { ends: true } as const;

/** What deformers and sketches have in common. */
const deformation = {
  positions: into, normals: into, transformPoints: { into: 1 }, transformNormals: { into: 2 },
  state: plain, restore: plain, reset: plain, dispose: ends,
} as const;

export const surface = {
  Pliant: {
    constants: ["methods"],
    calls: {
      shape: { gives: "Shape" }, picture: { gives: "Picture" }, deformer: { gives: "Deformer" },
      sketch: { gives: "Sketch" }, open: { gives: "Edit" },
      limbStroke: plain, measure: plain, rigidMotion: plain, edit: { options: 2 },
    },
  },
  Shape: {
    constants: ["report", "dimension", "diagonal"],
    calls: { select: plain, patch: plain, looseParts: plain, volume: plain, dispose: ends },
  },
  Picture: {
    constants: ["report", "dimension", "diagonal", "positions", "triangles", "texcoords", "image"],
    calls: { select: plain, patch: plain, looseParts: plain, volume: plain, dispose: ends },
  },
  Deformer: {
    constants: ["method"],
    calls: {
      setFixed: { ids: "fixed" }, addHandle: { ids: "vertices", gives: "Handle" }, setOptions: plain,
      step: plain, solve: { options: 0 }, energy: plain, counters: plain, field: plain, ...deformation,
    },
  },
  Handle: {
    constants: ["vertices"],
    calls: { move: plain, moveTo: plain, remove: ends },
  },
  Sketch: {
    constants: [],
    calls: {
      redraw: plain, held: plain, bend: plain, unbend: plain, twist: plain, scale: plain, turning: plain,
      twistSpeed: plain, setSmooth: plain, morph: plain, pose: plain, setPose: plain, refine: plain, unrefine: plain,
      labels: plain, parameters: into, reference: plain, target: plain, restPositions: into, seed: plain,
      ...deformation,
    },
  },
  Edit: {
    constants: [],
    calls: {
      apply: { changes: 0 }, run: plain, settle: { options: 0 }, reset: plain, moment: plain,
      positions: into, normals: into, transformPoints: { into: 1 }, transformNormals: { into: 2 },
      state: plain, sketch: plain, refinement: plain, report: plain, dispose: ends,
    },
  },
  Files: {
    constants: [],
    calls: { read: { options: 2 }, write: plain },
  },
} as const satisfies Rows;

/** Calls and constants of a class. */
export type Calls<Name extends ClassName> = (typeof surface)[Name]["calls"];
export type Constants<Name extends ClassName> = (typeof surface)[Name]["constants"][number];

export function rowOf(name: ClassName): Row {
  return surface[name];
}
