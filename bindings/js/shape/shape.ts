// Shapes: the checked door for all input.

import { coordinates, fields, integer, list, Place } from "../boundary/check.js";
import { build, type Core, disposeSymbol, Owned } from "../boundary/core.js";
import { PliantError } from "../boundary/errors.js";
import type { RawShape, ShapeReport } from "../boundary/raw.js";
import { type LoosePart, loosePartsOf, patchOf, type Spot } from "./patch.js";
import { type Extent, readSelection, selectedIds, type Selection } from "./selection.js";

/** A mesh, a polygon soup, points, or a picture in the plane. */
export interface ShapeInput {
  /** `dimension` numbers a vertex. */
  positions: ArrayLike<number>;
  /** Three vertex ids a triangle; none: points. */
  triangles?: ArrayLike<number>;
  /** 3, or 2 for the plane. */
  dimension?: 2 | 3;
}

export type { ShapeReport };

/** What the rest of the package knows of a shape. */
export interface ShapeInside {
  readonly owned: Owned<RawShape>;
  /** The input's positions, `dimension` numbers a vertex. */
  readonly rest: Float64Array;
  readonly triangles: Uint32Array;
  /** Whether the input came in single precision: so do results then. */
  readonly single: boolean;
}

const maxVertices = 8_000_000;
const maxTriangles = 4 * maxVertices;

/** The inside of a shape; not for callers of the package. */
export let insideOf: (shape: Shape) => ShapeInside;

/** A shape for a call of the library on `core`. Errors: invalid-option, disposed. */
export function shapeFor(core: Core, value: unknown): Shape {
  if (!(value instanceof Shape)) return new Place("invalid-option", "shape").fail(value, "a Shape of this package");
  if (insideOf(value).owned.core === core) return value;
  throw new PliantError("disposed", "this shape belongs to a library that has stopped; expected one of this library");
}

/** What options and selections for a shape are checked against. */
export function extentOf({ report: { vertices }, dimension }: Shape): Extent {
  return { count: vertices, dimension };
}

/** A shape at rest. It does not change; deformers are built over it and live on without it. */
export class Shape {
  readonly report: Readonly<ShapeReport>;
  readonly dimension: 2 | 3;
  /** Diagonal of the bounding box. */
  readonly diagonal: number;
  readonly #inside: ShapeInside;

  static {
    insideOf = (shape) => shape.#inside;
  }

  /** @internal */
  constructor(core: Core, input: ShapeInput) {
    const { dimension, rest, triangles, single } = readInput(input);
    const raw = core.stageOnce(rest, triangles, (scratch) =>
      build(core, () => new core.raw.Shape(), (shape) => shape.build(scratch, dimension)));
    const owned = new Owned(core, raw, this, "shape");
    this.dimension = dimension;
    this.report = Object.freeze(owned.call((shape) => shape.report()));
    this.diagonal = owned.call((shape) => shape.diagonal());
    this.#inside = { owned, rest, triangles, single };
  }

  /** The selected vertices, ascending. Errors: invalid-option, also where nothing is selected. */
  select(selection: Selection): Uint32Array {
    const place = new Place("invalid-option", "selection");
    return Uint32Array.from(selectedIds(place, readSelection(place, selection, extentOf(this)), this.#inside.rest));
  }

  /**
   * The vertices of a patch, ascending: what a brush touches. Of each spot its vertex, and all that can be reached from
   * it along triangles without leaving the ball of `radius` around its center; vertices at one place go together, and
   * of points that nothing joins all within the ball. `positions`: where the vertices are now, `dimension` numbers
   * each; left out: at rest. Errors: invalid-option.
   */
  patch(spots: readonly Spot[], radius: number, positions?: ArrayLike<number>): Uint32Array {
    const { owned, rest } = this.#inside;
    return patchOf(owned, rest, this.dimension, spots, radius, positions);
  }

  /** Small parts of the surface that nothing joins to the rest, most vertices first; none where there are over 64. */
  looseParts(): LoosePart[] {
    return loosePartsOf(this.#inside.owned);
  }

  /** Signed volume of what the surface bounds, positive where its triangles look outwards; null: it bounds nothing. */
  volume(): number | null {
    const volume = this.#inside.owned.call((shape) => shape.volume());
    return Number.isNaN(volume) ? null : volume;
  }

  /** Frees its memory; deformers built over it stay. */
  dispose(): void {
    this.#inside.owned.dispose();
  }

  [disposeSymbol](): void {
    this.dispose();
  }
}

/** What `read` of pliant/io gives beside a shape: files pass as shapes. */
const ofFiles = ["faceVertices", "faceOffsets", "texcoords", "colors", "texture", "format", "source"];

function readInput(value: unknown) {
  const place = new Place("invalid-shape", "");
  const input = fields(new Place("invalid-shape", "shape"), value, ["positions", "triangles", "dimension", ...ofFiles]);
  const dimension = input.dimension === undefined ? 3 : readDimension(place.at("dimension"), input.dimension);
  const positions = readCount(
    place.at("positions"), coordinates(place.at("positions"), input.positions, dimension), dimension, maxVertices,
  );
  const triangles = readTriangles(place.at("triangles"), input.triangles ?? [], positions.length / dimension);
  return {
    dimension,
    rest: Float64Array.from(positions),
    triangles: Uint32Array.from(triangles),
    single: positions instanceof Float32Array,
  };
}

function readDimension(place: Place, value: unknown): 2 | 3 {
  return value === 2 || value === 3 ? value : place.fail(value, "2 or 3");
}

function readTriangles(place: Place, value: unknown, vertices: number): ArrayLike<number> {
  const expected = "an array of vertex ids, 3 a triangle";
  const ids = list(place, value, expected) as ArrayLike<number>;
  if (ids.length % 3 !== 0) place.fail(ids, `${expected}: a length divisible by 3`);
  readCount(place, ids, 3, maxTriangles);
  for (let i = 0; i < ids.length; ++i) {
    if (!(ids[i] >= 0 && ids[i] < vertices && Number.isInteger(ids[i]))) {
      integer(place.item(i), ids[i], 0, vertices - 1, "a vertex id");
    }
  }
  return ids;
}

function readCount(place: Place, values: ArrayLike<number>, size: number, max: number): ArrayLike<number> {
  if (values.length <= size * max) return values;
  throw new PliantError(
    "too-large", `${place.path} holds ${values.length / size} entries of ${size} numbers; expected at most ${max}`,
  );
}
