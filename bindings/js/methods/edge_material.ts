// edge-material: material-aware edges, which keep their lengths and the angles between their triangles.

import {
  choice, direction, fields, filled, fraction, isList, notNegative, type Place, points, toSpace, vertexIds,
} from "../boundary/check.js";
import { packLists, rowsOf, unpackLists } from "../boundary/lists.js";
import type { RawValues } from "../boundary/raw.js";
import { type Extent, readSelection, type Select, selectedIds, type Selection } from "../shape/selection.js";
import { insideOf, type Shape } from "../shape/shape.js";
import { method } from "./method.js";
import { number, option, vector } from "./option.js";

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
  axis: (place, value, { dimension }) => ({
    kind: "axis", axis: toSpace(direction(place, value, dimension), dimension),
  }),
  curvature: (place, value) => ({ kind: choice(place, value, ["max", "min"]) }),
  geodesic: (place, value, extent) => ({ kind: "geodesic", sources: readSources(place, value, extent) }),
};

function readField(place: Place, value: unknown, extent: Extent): FieldRead {
  const kinds = Object.keys(fieldReaders);
  const field = fields(place, value, kinds, "field");
  const [kind, ...more] = Object.keys(field);
  if (kind === undefined || more.length > 0) {
    place.reject(`has ${Object.keys(field).length} keys; expected one of ${kinds.join(", ")}`);
  }
  return fieldReaders[kind](place.at(kind), field[kind], extent);
}

/** `field`, and what it is made from under names of their own. */
function packField(name: string, field: FieldRead | null, place: Place, shape: Shape): RawValues {
  if (field?.kind === "strokes") return { [name]: field.kind, ...packLists(`${name}/strokes`, field.strokes) };
  if (field?.kind === "axis") return { [name]: field.kind, [`${name}/axis`]: field.axis };
  if (field?.kind !== "geodesic") return { [name]: field?.kind ?? "none" };
  const { sources } = field;
  const ids =
    sources instanceof Int32Array ? sources : selectedIds(place.at(field.kind), sources, insideOf(shape).rest);
  return { [name]: field.kind, [`${name}/sources`]: ids };
}

function unpackField(name: string, values: RawValues, dimension: number): MaterialField | undefined {
  const kind = values[name] as string;
  const of = (part: string) => values[`${name}/${part}`];
  if (kind === "strokes") {
    return { strokes: unpackLists(`${name}/strokes`, values).map((stroke) => rowsOf(stroke, dimension)) };
  }
  if (kind === "axis") return { axis: rowsOf(of("axis"), dimension)[0] };
  if (kind === "geodesic") return { geodesic: Array.from(of("sources") as ArrayLike<number>) };
  return kind === "max" || kind === "min" ? { curvature: kind } : undefined;
}

const stiffness = { min: 0.01, max: 1000, step: 0.1, log: true } as const;
const acting = { default: 1, min: 0, max: 1, step: 0.05 } as const;

export const edgeMaterial = method({
  name: "edge-material",
  title: "Material edges",
  short: "Material",
  paper: "Material Aware Mesh Deformation",
  help: "Edges that resist stretching and bending, each as stiff as you like: cloth, rubber, wood.",
  carries: false,
  curves: false,
  draws: ["field"],
  live: true,
  loads: ["gravity"],
  options: {
    stretch: number(notNegative, {
      title: "Stretch", default: 1, ...stiffness,
      help: "Stiffness against stretching, the same at every resolution: lambda = stretch (mean edge / diagonal)^2.",
    }),
    lambda: number(notNegative, {
      title: "Lambda", min: 1e-6, max: 10, step: 0.1, log: true, advanced: true, instead: ["stretch"],
      help: "The paper's own stiffness against stretching, instead of stretch.",
    }),
    bend: number(notNegative, {
      title: "Bend", default: 1, ...stiffness, max: 100, help: "Stiffness against bending, the paper's mu.",
    }),
    pStretch: number(fraction, {
      title: "Stretch now", ...acting, help: "The part of the stretch stiffness that acts; changing it costs nothing.",
    }),
    pBend: number(fraction, {
      title: "Bend now", ...acting, help: "The part of the bend stiffness that acts; changing it costs nothing.",
    }),
    gravity: vector({
      title: "Gravity", default: [0, 0, 0], min: 0, max: 3, step: 0.05,
      help: "Where everything falls that is not held: the force on a vertex is gravity lambda (diagonal) / (vertices).",
    }),
    field: option<MaterialField | null>("field", {
      title: "Grain",
      help:
        "The direction in which it is stiff, as in wood or woven cloth: painted strokes, an axis, " +
        "along the most or least curved, or along shortest paths.",
    }, {
      read: (place, value, extent) => (value === null ? null : readField(place, value, extent)),
      pack: packField,
      unpack: unpackField,
    }),
  },

  check(place, { stretch, lambda, bend }) {
    if (bend === 0 && (lambda ?? stretch) === 0) {
      place.reject(`has bend and ${lambda === 0 ? "lambda" : "stretch"} of 0; expected one of them above 0`);
    }
  },
});
