// Pictures drawn by code, and what is to be seen in them.

import { decode, encode } from "fast-png";
import type { Image } from "../../../bindings/js/picture.js";

export { scout, inScout } from "../../../web-demo/src/shapes/scout.js";

/** A pixel by its centre, in pixels from the bottom left corner. */
export type Paint = (x: number, y: number) => readonly [red: number, green: number, blue: number, alpha: number];

export function painted(width: number, height: number, paint: Paint): Image {
  const data = new Uint8ClampedArray(4 * width * height);
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column)
      data.set(paint(column + 0.5, height - row - 0.5), 4 * (row * width + column));
  }
  return { width, height, data };
}

/** Opaque where a distance is below zero, smooth over a pixel. */
export const cover = (distance: number): number => 255 * Math.min(1, Math.max(0, 0.5 - distance));

export const disc =
  (x: number, y: number, radius: number) =>
  (px: number, py: number): number =>
    Math.hypot(px - x, py - y) - radius;

export const pixelAt = ({ width, height, data }: Image, x: number, y: number): number[] => {
  const at = 4 * ((height - 1 - Math.floor(y)) * width + Math.floor(x));
  return [...data.subarray(at, at + 4)];
};

/** A copy with a disc of a colour on it, where it is visible. */
export function dotted(image: Image, x: number, y: number, radius: number, color: readonly number[]): Image {
  const data = new Uint8ClampedArray(image.data);
  for (let row = 0; row < image.height; ++row) {
    for (let column = 0; column < image.width; ++column) {
      if (Math.hypot(column + 0.5 - x, image.height - row - 0.5 - y) < radius)
        data.set(color, 4 * (row * image.width + column));
    }
  }
  return { ...image, data };
}

/** Middle of the pixels close to a colour; NaN: there are none. */
export function middleOf({ width, height, data }: Image, color: readonly number[]): [x: number, y: number] {
  let [sx, sy, n] = [0, 0, 0];
  for (let pixel = 0; pixel < width * height; ++pixel) {
    if (data[4 * pixel + 3] < 128 || Math.hypot(...[0, 1, 2].map((k) => data[4 * pixel + k] - color[k])) > 40) continue;
    sx += (pixel % width) + 0.5;
    sy += height - Math.floor(pixel / width) - 0.5;
    ++n;
  }
  return [sx / n, sy / n];
}

/** Square pixels, each by its alpha. */
export const visibleArea = ({ data }: Image): number => sum([...data].filter((_, i) => i % 4 === 3)) / 255;

export const png = ({ width, height, data }: Image): Uint8Array =>
  encode({ width, height, data, channels: 4, depth: 8 });

export function readPng(bytes: Uint8Array): Image {
  const { width, height, data, channels } = decode(bytes);
  if (channels !== 4) throw new Error(`has ${channels} channels`);
  return { width, height, data: data as Uint8Array };
}

/** Corners of a triangle. */
export const cornersOf = (positions: ArrayLike<number>, triangles: ArrayLike<number>, t: number): [number, number][] =>
  [0, 1, 2].map((k) => [positions[2 * triangles[3 * t + k]], positions[2 * triangles[3 * t + k] + 1]]);

/** Of each triangle, positive counterclockwise. */
export function areasOf(positions: ArrayLike<number>, triangles: ArrayLike<number>): number[] {
  return Array.from({ length: triangles.length / 3 }, (_, t) => {
    const [[ax, ay], [bx, by], [cx, cy]] = cornersOf(positions, triangles, t);
    return ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2;
  });
}

export const sum = (values: readonly number[]): number => values.reduce((a, b) => a + b, 0);
