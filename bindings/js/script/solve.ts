// How long a step of a script solves.

import { fields, integer, type Place, positive } from "../check.js";

export interface SolvePlan {
  iterations: number;
  tolerance: number;
}

export const maxCount = 2 ** 31 - 1;

export function readSolve(place: Place, value: unknown): SolvePlan {
  const { iterations = 100, tolerance = 1e-6 } = fields(place, value ?? {}, ["iterations", "tolerance"]);
  return {
    iterations: integer(place.at("iterations"), iterations, 1, maxCount),
    tolerance: positive(place.at("tolerance"), tolerance),
  };
}
