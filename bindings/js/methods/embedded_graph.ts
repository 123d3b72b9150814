// embedded-graph: Sumner, Schmid, Pauly, Embedded Deformation for Shape Manipulation (2007).

import { choice, filled, flag, integer, type Place, points, positive, toSpace } from "../boundary/check.js";
import { type Extent, readSelection, type Select, selectedIds, type Selection } from "../shape/selection.js";
import { insideOf } from "../shape/shape.js";
import type { Method } from "./method.js";

/** Options of `embedded-graph`. */
export interface EmbeddedGraphOptions {
  method: "embedded-graph";
  /** Nodes of the graph: 250, or as many as the shape has points. */
  nodeCount?: number;
  /** Nodes placed by hand, instead of `nodeCount` and `sampling`. */
  nodes?: readonly ArrayLike<number>[] | Float32Array | Float64Array;
  /** Nodes spread evenly over the surface, or what simplification of the mesh leaves. */
  sampling?: "surface" | "simplify";
  /** Nodes that influence a vertex: 4. */
  neighbours?: number;
  rotationWeight?: number;
  regularizationWeight?: number;
  constraintWeight?: number;
  /** "gauss-newton" is the paper's solver, the reference; "auto" reaches the same energy sooner. */
  solver?: "auto" | "gauss-newton";
  /** Meets targets exactly where the graph can. */
  exactHandles?: boolean;
  /** Pairs of regions that must not influence each other: a hand beside a leg. */
  cuts?: readonly (readonly [Selection, Selection])[];
  /** Adds up to half as many nodes where the energy is high, once `solve` has converged. */
  refine?: boolean;
  /** Of the random layout of nodes: 1. */
  seed?: number;
}

/** After reading: what is left out is undefined. */
interface Read extends Pick<EmbeddedGraphOptions, "nodeCount" | "sampling" | "neighbours" | "rotationWeight"
  | "regularizationWeight" | "constraintWeight" | "solver" | "exactHandles" | "refine" | "seed"> {
  nodes?: ArrayLike<number>;
  cuts?: Select[][];
}

export function readSeed(place: Place, value: unknown): number {
  return integer(place, value, 0, Number.MAX_SAFE_INTEGER);
}

function readCuts(place: Place, value: unknown, extent: Extent): Select[][] {
  return Array.from(filled(place, value, "pairs of selections"), (pair, i) => {
    const sides = filled(place.item(i), pair, "a pair of selections");
    if (sides.length !== 2) place.item(i).fail(pair, "a pair of selections");
    return Array.from(sides, (side, j) => readSelection(place.item(i).item(j), side, extent));
  });
}

/** |a|, a..., |b|, b... for each cut. */
function packCuts(place: Place, cuts: Select[][], rest: Float64Array): number[] {
  return cuts.flatMap((cut, i) => cut.flatMap((side, j) => {
    const ids = selectedIds(place.item(i).item(j), side, rest);
    return [ids.length, ...ids];
  }));
}

export const embeddedGraph: Method = {
  name: "embedded-graph",
  options: {
    nodeCount: (place, value, { count }) => integer(place, value, 1, count, "a number of nodes"),
    nodes: (place, value, { dimension }) => toSpace(points(place, value, dimension), dimension),
    sampling: (place, value) => choice(place, value, ["surface", "simplify"]),
    neighbours: (place, value) => integer(place, value, 1, 2 ** 31 - 1, "a number of nodes"),
    rotationWeight: positive,
    regularizationWeight: positive,
    constraintWeight: positive,
    solver: (place, value) => choice(place, value, ["auto", "gauss-newton"]),
    exactHandles: flag,
    cuts: readCuts,
    refine: flag,
    seed: readSeed,
  },
  live: [],
  carries: true,

  check(place, options) {
    const { nodes, nodeCount, sampling, neighbours } = options as Read;
    if (nodes && nodeCount !== undefined) place.reject("has nodes and nodeCount; expected one or the other");
    if (nodes && sampling !== undefined) place.reject("has nodes and sampling; expected one or the other");
    const count = nodes ? nodes.length / 3 : nodeCount;
    if (neighbours !== undefined && count !== undefined && neighbours > count) {
      place.at("neighbours").fail(neighbours, `at most the ${count} nodes of the graph`);
    }
  },

  build(core, raw, shape, options, place) {
    const read = options as Read;
    const cuts = packCuts(place.at("cuts"), read.cuts ?? [], insideOf(shape).rest);
    const values = {
      nodeCount: read.nodeCount ?? 0,
      sampling: read.nodes ? "nodes" : (read.sampling ?? "surface"),
      neighbours: read.neighbours ?? 0,
      rotationWeight: read.rotationWeight ?? 1,
      regularizationWeight: read.regularizationWeight ?? 10,
      constraintWeight: read.constraintWeight ?? 100,
      solver: read.solver ?? "auto",
      exactHandles: read.exactHandles ?? false,
      seed: read.seed ?? 1,
    };
    return insideOf(shape).owned.call((rawShape) =>
      raw.buildEmbeddedGraph(rawShape, values, core.stage(read.nodes ?? [], cuts)));
  },

  refine(raw, shape, options) {
    const { refine, nodes, nodeCount } = options as Read;
    if (!refine) return undefined;
    const { vertices, weldedVertices } = shape.report;
    const count = nodes ? nodes.length / 3 : (nodeCount ?? Math.min(250, vertices - weldedVertices));
    return raw.refine(Math.ceil(count / 2));
  },
};
