// Values by name, and numbers and lists of numbers among them, as the WASM side takes and gives them.

import type { RawNames, RawValue, RawValues } from "./raw.js";

export function numbersOf(value: RawValue | undefined): number[] {
  return Array.from((value ?? []) as ArrayLike<number>);
}

/** Points in space as rows of `dimension` numbers. */
export function rowsOf(value: RawValue | undefined, dimension: number): number[][] {
  const numbers = numbersOf(value);
  return Array.from({ length: numbers.length / 3 }, (_, i) => numbers.slice(3 * i, 3 * i + dimension));
}

/** Lists in a row as the WASM side takes them: `name`, and how many numbers each has. */
export function packLists(name: string, lists: readonly ArrayLike<number>[]): RawValues {
  return { [name]: concatenated(lists), [`${name}/sizes`]: lists.map(({ length }) => length) };
}

export function unpackLists(name: string, values: RawValues): number[][] {
  const all = numbersOf(values[name]);
  let end = 0;
  return numbersOf(values[`${name}/sizes`]).map((size) => all.slice(end, (end += size)));
}

export function packValues(values: RawValues): { names: RawNames; numbers: Float64Array } {
  const words: string[] = [];
  const lists: ArrayLike<number>[] = [];
  for (const [name, value] of Object.entries(values)) {
    if (typeof value === "string") {
      words.push(`${name}=${value}\n`);
      continue;
    }
    const list = value === null ? [] : typeof value === "object" ? value : [Number(value)];
    words.push(`${name} ${list.length}\n`);
    lists.push(list);
  }
  return { names: words.join(""), numbers: concatenated(lists) };
}

export function unpackValues(names: RawNames, numbersOf: (length: number) => Float64Array): RawValues {
  const lines = names.split("\n").slice(0, -1).map((line) => /^([^= ]*)([= ])(.*)$/.exec(line)!.slice(1));
  const sizes = lines.map(([, kind, rest]) => (kind === "=" ? 0 : Number(rest)));
  const all = numbersOf(sizes.reduce((sum, size) => sum + size, 0));
  let end = 0;
  return Object.fromEntries(
    lines.map(([name, kind, rest], i) => [name, kind === "=" ? rest : all.slice(end, (end += sizes[i]))]),
  );
}

function concatenated(lists: readonly ArrayLike<number>[]): Float64Array {
  const all = new Float64Array(lists.reduce((sum, { length }) => sum + length, 0));
  let end = 0;
  for (const list of lists) {
    all.set(list, end);
    end += list.length;
  }
  return all;
}
