// arap: Sorkine, Alexa, As-Rigid-As-Possible Surface Modeling (2007).

import { choice, fraction, orNull, positive } from "../boundary/check.js";
import { insideOf } from "../shape/shape.js";
import type { Method, Options } from "./method.js";

/** Options of `arap`. All but the method may change at any time, by `setOptions`. */
export interface ArapOptions {
  method: "arap";
  /** What a rotation has to fit: the edges of its vertex, or all edges of the triangles around. "spokes". */
  energy?: "spokes" | "spokes-and-rims";
  /** Makes handles soft: the weight of the squared distances from their targets. null, and the default: they are exact. */
  constraintWeight?: number | null;
  /** Length, as a part of the square root of the area, below which bending is kept away: 0. From 0.05 a single vertex raises no spike. */
  smoothness?: number;
}

function values(options: Options): [rims: boolean, constraintWeight: number, smoothness: number] {
  const { energy, constraintWeight, smoothness } = options as Omit<ArapOptions, "method">;
  return [energy === "spokes-and-rims", constraintWeight ?? 0, smoothness ?? 0];
}

const options = {
  energy: (place, value) => choice(place, value, ["spokes", "spokes-and-rims"]),
  constraintWeight: orNull(positive),
  smoothness: fraction,
} satisfies Method["options"];

export const arap: Method = {
  name: "arap",
  options,
  live: Object.keys(options),
  carries: false,
  check() {},
  build: (_, raw, shape, given) => insideOf(shape).owned.call((rawShape) => raw.buildArap(rawShape, ...values(given))),
  update: (_, raw, __, given) => raw.setArap(...values(given)),
};
