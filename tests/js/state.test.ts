// States of methods to come: what the names of tables say is all that the package knows of their records.

import { describe, expect, it } from "vitest";
import { Place } from "../../bindings/js/boundary/check.js";
import type { Core } from "../../bindings/js/boundary/core.js";
import type { RawState } from "../../bindings/js/boundary/raw.js";
import { type StateHatch, type Table, toState, writeTables } from "../../bindings/js/boundary/state.js";

const table = (name: string, columns: number, data: number[], integral = false): Table =>
  ({ name, columns, integral, data });

/** What would reach the WASM side from a state, as tables. */
function written(state: unknown, like: Table[], hatch?: StateHatch): Table[] {
  const tables: Table[] = [];
  const raw = {
    add: (name: string, columns: number, integral: boolean, data: unknown) =>
      tables.push({ name, columns, integral, data: data as number[] }),
  } as unknown as RawState;
  const core = { stage: (numbers: number[]) => numbers } as unknown as Core;
  writeTables(core, raw, new Place("invalid-option", "state"), state, like, [], hatch);
  return tables;
}

const byName = (tables: readonly Table[]) => [...tables].sort((a, b) => (a.name < b.name ? -1 : 1));

/** A graph through the inside of a shape, with curves of different lengths and rows of matrices. */
const graph = [
  table("points", 3, [0, 0, 0, 1, 0, 0, 1, 1, 0]),
  table("weights/alpha", 0, [0.2]),
  table("meshWeights[]/i", 1, [0, 2], true),
  table("meshWeights[]/w", 1, [0.5, 0.25]),
  table("curves[]", 1, [2, 0, 1], true),
  table("curves[]/path[]", 1, [4, 5, 6], true),
  table("curves[]/targets[]", 3, [0, 0, 1, 0, 0, 2, 0, 0, 3]),
  table("curves[]/closed", 1, [0, 1, 0], true),
];
const graphState = {
  points: [[0, 0, 0], [1, 0, 0], [1, 1, 0]],
  weights: { alpha: 0.2 },
  meshWeights: [{ i: 0, w: 0.5 }, { i: 2, w: 0.25 }],
  curves: [
    { path: [4, 5], targets: [[0, 0, 1], [0, 0, 2]], closed: 0 },
    { path: [], targets: [], closed: 1 },
    { path: [6], targets: [[0, 0, 3]], closed: 0 },
  ],
};

describe("tables of a state", () => {
  it("become the object that their names say, for records of any name", () => {
    expect(toState(graph)).toEqual(graphState);
  });

  it("come back as they were", () => {
    expect(byName(written(graphState, graph))).toEqual(byName(graph));
  });

  it("become empty lists where there are no objects", () => {
    const none = graph.map((one) => (one.name.includes("[]") ? { ...one, data: [] } : one));
    expect(toState(none)).toMatchObject({ meshWeights: [], curves: [] });
    expect(byName(written(toState(none), none))).toEqual(byName(none));
  });

  it("are left out where the state has none of them", () => {
    expect(written({ weights: {} }, graph)).toEqual([]);
  });

  it.each([
    ["a field that is none", { curves: [{ path: [], targets: [], closed: 0, open: 1 }] }, "state.curves[0].open"],
    ["lists that do not go together", { curves: [{ path: [1], targets: [], closed: 0 }] },
      "state.curves[0] has 1 path and 0 targets; expected as many"],
    ["a list that is none", { curves: [{ path: 3, targets: [], closed: 0 }] }, "state.curves[0].path is 3"],
    ["a point that is cut short", { curves: [{ path: [1], targets: [[0, 0]], closed: 0 }] },
      "state.curves[0].targets[0]"],
    ["half an id", { meshWeights: [{ i: 0.5, w: 1 }] }, "state.meshWeights[0].i is 0.5"],
    ["a field left out", { meshWeights: [{ i: 0 }] }, "state.meshWeights[0].w is undefined"],
    ["a record that is no list", { meshWeights: { i: 0, w: 1 } }, "state.meshWeights is an object"],
    ["a field of another state", { cells: [] }, "state.cells is not a known field of this state"],
  ])("are not made from %s", (_, state, message) => {
    expect(() => written(state, graph)).toThrow(message);
  });
});

/** Cells that are free, held whole, or held at a point. */
const cells = [
  table("cells[]/size", 1, [1, 2, 2]),
  table("cells[]/held", 1, [0, 1, 2], true),
  table("cells[]/point", 3, [0, 0, 0, 0, 0, 0, 1, 2, 3]),
];
const cellState = { cells: [{ size: 1, held: null }, { size: 2, held: "cell" }, { size: 2, held: [1, 2, 3] }] };
const hatch: StateHatch = {
  show: ({ cells, ...state }) => ({
    ...state,
    cells: (cells as { held: number; point: number[] }[]).map(({ point, held, ...cell }) =>
      ({ ...cell, held: [null, "cell", point][held] })),
  }),
  read: (_, { cells, ...state }) => ({
    ...state,
    cells: (cells as { held: unknown }[]).map(({ held, ...cell }) => ({
      ...cell, held: held === null ? 0 : held === "cell" ? 1 : 2, point: Array.isArray(held) ? held : [0, 0, 0],
    })),
  }),
};

describe("a method's own hatch", () => {
  it("shows what is more than numbers, and reads it again", () => {
    expect(toState(cells, hatch)).toEqual(cellState);
    expect(byName(written(cellState, cells, hatch))).toEqual(byName(cells));
  });

  it("sees no field that is not of the state", () => {
    expect(() => written({ ...cellState, pairs: [] }, cells, hatch)).toThrow("state.pairs is not a known field");
  });
});
