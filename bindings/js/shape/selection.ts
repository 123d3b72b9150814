// SELECTION of the edit script: which vertices, by their positions at rest.

import {
  type Fields, fields, filled, finite, direction, integer, notNegative, type Place, vector, vertexIds,
} from "../boundary/check.js";

/** Vertices of a shape, by id or by where they are at rest (bounds included). */
export type Selection =
  | { vertices: Iterable<number> }
  | { box: { min: ArrayLike<number>; max: ArrayLike<number> } }
  | { sphere: { center: ArrayLike<number>; radius: number } }
  /** The vertices x with normal . x >= offset. */
  | { halfSpace: { normal: ArrayLike<number>; offset: number } }
  | { all: true }
  | { any: readonly Selection[] }
  | { every: readonly Selection[] }
  | { not: Selection };

/**
 * What a selection is checked against: vertices of the shape (a step that refines may add more), and numbers a vertex.
 */
export interface Extent {
  count: number;
  dimension: number;
}

/** A checked selection: 1 for each selected vertex of these rest positions. */
export interface Select {
  (rest: Float64Array): Uint8Array;
  /** It says where, and not which vertices: any points can be put to it. */
  readonly spatial: boolean;
}

function selecting(spatial: boolean, select: (rest: Float64Array) => Uint8Array): Select {
  return Object.assign(select, { spatial });
}

type Reader = (place: Place, value: unknown, extent: Extent, depth: number) => Select;

const maxDepth = 32;

const readers: Record<string, Reader> = {
  vertices(place, value, { count, dimension }) {
    const ids = vertexIds(place, value, count);
    if (ids.length === 0) place.reject("is empty; expected vertex ids");
    return selecting(false, (rest) => {
      const mask = new Uint8Array(rest.length / dimension);
      ids.forEach((id, i) =>
        id < mask.length ? (mask[id] = 1) : integer(place.item(i), id, 0, mask.length - 1, "a vertex id"),
      );
      return mask;
    });
  },
  box(place, value, { dimension }) {
    const box = fields(place, value, ["min", "max"]);
    const min = vector(place.at("min"), box.min, dimension);
    const max = vector(place.at("max"), box.max, dimension);
    min.forEach(
      (low, i) => low <= max[i] || place.reject(`has min[${i}] ${low} above max[${i}] ${max[i]}; expected min <= max`),
    );
    return where(dimension, (p, at) => min.every((low, i) => p[at + i] >= low && p[at + i] <= max[i]));
  },
  sphere(place, value, { dimension }) {
    const sphere = fields(place, value, ["center", "radius"]);
    const center = vector(place.at("center"), sphere.center, dimension);
    const radius = notNegative(place.at("radius"), sphere.radius);
    return where(dimension, (p, at) => Math.hypot(...center.map((c, i) => p[at + i] - c)) <= radius);
  },
  halfSpace(place, value, { dimension }) {
    const half = fields(place, value, ["normal", "offset"]);
    const normal = direction(place.at("normal"), half.normal, dimension);
    const offset = finite(place.at("offset"), half.offset);
    return where(dimension, (p, at) => normal.reduce((sum, n, i) => sum + n * p[at + i], 0) >= offset);
  },
  all(place, value, { dimension }) {
    if (value !== true) place.fail(value, "true");
    return selecting(true, (rest) => new Uint8Array(rest.length / dimension).fill(1));
  },
  any: combined((a, b) => a | b),
  every: combined((a, b) => a & b),
  not(place, value, extent, depth) {
    const select = read(place, value, extent, depth);
    return selecting(select.spatial, (rest) => select(rest).map((selected) => 1 - selected));
  },
};

function where(dimension: number, test: (positions: Float64Array, at: number) => boolean): Select {
  return selecting(true, (rest) =>
    Uint8Array.from({ length: rest.length / dimension }, (_, i) => Number(test(rest, i * dimension))));
}

function combined(join: (a: number, b: number) => number): Reader {
  return (place, value, extent, depth) => {
    const parts = Array.from(filled(place, value, "selections"), (part, i) => read(place.item(i), part, extent, depth));
    const spatial = parts.every((part) => part.spatial);
    return selecting(spatial, (rest) =>
      parts.map((select) => select(rest)).reduce((a, b) => a.map((x, i) => join(x, b[i]))));
  };
}

function read(place: Place, value: unknown, extent: Extent, depth: number): Select {
  if (depth > maxDepth) place.reject(`is nested too deeply; expected at most ${maxDepth} levels`);
  const kinds = Object.keys(readers);
  const selection: Fields = fields(place, value, kinds, "selection");
  const given = Object.keys(selection);
  if (given.length !== 1) place.reject(`has ${given.length} keys; expected one of ${kinds.join(", ")}`);
  return readers[given[0]](place.at(given[0]), selection[given[0]], extent, depth + 1);
}

export function readSelection(place: Place, value: unknown, extent: Extent): Select {
  return read(place, value, extent, 0);
}

/** The selected ids, ascending. An empty selection is an error. */
export function selectedIds(place: Place, select: Select, rest: Float64Array): Int32Array {
  const mask = select(rest);
  const ids: number[] = [];
  for (let id = 0; id < mask.length; ++id) if (mask[id] === 1) ids.push(id);
  return ids.length > 0 ? Int32Array.from(ids) : place.reject("selects no vertex; expected at least one");
}
