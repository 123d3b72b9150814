// What lies within loops, and how far from them: sides are sought in squares.

import type { Loop } from "./outline.js";
import { distanceToSegment } from "./simplify.js";

export class Region {
  /** Sides that pass a row of squares, and those that pass a square: four numbers each. */
  readonly #rows = new Map<number, number[]>();
  readonly #squares = new Map<string, number[]>();

  constructor(
    loops: readonly Loop[],
    readonly size: number,
  ) {
    for (const loop of loops) {
      for (let i = 0, before = loop.length - 2; i < loop.length; before = i, i += 2) {
        this.#add(loop[before], loop[before + 1], loop[i], loop[i + 1]);
      }
    }
  }

  #add(ax: number, ay: number, bx: number, by: number): void {
    const cell = (x: number) => Math.floor(x / this.size);
    for (let y = cell(Math.min(ay, by)); y <= cell(Math.max(ay, by)); ++y) {
      listIn(this.#rows, y).push(ax, ay, bx, by);
      for (let x = cell(Math.min(ax, bx)); x <= cell(Math.max(ax, bx)); ++x)
        listIn(this.#squares, `${x} ${y}`).push(ax, ay, bx, by);
    }
  }

  /** Whether an odd number of sides is to the right. */
  contains(x: number, y: number): boolean {
    const sides = this.#rows.get(Math.floor(y / this.size)) ?? [];
    let inside = false;
    for (let i = 0; i < sides.length; i += 4) {
      const [ax, ay, bx, by] = [sides[i], sides[i + 1], sides[i + 2], sides[i + 3]];
      if (ay > y !== by > y && x < ax + ((bx - ax) * (y - ay)) / (by - ay)) inside = !inside;
    }
    return inside;
  }

  /** Whether all sides are at least so far away, at most `size`. */
  clear(x: number, y: number, distance: number): boolean {
    const [column, row] = [Math.floor(x / this.size), Math.floor(y / this.size)];
    for (let dy = -1; dy <= 1; ++dy) {
      for (let dx = -1; dx <= 1; ++dx) {
        const sides = this.#squares.get(`${column + dx} ${row + dy}`) ?? [];
        for (let i = 0; i < sides.length; i += 4) {
          if (distanceToSegment(x, y, sides[i], sides[i + 1], sides[i + 2], sides[i + 3]) < distance) return false;
        }
      }
    }
    return true;
  }
}

function listIn<Key>(lists: Map<Key, number[]>, key: Key): number[] {
  const known = lists.get(key);
  if (known) return known;
  const fresh: number[] = [];
  lists.set(key, fresh);
  return fresh;
}
