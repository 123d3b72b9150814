// States: between the named tables of the WASM side and the nested object of docs/state-and-report.md.
//
// Names of tables say what they are a part of, whatever the method: "influences/weights" is the field `weights` of the
// object `influences`; "edges[]/i" the field `i` of each object in the list `edges`; "handles[]/vertices[]" a list in
// each of `handles`, and "handles[]" how long those lists are. One number, one column and several columns become a
// number, a flat array and an array of rows.

import { type Fields, fields, finite, integer, list, type Place, vector } from "./check.js";
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

export interface Table {
  name: string;
  columns: number;
  integral: boolean;
  data: ArrayLike<number>;
}

type Nested = Record<string, unknown>;

/**
 * The hatch of a method whose state holds more than numbers: turns what the tables say into what callers see, and back.
 * Neither changes what it is given.
 */
export interface StateHatch {
  show(state: State): State;
  read(place: Place, state: Fields): Fields;
}

/** A field of the objects in a list. */
interface Column {
  field: string;
  /** "list": the field is a list in each object; "lengths": no field, but how long those are. */
  kind: "value" | "list" | "lengths";
  table: Table;
}

export function readTables(raw: RawState): Table[] {
  return Array.from({ length: raw.size() }, (_, i) => ({
    name: raw.name(i), columns: raw.columns(i), integral: raw.integral(i), data: raw.data(i).slice(),
  }));
}

/** The lists of objects among the tables, by name. */
function recordsOf(tables: readonly Table[]): Map<string, Column[]> {
  const records = new Map<string, Column[]>();
  for (const table of tables) {
    const [, name, field = "", list] = /^(\w+)\[\](?:\/(\w+)(\[\])?)?$/.exec(table.name) ?? [];
    if (name === undefined) continue;
    const kind = list ? "list" : field === "" ? "lengths" : "value";
    records.set(name, [...(records.get(name) ?? []), { field, kind, table }]);
  }
  return records;
}

// -- To what callers see. ---------------------------------------------------------------------------

export function toState(tables: readonly Table[], hatch?: StateHatch): State {
  const state: Nested = {};
  for (const table of tables) {
    if (table.name.includes("[]")) continue;
    const path = table.name.split("/");
    const last = path.pop()!;
    const parent = path.reduce((at, key) => (at[key] ??= {}) as Nested, state);
    parent[last] = toValue(table);
  }
  for (const [name, columns] of recordsOf(tables)) state[name] = toObjects(columns);
  return hatch ? hatch.show(state as State) : (state as State);
}

function toValue({ columns, data }: Table): unknown {
  if (columns === 0) return data[0];
  const flat = Array.from(data);
  if (columns === 1) return flat;
  return Array.from({ length: flat.length / columns }, (_, row) => flat.slice(row * columns, (row + 1) * columns));
}

function toObjects(columns: readonly Column[]): Nested[] {
  const lengths = columns.find(({ kind }) => kind === "lengths")?.table.data ?? [];
  const fields = columns.filter(({ kind }) => kind !== "lengths");
  const values = fields.map(({ kind, table }) => {
    const rows = toValue(table) as unknown[];
    return kind === "list" ? pieces(rows, lengths) : rows;
  });
  return values[0].map((_, i) => Object.fromEntries(fields.map(({ field }, f) => [field, values[f][i]])));
}

function pieces<T>(values: readonly T[], lengths: ArrayLike<number>): T[][] {
  let end = 0;
  return Array.from(lengths, (length) => values.slice(end, (end += length)));
}

// -- And back. --------------------------------------------------------------------------------------

/**
 * Fills `raw` from a state with fields that `like` has too, tables of the same deformation; it may have fewer, and
 * `others`, which are left out.
 */
export function writeTables(
  core: Core, raw: RawState, place: Place, state: unknown, like: readonly Table[], others: readonly string[],
  hatch?: StateHatch,
): void {
  const tops = [...new Set([...like.map((table) => /^\w+/.exec(table.name)![0]), ...others])];
  const checked = fields(place, state, tops, "field of this state");
  const given = hatch ? hatch.read(place, checked) : checked;
  const write = ({ name, columns, integral }: Table, numbers: readonly number[]) =>
    raw.add(name, columns, integral, core.stage(numbers));
  for (const table of like) {
    if (table.name.includes("[]")) continue;
    const value = table.name.split("/").reduce<unknown>((at, key) => (at as Nested | undefined)?.[key], given);
    if (value !== undefined) write(table, readTable(place.at(table.name.replaceAll("/", ".")), value, table));
  }
  for (const [name, columns] of recordsOf(like)) {
    if (given[name] === undefined) continue;
    const numbers = readObjects(place.at(name), given[name], columns);
    columns.forEach(({ table }, i) => write(table, numbers[i]));
  }
}

/** The numbers of each column. */
function readObjects(place: Place, value: unknown, columns: readonly Column[]): number[][] {
  const names = columns.flatMap(({ field, kind }) => (kind === "lengths" ? [] : [field]));
  const objects = Array.from(list(place, value), (item, i) => fields(place.item(i), item, names));
  const lists = columns.filter(({ kind }) => kind === "list").map(({ field }) => field);
  const lengths = objects.map((object, i) => commonLength(place.item(i), object, lists));
  return columns.map(({ field, kind, table }) => {
    if (kind === "lengths") return lengths;
    const read = kind === "list" ? readTable : readRow;
    return objects.flatMap((object, i) => read(place.item(i).at(field), object[field], table));
  });
}

/** How long the lists of an object are, which go together. */
function commonLength(place: Place, object: Fields, lists: readonly string[]): number {
  const [first, ...others] = lists.map((field) => [field, list(place.at(field), object[field]).length] as const);
  for (const [field, length] of others) {
    if (length !== first[1]) place.reject(`has ${first[1]} ${first[0]} and ${length} ${field}; expected as many`);
  }
  return first?.[1] ?? 0;
}

function readTable(place: Place, value: unknown, table: Table): number[] {
  if (table.columns === 0) return readRow(place, value, table);
  return Array.from(list(place, value)).flatMap((row, i) => readRow(place.item(i), row, table));
}

function readRow(place: Place, value: unknown, { columns, integral }: Table): number[] {
  const number = (item: unknown) => (integral ? integer(place, item, -1, 2 ** 31 - 1) : finite(place, item));
  return columns <= 1 ? [number(value)] : vector(place, value, columns).map(number);
}
