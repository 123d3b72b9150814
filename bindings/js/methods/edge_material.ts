// edge-material: material-aware edges, which keep their lengths and the angles between their triangles.

import { choice, direction, fields, filled, fraction, isList, notNegative, orNull, type Place, points, toSpace, vector, vertexIds } from "../boundary/check.js";
import type { Core } from "../boundary/core.js";
import type { RawScratch } from "../boundary/raw.js";
import { type Extent, readSelection, type Select, selectedIds, type Selection } from "../shape/selection.js";
import { insideOf, type Shape } from "../shape/shape.js";
import type { Method, OptionReader, Options } from "./method.js";

/** Options of `edge-material`. All but the method may change at any time, by `setOptions`. */
export interface EdgeMaterialOptions {
  method: "edge-material";
  /** Stiffness against stretch, the same at every resolution: lambda = stretch (mean edge / diagonal)^2. 1. */
  stretch?: number;
  /** The paper's own lambda, instead of `stretch`. */
  lambda?: number;
  /** Stiffness against bending, the paper's mu: 1. */
  bend?: number;
  /** The part of `stretch` that acts, 0 to 1: 1. Changing it costs nothing. */
  pStretch?: number;
  /** The part of `bend` that acts, 0 to 1: 1. Changing it costs nothing. */
  pBend?: number;
  /** Where things fall: the force on a vertex is gravity lambda (diagonal) / (vertices). Changing it costs nothing. */
  gravity?: ArrayLike<number>;
  /** A direction on the surface along which edges resist, while those across give way. null, and the default: none. */
  field?: MaterialField | null;
}

/** Directions whose sign has no meaning. */
export type MaterialField =
  /** Painted on the surface: lines of at least two points, interpolated between. */
  | { strokes: readonly (readonly ArrayLike<number>[] | Float32Array | Float64Array)[] }
  /** One direction, projected on the surface. */
  | { axis: ArrayLike<number> }
  /** Along the largest or the smallest curvature. */
  | { curvature: "max" | "min" }
  /** Along the shortest paths from these vertices. */
  | { geodesic: Selection | readonly number[] | Uint32Array };

/** After reading: what is left out is undefined; points are in space. */
interface Read extends Omit<EdgeMaterialOptions, "method" | "field"> {
  field?: FieldRead | null;
}

type FieldRead =
  | { kind: "strokes"; strokes: ArrayLike<number>[] }
  | { kind: "axis"; axis: ArrayLike<number> }
  | { kind: "max" | "min" }
  | { kind: "geodesic"; sources: Select | Int32Array };

function readStrokes(place: Place, value: unknown, { dimension }: Extent): ArrayLike<number>[] {
  return Array.from(filled(place, value, "strokes"), (stroke, i) => {
    const coordinates = toSpace(points(place.item(i), stroke, dimension), dimension);
    if (coordinates.length < 6) place.item(i).fail(stroke, "a stroke of at least 2 points");
    return coordinates;
  });
}

/** An empty list is refused as an empty selection is. */
function readSources(place: Place, value: unknown, extent: Extent): Select | Int32Array {
  if (!isList(value)) return readSelection(place, value, extent);
  return vertexIds(place, filled(place, value, "vertex ids"), extent.count);
}

const fieldReaders: Record<string, (place: Place, value: unknown, extent: Extent) => FieldRead> = {
  strokes: (place, value, extent) => ({ kind: "strokes", strokes: readStrokes(place, value, extent) }),
  axis: (place, value, { dimension }) => ({ kind: "axis", axis: toSpace(direction(place, value, dimension), dimension) }),
  curvature: (place, value) => ({ kind: choice(place, value, ["max", "min"]) }),
  geodesic: (place, value, extent) => ({ kind: "geodesic", sources: readSources(place, value, extent) }),
};

function readField(place: Place, value: unknown, extent: Extent): FieldRead {
  const kinds = Object.keys(fieldReaders);
  const field = fields(place, value, kinds, "field");
  const [kind, ...more] = Object.keys(field);
  if (kind === undefined || more.length > 0) place.reject(`has ${Object.keys(field).length} keys; expected one of ${kinds.join(", ")}`);
  return fieldReaders[kind](place.at(kind), field[kind], extent);
}

const options: Record<string, OptionReader> = {
  stretch: notNegative,
  lambda: notNegative,
  bend: notNegative,
  pStretch: fraction,
  pBend: fraction,
  gravity: (place, value, { dimension }) => toSpace(vector(place, value, dimension), dimension),
  field: orNull(readField),
};

/** The options as the WASM side takes them. */
function pack(core: Core, shape: Shape, given: Options, place: Place): [field: string, scratch: RawScratch] {
  const { stretch = 1, lambda = -1, bend = 1, pStretch = 1, pBend = 1, gravity = [0, 0, 0], field } = given as Read;
  const axis = field?.kind === "axis" ? field.axis : [0, 0, 0];
  const numbers = [stretch, lambda, bend, pStretch, pBend, ...Array.from(gravity), ...Array.from(axis)];
  if (field?.kind === "strokes") {
    const strokes = field.strokes.map((stroke) => Array.from(stroke));
    return [field.kind, core.stage(numbers.concat(...strokes), strokes.map((stroke) => stroke.length / 3))];
  }
  if (field?.kind !== "geodesic") return [field?.kind ?? "", core.stage(numbers)];
  const { sources } = field;
  const ids = sources instanceof Int32Array ? sources : selectedIds(place.at("field").at("geodesic"), sources, insideOf(shape).rest);
  return [field.kind, core.stage(numbers, ids)];
}

export const edgeMaterial: Method = {
  name: "edge-material",
  options,
  live: Object.keys(options),
  carries: false,

  check(place, given) {
    const { stretch, lambda, bend } = given as Read;
    if (stretch !== undefined && lambda !== undefined) place.reject("has stretch and lambda; expected one or the other");
    if (bend === 0 && (lambda ?? stretch) === 0) place.reject(`has bend and ${lambda === 0 ? "lambda" : "stretch"} of 0; expected one of them above 0`);
  },

  merge(before, given) {
    const { stretch, lambda, ...others } = before as Read;
    const other = "stretch" in given || "lambda" in given ? {} : { stretch, lambda };
    return { ...others, ...other, ...given };
  },

  load: (given) => Array.from((given as Read).gravity ?? []).some((g) => g !== 0),

  build(core, raw, shape, given, place) {
    const packed = pack(core, shape, given, place);
    return insideOf(shape).owned.call((rawShape) => raw.buildEdgeMaterial(rawShape, ...packed));
  },

  update: (core, raw, shape, given, place) => raw.setEdgeMaterial(...pack(core, shape, given, place)),
  field: (raw) => raw.field(),
};
