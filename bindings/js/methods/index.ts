// The methods there are, and names that are kept for others.

import type { Place } from "../boundary/check.js";
import { arap } from "./arap.js";
import { edgeMaterial } from "./edge_material.js";
import { embeddedGraph } from "./embedded_graph.js";
import type { Drawn, LiveOf, Method, MethodInfo, OptionsOf } from "./method.js";
import { rigidCells } from "./rigid_cells.js";

export type { MaterialField } from "./edge_material.js";
export { readSeed } from "./embedded_graph.js";
export { type Drawn, type Method, type MethodInfo, type Options, readLive, readOptions } from "./method.js";
export type { OptionInfo } from "./option.js";

const declared = [embeddedGraph, edgeMaterial, arap, rigidCells] as const;

type Declared = (typeof declared)[number]["declared"];
type Named<M> = Extract<Declared, { name: M }>;

export type MethodName = Declared["name"];

/** The options of every method. */
export type MethodOptions = { [N in MethodName]: { method: N } & OptionsOf<Named<N>> };

/** What `pliant.deformer` takes beside the shape. */
export type DeformerOptions<M extends MethodName = MethodName> = MethodOptions[M];

/** Options that may change while a deformer lives. */
export type LiveOptions = { [N in MethodName]: LiveOf<Named<N>> };

const methods: readonly Method[] = declared;

/** What menus, sliders and documentation are made from. */
export const methodInfos: readonly (MethodInfo & { name: MethodName })[] = Object.freeze(
  declared.map(({ info }) => info as MethodInfo & { name: MethodName }),
);

/** Methods that can do something, as an error says it. */
export function methodsThat(can: (method: MethodInfo) => boolean): string {
  return methodInfos.filter(can).map(({ name }) => name).join(" or ");
}

export const drawing = (what: Drawn) => ({ draws }: MethodInfo): boolean => draws.includes(what);

/** Names of methods that are agreed on but not here. */
const absent = ["volumetric-graph"];

export function readMethod(place: Place, name: unknown): Method {
  const method = methods.find((candidate) => candidate.name === name);
  if (method) return method;
  const expected = methods.map((candidate) => `"${candidate.name}"`).join(", ");
  if (name === "sketch") {
    place.reject(`is "sketch", a way to edit and not a solver; expected ${expected}, or a call of pliant.sketch`);
  }
  if (absent.includes(name as string)) {
    place.reject(`is "${name}", which is not in this build yet; expected ${expected}`);
  }
  return place.fail(name, expected);
}
