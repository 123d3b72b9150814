// Vertices that are alike, found by hashing rows of numbers: a shape's size of them in a few milliseconds.

/**
 * Which rows of `width` numbers are the same, bit for bit: a group a row, numbered in the order of their first rows.
 */
export function equalRows(values: Float64Array, width: number): { group: Uint32Array; count: number } {
  const rows = values.length / width;
  const group = new Uint32Array(rows);
  const firsts: number[] = [];
  const table = new HashTable(rows);
  const bits = new Uint32Array(values.buffer, values.byteOffset, 2 * values.length);
  const same = (a: number, b: number) => {
    for (let i = 0; i < 2 * width; ++i) if (bits[2 * a * width + i] !== bits[2 * b * width + i]) return false;
    return true;
  };
  for (let row = 0; row < rows; ++row) {
    let hash = 0;
    for (let i = 2 * width * row; i < 2 * width * (row + 1); ++i) hash = mixed(hash, bits[i]);
    let slot = table.slot(hash);
    while (table.entries[slot] >= 0 && !same(table.entries[slot], row)) slot = table.next(slot);
    if (table.entries[slot] < 0) {
      table.entries[slot] = row;
      group[row] = firsts.push(row) - 1;
    } else group[row] = group[table.entries[slot]];
  }
  return { group, count: firsts.length };
}

/** Open addressing: entries of -1 are free, and at least half of them stay so. */
class HashTable {
  readonly entries: Int32Array;
  readonly #mask: number;

  constructor(most: number) {
    this.#mask = (2 << Math.ceil(Math.log2(Math.max(2, most)))) - 1;
    this.entries = new Int32Array(this.#mask + 1).fill(-1);
  }

  slot(hash: number): number {
    return (hash ^ (hash >>> 15)) & this.#mask;
  }

  next(slot: number): number {
    return (slot + 1) & this.#mask;
  }
}

/** A hash with another integer in it. */
export function mixed(hash: number, integer: number): number {
  return Math.imul(hash ^ integer, 0x9e3779b1) ^ (hash >>> 13);
}
