// The methods of the contract, and those this build has.

import { type Place } from "../check.js";
import { embeddedGraph, type EmbeddedGraphOptions } from "./embedded_graph.js";
import type { Method } from "./method.js";

export type { EmbeddedGraphOptions };
export { type Method, type Options, readOptions } from "./method.js";
export { readSeed } from "./embedded_graph.js";

/** What `pliant.deformer` takes beside the shape. */
export type DeformerOptions = EmbeddedGraphOptions;

const methods: readonly Method[] = [embeddedGraph];

/** Names of methods that are agreed on but not here. */
const absent = ["volumetric-graph", "rigid-cells", "edge-material", "arap"];

export function readMethod(place: Place, name: unknown): Method {
  const method = methods.find((candidate) => candidate.name === name);
  if (method) return method;
  const expected = methods.map((candidate) => `"${candidate.name}"`).join(", ");
  if (name === "sketch") place.reject(`is "sketch", a way to edit and not a solver; expected ${expected}, or a call of pliant.sketch`);
  if (absent.includes(name as string)) place.reject(`is "${name}", which is not in this build yet; expected ${expected}`);
  return place.fail(name, expected);
}
