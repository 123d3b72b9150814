// Points and normals that come along with a deformation, as callers hand them over.

import { coordinates, type FloatArray, output, Place } from "../boundary/check.js";
import { PliantError } from "../boundary/errors.js";

/** Numbers of a point and where results go: single precision in, single out. */
export interface Carried {
  given: FloatArray;
  result: FloatArray;
}

/** Errors: invalid-option. */
export function readPoints(points: unknown, out: unknown, dimension: number, name = "points"): Carried {
  const checked = coordinates(new Place("invalid-option", name), points, dimension);
  const given = checked instanceof Float32Array ? checked : Float64Array.from(checked);
  const fresh = () => new (given.constructor as Float64ArrayConstructor)(given.length);
  return { given, result: output(new Place("invalid-option", "out"), out, given.length, fresh) };
}

/** Normals, one a point. Errors: invalid-option; not-solvable in the plane. */
export function readNormals(
  points: unknown, normals: unknown, out: unknown, dimension: number,
): Carried & { at: FloatArray } {
  if (dimension !== 3) {
    throw new PliantError("not-solvable", "a shape in the plane has no normals to turn; expected a shape in space");
  }
  const { given: at } = readPoints(points, undefined, 3);
  const place = new Place("invalid-option", "normals");
  const carried = readPoints(normals, out, 3, place.path);
  if (carried.given.length === at.length) return { ...carried, at };
  return place.fail(normals, `${at.length} numbers, three a point`);
}
