// States: between the named tables of the WASM side and the nested object of docs/state-and-report.md.
//
// A table "influences/weights" is the field `weights` of the object `influences`; one number, one
// column and several columns become a number, a flat array and an array of rows. The tables of a
// record ("edges/i", "edges/j", all of one length) become a list of objects. Handles differ in
// length: "handles/sizes", "handles/vertices" and "handles/targets" become a list of objects.

import { fields, finite, integer, list, type Place, vector } from "./check.js";
import type { Core } from "./core.js";
import type { RawState } from "./raw.js";

export interface HandleState {
  vertices: number[];
  targets: number[][];
}

/** What `deformer.state()` gives: plain data, in the input's coordinates; fields as in docs/state-and-report.md. */
export interface State {
  handles: HandleState[];
  [field: string]: unknown;
}

interface Table {
  name: string;
  columns: number;
  integral: boolean;
  data: ArrayLike<number>;
}

type Nested = Record<string, unknown>;

/** Fields that are lists of objects where they are split into tables. */
const records: readonly string[] = ["edges", "folded"];

export function readTables(raw: RawState): Table[] {
  return Array.from({ length: raw.size() }, (_, i) => ({
    name: raw.name(i), columns: raw.columns(i), integral: raw.integral(i), data: raw.data(i).slice(),
  }));
}

export function toState(tables: Table[]): State {
  const state: Nested = {};
  for (const table of tables) {
    const path = table.name.split("/");
    const last = path.pop()!;
    const parent = path.reduce((at, key) => (at[key] ??= {}) as Nested, state);
    parent[last] = toValue(table);
  }
  for (const name of records) if (isColumns(state[name])) state[name] = toRows(state[name]);
  if (state.handles) state.handles = splitHandles(state.handles as PackedHandles);
  return state as State;
}

type Columns = Record<string, unknown[]>;

function isColumns(value: unknown): value is Columns {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function toRows(columns: Columns): Nested[] {
  const names = Object.keys(columns);
  return columns[names[0]].map((_, row) => Object.fromEntries(names.map((name) => [name, columns[name][row]])));
}

/** Back from rows with fields of these names. */
function toColumns(place: Place, value: unknown, names: string[]): Columns {
  const rows = Array.from(list(place, value), (row, i) => fields(place.item(i), row, names));
  return Object.fromEntries(names.map((name) => [name, rows.map((row) => row[name])]));
}

function toValue({ columns, data }: Table): unknown {
  if (columns === 0) return data[0];
  const flat = Array.from(data);
  if (columns === 1) return flat;
  return Array.from({ length: flat.length / columns }, (_, row) => flat.slice(row * columns, (row + 1) * columns));
}

interface PackedHandles {
  sizes: number[];
  vertices: number[];
  targets: number[][];
}

function splitHandles({ sizes, vertices, targets }: PackedHandles): HandleState[] {
  let end = 0;
  return sizes.map((size) => {
    const from = end;
    end += size;
    return { vertices: vertices.slice(from, end), targets: targets.slice(from, end) };
  });
}

/** Handles back in one piece; their lists have equal lengths. */
function packHandles(place: Place, value: unknown): PackedHandles {
  const handles = Array.from(list(place, value), (item, i) => {
    const handle = fields(place.item(i), item, ["vertices", "targets"]);
    const vertices = Array.from(list(place.item(i).at("vertices"), handle.vertices));
    const targets = Array.from(list(place.item(i).at("targets"), handle.targets));
    if (vertices.length !== targets.length) {
      place.item(i).reject(`has ${vertices.length} vertices and ${targets.length} targets; expected as many`);
    }
    return { vertices, targets };
  });
  return {
    sizes: handles.map((handle) => handle.vertices.length),
    vertices: handles.flatMap((handle) => handle.vertices) as number[],
    targets: handles.flatMap((handle) => handle.targets) as number[][],
  };
}

/**
 * Fills `raw` from a state with fields that `like` has too, tables of the same deformation; it may have fewer, and
 * `others`, which are left out.
 */
export function writeTables(
  core: Core, raw: RawState, place: Place, state: unknown, like: Table[], others: readonly string[],
): void {
  const tops = [...new Set([...like.map((table) => table.name.split("/")[0]), ...others])];
  const given: Nested = { ...fields(place, state, tops, "field of this state") };
  for (const name of records) {
    const columns = like
      .filter((table) => table.name.startsWith(`${name}/`))
      .map((table) => table.name.slice(name.length + 1));
    if (columns.length > 0 && given[name] !== undefined) given[name] = toColumns(place.at(name), given[name], columns);
  }
  if (given.handles !== undefined) given.handles = packHandles(place.at("handles"), given.handles);
  for (const table of like) {
    const value = table.name.split("/").reduce<unknown>((at, key) => (at as Nested | undefined)?.[key], given);
    if (value === undefined) continue;
    const numbers = readTable(place.at(table.name.replaceAll("/", ".")), value, table);
    raw.add(table.name, table.columns, table.integral, core.stage(numbers));
  }
}

function readTable(place: Place, value: unknown, { columns, integral }: Table): number[] {
  const number = (at: Place, item: unknown) => (integral ? integer(at, item, -1, 2 ** 31 - 1) : finite(at, item));
  if (columns === 0) return [number(place, value)];
  const rows = Array.from(list(place, value));
  if (columns === 1) return rows.map((item, i) => number(place.item(i), item));
  return rows.flatMap((row, i) => vector(place.item(i), row, columns).map((item) => number(place.item(i), item)));
}
