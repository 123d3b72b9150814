// The outline of the visible part of a picture, traced at some pixels' distance around it.

import type { Image } from "./image.js";

/** A closed line: x and y of its points in pixels from the bottom left corner, y up; the shape is on its left. */
export type Loop = Float64Array;

/** Values at points a pixel apart, row by row. */
interface Field {
  width: number;
  height: number;
  values: Float32Array;
}

/**
 * Lines at `margin` from the centres of all pixels whose alpha is above `threshold`, around them and in their holes,
 * with
 * crossings between pixels. They touch neither themselves nor each other.
 */
export function traceOutline(image: Image, threshold: number, margin: number): Loop[] {
  const border = Math.ceil(margin) + 1;
  const field = distances(image, threshold, border);
  for (let i = 0; i < field.values.length; ++i) field.values[i] = margin - field.values[i];
  // Row 0 is the bottom; the first point is `border` pixels left of and below the centre of the bottom left pixel.
  return loopsOf(field).map((loop) => loop.map((x) => x + 0.5 - border));
}

/**
 * Distance of each point from the closest visible pixel's centre, up to `reach`, over the picture and `reach` pixels
 * around it.
 */
function distances({ width: columns, height: rows, data }: Image, threshold: number, reach: number): Field {
  const [width, height] = [columns + 2 * reach, rows + 2 * reach];
  const along = new Float32Array(width * height).fill(reach);
  for (let row = 0; row < rows; ++row) {
    const [line, pixel] = [(height - 1 - reach - row) * width + reach, 4 * row * columns + 3];
    for (let column = 0; column < columns; ++column) if (data[pixel + 4 * column] > threshold) along[line + column] = 0;
  }
  for (let line = 0; line < along.length; line += width) spread(along, line, width);
  const values = new Float32Array(width * height);
  for (let at = 0; at < values.length; ++at) {
    let least = along[at] ** 2;
    for (let step = 1; step * step < least; ++step) {
      const below = at - step * width;
      const above = at + step * width;
      if (below >= 0) least = Math.min(least, along[below] ** 2 + step * step);
      if (above < along.length) least = Math.min(least, along[above] ** 2 + step * step);
    }
    values[at] = Math.sqrt(least);
  }
  return { width, height, values };
}

/** Distances along one line, from zeros: there and back. */
function spread(values: Float32Array, begin: number, length: number): void {
  for (let i = begin + 1; i < begin + length; ++i) values[i] = Math.min(values[i], values[i - 1] + 1);
  for (let i = begin + length - 2; i >= begin; --i) values[i] = Math.min(values[i], values[i + 1] + 1);
}

/**
 * Segments of a cell by which of its corners are inside (bit k: corner k, counterclockwise from the bottom left): from
 * side, to side.
 */
const segments: readonly (readonly [from: number, to: number])[][] = [
  [],
  [[0, 3]],
  [[1, 0]],
  [[1, 3]],
  [[2, 1]],
  [],
  [[2, 0]],
  [[2, 3]],
  [[3, 2]],
  [[0, 2]],
  [],
  [[1, 2]],
  [[3, 1]],
  [[0, 1]],
  [[3, 0]],
  [],
];
/** Two corners across are inside: as one part where the middle is, or as two. */
const saddles: Record<number, Record<"one" | "two", (typeof segments)[number]>> = {
  5: {
    one: [
      [0, 1],
      [2, 3],
    ],
    two: [
      [0, 3],
      [2, 1],
    ],
  },
  10: {
    one: [
      [3, 0],
      [1, 2],
    ],
    two: [
      [1, 0],
      [3, 2],
    ],
  },
};

/** Marching squares: where the field passes zero, with what is above on the left. */
function loopsOf(field: Field): Loop[] {
  const next = linksOf(field);
  const loops: Loop[] = [];
  for (const [begin] of next) {
    const points: number[] = [];
    for (let edge = begin, after = next.get(edge); after !== undefined; edge = after, after = next.get(edge)) {
      next.delete(edge);
      points.push(...crossing(field, edge));
    }
    loops.push(Float64Array.from(points));
  }
  return loops;
}

/** The edge after each edge that the line crosses; 2 p is the edge from point p to the right, 2 p + 1 that upwards. */
function linksOf({ width, height, values }: Field): Map<number, number> {
  const next = new Map<number, number>();
  for (let row = 0; row + 1 < height; ++row) {
    for (let column = 0; column + 1 < width; ++column) {
      const at = row * width + column;
      const [a, b, c, d] = [values[at], values[at + 1], values[at + width + 1], values[at + width]];
      const inside = (a > 0 ? 1 : 0) | (b > 0 ? 2 : 0) | (c > 0 ? 4 : 0) | (d > 0 ? 8 : 0);
      if (inside === 0 || inside === 15) continue;
      const sides = [2 * at, 2 * (at + 1) + 1, 2 * (at + width), 2 * at + 1];
      const found = saddles[inside]?.[a + b + c + d > 0 ? "one" : "two"] ?? segments[inside];
      for (const [from, to] of found) next.set(sides[from], sides[to]);
    }
  }
  return next;
}

/** Never quite at a point of the field, where lines would touch. */
function crossing({ width, values }: Field, edge: number): [x: number, y: number] {
  const at = edge >> 1;
  const upwards = edge & 1;
  const [a, b] = [values[at], values[at + (upwards ? width : 1)]];
  const share = Math.min(0.98, Math.max(0.02, a / (a - b)));
  const [x, y] = [at % width, Math.floor(at / width)];
  return upwards ? [x, y + share] : [x + share, y];
}

/** Square pixels within a loop; of a hole the negative of it. */
export function areaOf(loop: Loop): number {
  let twice = 0;
  for (let i = 0, before = loop.length - 2; i < loop.length; before = i, i += 2)
    twice += loop[before] * loop[i + 1] - loop[i] * loop[before + 1];
  return twice / 2;
}
