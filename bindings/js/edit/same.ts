// What differs between two values of plain data, and what they may share.

import { isList, type List } from "../boundary/check.js";

type Fields = Readonly<Record<string, unknown>>;

/**
 * Whether two values are equal; fields left out are undefined, and numbers count, not the kind of array they are in.
 */
export function same(a: unknown, b: unknown): boolean {
  if (a === b) return true;
  if (typeof a !== "object" || typeof b !== "object" || a === null || b === null) return false;
  if (isList(a) || isList(b)) return isList(a) && isList(b) && sameList(a, b);
  if (a instanceof Set || b instanceof Set) return a instanceof Set && b instanceof Set && sameList([...a], [...b]);
  if (Symbol.iterator in a || Symbol.iterator in b) return false; // read once, gone
  const keys = new Set([...Object.keys(a), ...Object.keys(b)]);
  return [...keys].every((key) => same((a as Fields)[key], (b as Fields)[key]));
}

function sameList(a: List, b: List): boolean {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; ++i) if (!same(a[i], b[i])) return false;
  return true;
}

/**
 * `next`, fresh, with every part that equals the same part of `before` replaced by it: a history keeps what stays once.
 */
export function shared<T>(before: unknown, next: T): T {
  if (before === (next as unknown)) return next;
  if (typeof before !== "object" || typeof next !== "object" || before === null || next === null) return next;
  if (ArrayBuffer.isView(next)) return same(before, next) ? (before as T) : next;
  if (Array.isArray(before) !== Array.isArray(next)) return next;
  const [old, parts] = [before as Fields, next as Record<string, unknown>];
  const keys = Object.keys(parts);
  let equal = keys.length === Object.keys(old).length;
  for (const key of keys) {
    if (typeof parts[key] === "object") parts[key] = shared(old[key], parts[key]);
    equal &&= parts[key] === old[key];
  }
  return equal ? (before as T) : next;
}
