// What lies around places on a shape, and what nothing joins to the rest of it.

import { coordinates, fields, integer, list, notNegative, Place, toSpace, vector } from "../boundary/check.js";
import { type Owned, put } from "../boundary/core.js";
import type { RawShape } from "../boundary/raw.js";

/** A place on a shape: a vertex, and the centre of a ball near it. */
export interface Spot {
  vertex: number;
  /** Left out: where the vertex is. */
  center?: ArrayLike<number>;
}

/** A small part of a surface that nothing joins to the rest, as an eye in a head. */
export interface LoosePart {
  /** Ascending. */
  vertices: Uint32Array;
  /** Vertices of the large parts, ascending: the nearest to it at rest, and two rings around them. */
  beside: Uint32Array;
}

/** See `Shape.patch`. `rest`: `dimension` numbers a vertex. */
export function patchOf(
  owned: Owned<RawShape>, rest: Float64Array, dimension: number, spots: readonly Spot[], radius: number,
  positions?: ArrayLike<number>,
): Uint32Array {
  const count = rest.length / dimension;
  const option = (name: string) => new Place("invalid-option", name);
  const moved = positions === undefined ? undefined : coordinates(option("positions"), positions, dimension);
  if (moved && moved.length !== rest.length) {
    option("positions").fail(positions, `${rest.length} numbers, ${dimension} a vertex of the shape`);
  }
  const places = Array.from(list(option("spots"), spots, "an array of spots"), (spot, i) =>
    readSpot(option("spots").item(i), spot, dimension, moved ?? rest));
  notNegative(option("radius"), radius);
  const centers = toSpace(places.flatMap(({ center }) => center), dimension);
  return owned.core.using(() => new owned.core.raw.Scratch(), (scratch) => {
    put(scratch.integers(places.length), places.map(({ vertex }) => vertex));
    const numbers = scratch.doubles(centers.length + (moved ? 3 * count : 0));
    put(numbers, centers);
    if (moved) put(numbers.subarray(centers.length), toSpace(moved, dimension));
    return Uint32Array.from(owned.call((raw) => raw.patch(scratch, radius)));
  });
}

function readSpot(place: Place, value: unknown, dimension: number, positions: ArrayLike<number>) {
  const spot = fields(place, value, ["vertex", "center"]);
  const vertex = integer(place.at("vertex"), spot.vertex, 0, positions.length / dimension - 1, "a vertex id");
  const own = () => Array.from({ length: dimension }, (_, axis) => positions[dimension * vertex + axis]);
  return { vertex, center: spot.center === undefined ? own() : vector(place.at("center"), spot.center, dimension) };
}

/** See `Shape.looseParts`. */
export function loosePartsOf(owned: Owned<RawShape>): LoosePart[] {
  return owned.call((raw) => Array.from({ length: raw.findLooseParts() }, (_, part) => ({
    vertices: Uint32Array.from(raw.loosePart(part)), beside: Uint32Array.from(raw.besideLoosePart(part)),
  })));
}
