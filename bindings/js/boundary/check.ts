// Checks of values that come from outside. Each reads one value, returns it in the form the rest of
// the package works with, or throws a PliantError that names the place, the value and what was expected.

import { PliantError, type ErrorCode } from "./errors.js";

/** Where a value stands ("steps[0].handles[1].move"), and the code of an error about it. */
export class Place {
  constructor(readonly code: ErrorCode, readonly path: string) {}

  at(key: string): Place {
    return new Place(this.code, this.path === "" ? key : `${this.path}.${key}`);
  }

  item(index: number): Place {
    return new Place(this.code, `${this.path}[${index}]`);
  }

  fail(value: unknown, expected: string): never {
    return this.reject(`is ${show(value)}; expected ${expected}`);
  }

  reject(reason: string): never {
    throw new PliantError(this.code, `${this.path} ${reason}`);
  }
}

/** A value in a message: short, on one line. */
function show(value: unknown): string {
  if (typeof value === "string") return JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}...` : value);
  if (typeof value === "bigint") return `${value}n`;
  if (typeof value === "function") return "a function";
  if (typeof value !== "object" || value === null) return String(value);
  if (isList(value)) {
    if (isGone(value)) return `a ${value.constructor.name} whose memory is gone`;
    const kind = Array.isArray(value) ? "an array" : `a ${value.constructor.name}`;
    return `${kind} of length ${value.length}`;
  }
  return "an object";
}

export type List<T = unknown> = ArrayLike<T> & Iterable<T> & object;

/** An array or a typed array. */
export function isList(value: unknown): value is List {
  return Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
}

/** A typed array whose memory was transferred elsewhere or cut short: it has no length, and iterating it throws. */
function isGone(value: List): boolean {
  if (Array.isArray(value)) return false;
  try {
    (value as Uint8Array).values();
    return false;
  } catch {
    return true;
  }
}

export type Fields = Readonly<Record<string, unknown>>;

/** An object with no keys but these; `what` says in the message whose keys they are. */
export function fields(place: Place, value: unknown, known: readonly string[], what = "key"): Fields {
  if (typeof value !== "object" || value === null || isList(value)) place.fail(value, "an object");
  for (const key of Object.keys(value)) {
    if (!known.includes(key)) place.at(key).reject(`is not a known ${what}; expected ${known.join(", ") || "none"}`);
  }
  return value as Fields;
}

export function list(place: Place, value: unknown, expected = "an array"): List {
  return isList(value) && !isGone(value) ? value : place.fail(value, expected);
}

/** A list with something in it. */
export function filled(place: Place, value: unknown, expected: string): List {
  const items = list(place, value, expected);
  return items.length > 0 ? items : place.reject(`is empty; expected ${expected}`);
}

/** Beyond this squares and their sums lose all meaning; shapes have the same bound. */
export const largest = 1e30;

function isFinite(value: unknown): value is number {
  return typeof value === "number" && Math.abs(value) <= largest;
}

export function finite(place: Place, value: unknown, expected = "a finite number"): number {
  if (isFinite(value)) return value;
  return place.fail(value, Number.isFinite(value) ? `${expected} of at most ${largest}` : expected);
}

export function positive(place: Place, value: unknown): number {
  return finite(place, value, "a number above 0") > 0 ? (value as number) : place.fail(value, "a number above 0");
}

export function notNegative(place: Place, value: unknown): number {
  return finite(place, value, "a number, 0 or above") >= 0
    ? (value as number)
    : place.fail(value, "a number, 0 or above");
}

/** A part of a whole. */
export function fraction(place: Place, value: unknown): number {
  return finite(place, value, "a number from 0 to 1") >= 0 && (value as number) <= 1
    ? (value as number)
    : place.fail(value, "a number from 0 to 1");
}

/** A reader that takes null as well. */
export function orNull<T, More extends unknown[]>(reader: (place: Place, value: unknown, ...more: More) => T) {
  return (place: Place, value: unknown, ...more: More): T | null =>
    value === null ? null : reader(place, value, ...more);
}

export function integer(place: Place, value: unknown, min: number, max: number, unit = "an integer"): number {
  const fits = typeof value === "number" && Number.isInteger(value) && value >= min && value <= max;
  return fits ? value : place.fail(value, `${unit} from ${min} to ${max}`);
}

export function flag(place: Place, value: unknown): boolean {
  return typeof value === "boolean" ? value : place.fail(value, "true or false");
}

export function choice<T extends string>(place: Place, value: unknown, names: readonly T[]): T {
  return names.includes(value as T) ? (value as T) : place.fail(value, names.map((name) => `"${name}"`).join(" or "));
}

/** A point or direction: `size` finite numbers. */
export function vector(place: Place, value: unknown, size: number): number[] {
  const expected = `${size} finite numbers`;
  const items = list(place, value, expected);
  if (items.length !== size) place.fail(value, expected);
  return Array.from(items, (x, i) => finite(place.item(i), x));
}

/** A vector that points somewhere. */
export function direction(place: Place, value: unknown, size: number): number[] {
  const v = vector(place, value, size);
  return v.some((x) => x !== 0) ? v : place.reject("is the zero vector; expected a direction");
}

/** Numbers in a row, `size` a point; the values are checked and passed through as they are. */
export function coordinates(place: Place, value: unknown, size: number): ArrayLike<number> {
  const expected = `an array of numbers, ${size} a point`;
  const numbers = filled(place, value, expected) as ArrayLike<number>;
  if (numbers.length % size !== 0) place.fail(numbers, `${expected}: a length divisible by ${size}`);
  for (let i = 0; i < numbers.length; ++i) {
    if (!isFinite(numbers[i])) finite(place.item(i), numbers[i]);
  }
  return numbers;
}

/** Points as [[x, y, z], ...], or flat; `size` numbers a point. */
export function points(place: Place, value: unknown, size: number): ArrayLike<number> {
  const items = filled(place, value, `points of ${size} numbers`);
  if (ArrayBuffer.isView(value)) return coordinates(place, value, size);
  const flat = new Float64Array(size * items.length);
  for (let i = 0; i < items.length; ++i) flat.set(vector(place.item(i), items[i], size), size * i);
  return flat;
}

/** Distinct vertex ids below `count`, in the order given. Reads no further than the first that is wrong. */
export function vertexIds(place: Place, value: unknown, count: number): Int32Array {
  const iterable = typeof value === "object" && value !== null && Symbol.iterator in value;
  if (!iterable || (isList(value) && isGone(value))) place.fail(value, "vertex ids");
  const seen = new Uint8Array(count);
  const ids: number[] = [];
  for (const id of value as Iterable<unknown>) {
    const here = place.item(ids.length);
    integer(here, id, 0, count - 1, "a vertex id");
    if (seen[id as number]++) here.reject(`is ${id}, which is listed before; expected each vertex once`);
    ids.push(id as number);
  }
  return Int32Array.from(ids);
}

/** Three dimensions as they are; the plane's points with z = 0. */
export function toSpace(values: ArrayLike<number>, dimension: number): ArrayLike<number> {
  if (dimension === 3) return values;
  const space = new Float64Array((values.length / 2) * 3);
  for (let i = 0, j = 0; i < values.length; i += 2, j += 3) {
    space[j] = values[i];
    space[j + 1] = values[i + 1];
  }
  return space;
}

export type FloatArray = Float32Array | Float64Array;

/** Where results go: the caller's array, which must fit, or a new one. */
export function output<T extends FloatArray>(place: Place, out: unknown, length: number, fresh: () => T): FloatArray {
  if (out === undefined) return fresh();
  const fits = (out instanceof Float32Array || out instanceof Float64Array) && out.length === length;
  return fits ? out : place.fail(out, `a Float32Array or Float64Array of length ${length}`);
}
