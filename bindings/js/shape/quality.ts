// Quality measures of a deformation, one meaning everywhere (the command's `compare`, reports).

import { coordinates, fields, flag, Place, toSpace } from "../boundary/check.js";
import type { Core } from "../boundary/core.js";
import { insideOf, type Shape, shapeFor } from "./shape.js";

export interface Quality {
  /** |l' / l - 1| over the edges. */
  stretch: { mean: number; p95: number; max: number };
  /** Mean change of the corner angles, in degrees. */
  shear: number;
  /** Ratio of the signed volumes; null for open shapes. */
  volume: number | null;
  /** Ratio of the areas; null without triangles. */
  area: number | null;
  /** Edges whose two normals newly have a dot product below -0.5. */
  folds: number;
  /** Pairs of triangles that newly intersect; null where they were not looked for. */
  intersections: number | null;
  /** Root mean square of the normal Laplacian over the diagonal: deformed, and at rest. */
  roughness: number;
  roughnessRest: number;
}

export interface MeasureOptions {
  /** False leaves out the one measure that takes long on large meshes. */
  intersections?: boolean;
}

export function measure(core: Core, shape: Shape, positions: ArrayLike<number>, options: MeasureOptions = {}): Quality {
  shapeFor(core, shape);
  const place = new Place("invalid-option", "positions");
  const given = fields(new Place("invalid-option", "options"), options, ["intersections"]);
  const all =
    given.intersections === undefined ||
    flag(new Place("invalid-option", "options.intersections"), given.intersections);
  const deformed = coordinates(place, positions, shape.dimension);
  const length = shape.report.vertices * shape.dimension;
  if (deformed.length !== length) place.fail(positions, `${length} numbers, ${shape.dimension} a vertex of the shape`);
  const raw = core.stageOnce(toSpace(deformed, shape.dimension), [], (scratch) =>
    insideOf(shape).owned.call((rawShape) => core.raw.measureQuality(rawShape, scratch, all)));
  const orNull = (value: number) => (Number.isNaN(value) ? null : value);
  return {
    stretch: { mean: raw.stretchMean, p95: raw.stretchP95, max: raw.stretchMax },
    shear: raw.shear,
    volume: orNull(raw.volume),
    area: orNull(raw.area),
    folds: raw.folds,
    intersections: all ? raw.intersections : null,
    roughness: raw.roughness,
    roughnessRest: raw.roughnessRest,
  };
}
