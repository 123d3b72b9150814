// Options as methods declare them: type, reader, default, range and words of each in one place.

import {
  choice as readChoice, flag as readFlag, integer as readInteger, type Place, points as readPoints, toSpace,
  vector as readVector,
} from "../boundary/check.js";
import { numbersOf, rowsOf } from "../boundary/lists.js";
import type { RawValues } from "../boundary/raw.js";
import type { Extent } from "../shape/selection.js";
import type { Shape } from "../shape/shape.js";

/** What `pliant.methods` says of an option, for menus, sliders and documentation. */
export interface OptionInfo {
  /**
   * "number", "integer", "boolean", "choice", "vector" and "points" as they say; others are compound: "field", "cuts".
   */
  type: string;
  /** A word or two. */
  title: string;
  /** A sentence. */
  help: string;
  /** What is used where the option is left out; null: nothing. */
  default: unknown;
  /** A range that makes sense on a slider; what else is possible is accepted beyond it. null: not a number. */
  min: number | null;
  max: number | null;
  choices: readonly string[] | null;
  /** Whether it may change while a deformer lives. */
  live: boolean;
  /** The grain of a slider, and whether it goes by the logarithm. */
  step?: number;
  log?: true;
  /** What it cannot exceed: "vertices" of the shape, or the value of another option. */
  limit?: string;
  /** What a page may begin with, where that is not the default. */
  start?: unknown;
  /** For those who look for it; most pages leave it out. */
  advanced?: true;
}

/** Reads one option; `extent` is of the shape it is for. */
export type OptionReader<T = unknown> = (place: Place, value: unknown, extent: Extent) => T;

export interface Option<Given = unknown> {
  readonly info: Omit<OptionInfo, "live">;
  readonly read: OptionReader;
  /** Options that this one stands for: they are not given together. */
  readonly instead: readonly string[];
  /**
   * The hatch of compound options: what has been read as values of the WASM side, where that is more than one of the
   * same name.
   */
  readonly pack?: (name: string, value: never, place: Place, shape: Shape) => RawValues;
  /** Back, as callers write it; undefined: it is not in use. */
  readonly unpack: (name: string, values: RawValues, dimension: number) => unknown;
  /** What callers may write; there is no such field. */
  readonly given?: Given;
}

interface Words {
  title: string;
  help: string;
  default?: unknown;
  advanced?: true;
  start?: unknown;
  instead?: readonly string[];
}

interface Range {
  min: number;
  max: number;
  step: number;
  log?: true;
  limit?: string;
}

type Behaviour = Pick<Option, "read" | "unpack"> & {
  pack?: (name: string, value: never, place: Place, shape: Shape) => RawValues;
};

/** An option of any type, also of one that is not below. */
export function option<Given>(
  type: string,
  { instead = [], ...words }: Words & Partial<Range> & { choices?: readonly string[] },
  behaviour: Behaviour,
): Option<Given> {
  const info = { type, default: null, min: null, max: null, choices: null, ...words };
  return { info, instead, ...behaviour };
}

/** The only number there is. */
const first = (name: string, values: RawValues) => numbersOf(values[name])[0];

export function number(read: OptionReader<number>, words: Words & Range): Option<number> {
  return option("number", words, { read, unpack: first });
}

/** A number, or null for none. */
export function numberOrNull(read: OptionReader<number>, words: Words & Range): Option<number | null> {
  return option("number", words, {
    read: (place, value, extent) => (value === null ? null : read(place, value, extent)), unpack: first,
  });
}

export function integer(
  from: number, to: number | "vertices", unit: string | undefined, words: Words & Range,
): Option<number> {
  const read: OptionReader = (place, value, { count }) =>
    readInteger(place, value, from, to === "vertices" ? count : to, unit);
  return option("integer", to === "vertices" ? { ...words, limit: to } : words, { read, unpack: first });
}

export function flag(words: Words): Option<boolean> {
  return option("boolean", words, { read: readFlag, unpack: (name, values) => first(name, values) !== 0 });
}

export function choice<const Names extends readonly string[]>(choices: Names, words: Words): Option<Names[number]> {
  return option(
    "choice",
    { ...words, choices },
    { read: (place, value) => readChoice(place, value, choices), unpack: (name, values) => values[name] },
  );
}

/** As many numbers as the shape has dimensions; `min` and `max`: of its length. */
export function vector(words: Words & Range): Option<ArrayLike<number>> {
  return option("vector", words, {
    read: (place, value, { dimension }) => toSpace(readVector(place, value, dimension), dimension),
    unpack: (name, values, dimension) => numbersOf(values[name]).slice(0, dimension),
  });
}

export function points(words: Words): Option<readonly ArrayLike<number>[] | Float32Array | Float64Array> {
  return option("points", words, {
    read: (place, value, { dimension }) => toSpace(readPoints(place, value, dimension), dimension),
    unpack: (name, values, dimension) => (values[name] === undefined ? undefined : rowsOf(values[name], dimension)),
  });
}
