// embedded-graph: Sumner, Schmid, Pauly, Embedded Deformation for Shape Manipulation (2007).

import { filled, integer as readInteger, type Place, positive } from "../boundary/check.js";
import { packLists, unpackLists } from "../boundary/lists.js";
import { type Extent, readSelection, type Select, selectedIds, type Selection } from "../shape/selection.js";
import { insideOf } from "../shape/shape.js";
import { method } from "./method.js";
import { choice, flag, integer, number, option, points } from "./option.js";

export function readSeed(place: Place, value: unknown): number {
  return readInteger(place, value, 0, Number.MAX_SAFE_INTEGER);
}

function readCuts(place: Place, value: unknown, extent: Extent): Select[][] {
  return Array.from(filled(place, value, "pairs of selections"), (pair, i) => {
    const sides = filled(place.item(i), pair, "a pair of selections");
    if (sides.length !== 2) place.item(i).fail(pair, "a pair of selections");
    return Array.from(sides, (side, j) => readSelection(place.item(i).item(j), side, extent));
  });
}

const weight = { min: 0.1, max: 10, step: 0.1 } as const;

export const embeddedGraph = method({
  name: "embedded-graph",
  title: "Embedded graph",
  short: "Graph",
  paper: "Sumner, Schmid, Pauly: Embedded Deformation for Shape Manipulation (2007)",
  help: "A coarse graph of rotating nodes carries the shape.",
  carries: true,
  curves: false,
  draws: ["graph"],
  live: false,
  loads: [],
  options: {
    nodes: points({
      title: "Nodes by hand", advanced: true, instead: ["nodeCount", "sampling"],
      help: "Where the nodes are, instead of how many.",
    }),
    nodeCount: integer(1, "vertices", "a number of nodes", {
      title: "Nodes", default: 250, min: 20, max: 800, step: 10,
      help: "How many nodes carry the shape, or as many as it has points: more follow finer bends.",
    }),
    sampling: choice(["surface", "simplify"], {
      title: "Sampling", default: "surface", advanced: true,
      help: "Nodes spread evenly over the surface, or what simplification of the mesh leaves.",
    }),
    neighbours: integer(1, 2 ** 31 - 1, "a number of nodes", {
      title: "Blend", default: 4, min: 2, max: 10, step: 1, limit: "nodeCount",
      help: "How many nodes carry each point: more blend more softly.",
    }),
    regularizationWeight: number(positive, {
      title: "Smoothness", default: 10, min: 1, max: 50, step: 1, help: "How much neighbouring nodes agree.",
    }),
    rotationWeight: number(positive, {
      title: "Rigidity", default: 1, ...weight, help: "How much each node keeps to a rotation.",
    }),
    constraintWeight: number(positive, {
      title: "Handles", default: 100, min: 1, max: 1000, step: 1, advanced: true,
      help: "How much handles keep to their targets, where they are not exact.",
    }),
    solver: choice(["auto", "gauss-newton"], {
      title: "Solver", default: "auto", advanced: true,
      help: "gauss-newton is the paper's, the reference; auto reaches the same energy sooner.",
    }),
    exactHandles: flag({
      title: "Exact handles", default: false,
      help: "Handles reach their targets exactly where the graph can, not only nearly.",
    }),
    cuts: option<readonly (readonly [Selection, Selection])[]>("cuts", {
      title: "Cuts", advanced: true, help: "Pairs of regions that must not influence each other: a hand beside a leg.",
    }, {
      read: readCuts,
      pack: (name, cuts: Select[][], place, shape) => packLists(name, cuts.flatMap((cut, i) =>
        cut.map((side, j) => selectedIds(place.item(i).item(j), side, insideOf(shape).rest)))),
      unpack(name, values) {
        const sides = unpackLists(name, values).map((vertices) => ({ vertices }));
        return sides.length === 0 ? undefined : sides.flatMap((side, i) => (i % 2 === 0 ? [[side, sides[i + 1]]] : []));
      },
    }),
    refine: flag({
      title: "Refine", default: false, advanced: true,
      help: "Adds up to half as many nodes where the energy is high, once solve has converged.",
    }),
    seed: option<number>("integer", {
      title: "Seed", default: 1, min: 0, max: 1000, step: 1, advanced: true, help: "Of the random layout of nodes.",
    }, { read: readSeed, unpack: (name, values) => (values[name] as ArrayLike<number>)[0] }),
  },

  check(place, options) {
    type Counts = { nodes?: ArrayLike<number>; nodeCount?: number; neighbours?: number };
    const { nodes, nodeCount, neighbours } = options as Counts;
    const count = nodes ? nodes.length / 3 : nodeCount;
    if (neighbours !== undefined && count !== undefined && neighbours > count) {
      place.at("neighbours").fail(neighbours, `at most the ${count} nodes of the graph`);
    }
  },
});
