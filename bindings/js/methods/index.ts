// The methods there are, and names that are kept for others.

import { type Place } from "../boundary/check.js";
import { arap, type ArapOptions } from "./arap.js";
import { edgeMaterial, type EdgeMaterialOptions, type MaterialField } from "./edge_material.js";
import { embeddedGraph, type EmbeddedGraphOptions } from "./embedded_graph.js";
import type { Method } from "./method.js";

export type { ArapOptions, EdgeMaterialOptions, EmbeddedGraphOptions, MaterialField };
export { type Method, type Options, readLive, readOptions } from "./method.js";
export { readSeed } from "./embedded_graph.js";

/** The options of every method. */
export interface MethodOptions {
  "embedded-graph": EmbeddedGraphOptions;
  "edge-material": EdgeMaterialOptions;
  arap: ArapOptions;
}

export type MethodName = keyof MethodOptions;

/** What `pliant.deformer` takes beside the shape. */
export type DeformerOptions<M extends MethodName = MethodName> = MethodOptions[M];

/** Options that may change while a deformer lives; `embedded-graph` has none. */
export interface LiveOptions {
  "embedded-graph": Record<string, never>;
  "edge-material": Omit<EdgeMaterialOptions, "method">;
  arap: Omit<ArapOptions, "method">;
}

const methods: readonly Method[] = [embeddedGraph, edgeMaterial, arap];

/** Names of methods that are agreed on but not here. */
const absent = ["volumetric-graph", "rigid-cells"];

export function readMethod(place: Place, name: unknown): Method {
  const method = methods.find((candidate) => candidate.name === name);
  if (method) return method;
  const expected = methods.map((candidate) => `"${candidate.name}"`).join(", ");
  if (name === "sketch") place.reject(`is "sketch", a way to edit and not a solver; expected ${expected}, or a call of pliant.sketch`);
  if (absent.includes(name as string)) place.reject(`is "${name}", which is not in this build yet; expected ${expected}`);
  return place.fail(name, expected);
}
