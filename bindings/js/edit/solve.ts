// What a step of a script, and the finish of a sketch, solve with and how long.

import { fields, integer, type Place, positive } from "../boundary/check.js";
import { type DeformerOptions, type Method, readOptions } from "../methods/index.js";
import type { Extent } from "../shape/selection.js";
import type { SolvePlan } from "./plan.js";

export const maxCount = 2 ** 31 - 1;

/**
 * The options of a method, checked, for a deformer that reads them again; `seed`: of the script, where they have none.
 */
export function readDeformer(
  place: Place, value: unknown, method: Method, extent: Extent, seed: number | undefined,
): DeformerOptions {
  const options = value ?? {};
  readOptions(place, options, method, extent);
  const seeded = seed !== undefined && "seed" in method.options ? { seed } : {};
  return { ...seeded, ...options, method: method.name } as DeformerOptions;
}

export function readSolve(place: Place, value: unknown): SolvePlan {
  const { iterations = 100, tolerance = 1e-6 } = fields(place, value ?? {}, ["iterations", "tolerance"]);
  return {
    iterations: integer(place.at("iterations"), iterations, 1, maxCount),
    tolerance: positive(place.at("tolerance"), tolerance),
  };
}
