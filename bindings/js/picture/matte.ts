// A background of one colour, made transparent.

import type { Background, Color, Image } from "./image.js";

/** Bits a channel by which colours of the border are told apart. */
const kept = 4;

/**
 * The colour of most of the border, with alpha or without, and how much of it: the mean of those in the fullest of 16 x
 * 16 x 16 bins.
 */
export function borderColor({ width, height, data }: Image): { color: Color; share: number } {
  const bins = new Map<number, [count: number, red: number, green: number, blue: number]>();
  let total = 0;
  const count = (column: number, row: number) => {
    const at = 4 * (row * width + column);
    const key = [0, 1, 2].reduce((code, k) => (code << kept) | (data[at + k] >> (8 - kept)), 0);
    const bin = bins.get(key) ?? [0, 0, 0, 0];
    bins.set(key, [bin[0] + 1, bin[1] + data[at], bin[2] + data[at + 1], bin[3] + data[at + 2]]);
    ++total;
  };
  for (let column = 0; column < width; ++column) [0, height - 1].forEach((row) => count(column, row));
  for (let row = 1; row + 1 < height; ++row) [0, width - 1].forEach((column) => count(column, row));
  const [most, red, green, blue] = [...bins.values()].reduce((a, b) => (b[0] > a[0] ? b : a));
  return { color: [red / most, green / most, blue / most], share: most / total };
}

/** The picture as a copy, with its background transparent. */
export function cutOut(image: Image, background: Background | undefined, range: number): Image {
  const whole = { ...image, data: new Uint8ClampedArray(image.data) };
  if (background === undefined) return whole;
  if (background !== "auto") {
    const color = background === "border" ? borderColor(image).color : background;
    return withoutBackground(image, color, allOf(image, color, range));
  }
  const { color, share } = borderColor(image);
  if (share < uniform || image.data.some((value, i) => i % 4 === 3 && value < 255)) return whole;
  const paper = besideBorder(image, color, range);
  return paper.every(Boolean) ? whole : withoutBackground(image, color, paper);
}

/** Share of the border that has to be of one colour to be taken for a background. */
const uniform = 0.9;
/** Pixels on both sides of the edge of a background that may be a mixture of both. */
const band = 2;
/** Pixels around one of the band among which there are some that are no mixture. */
const reach = 4;
/** Less of the foreground in a mixture than this is noise. */
const faint = 0.08;

/**
 * `paper`: the pixels that are background. Those close to its edge are taken for mixtures of it and of the colour
 * beside
 * them farther inside: they get that colour, and of its alpha the share it has in them.
 */
function withoutBackground({ width, height, data }: Image, background: Color, paper: Uint8Array): Image {
  const out = new Uint8ClampedArray(data);
  const edge = edgeOf();
  for (let pixel = 0; pixel < paper.length; ++pixel) {
    if (!edge[pixel]) {
      if (paper[pixel]) out[4 * pixel + 3] = 0;
      continue;
    }
    const front = foreground(pixel);
    const share = mixture(data, 4 * pixel, background, front);
    const alpha = share < faint ? 0 : Math.min(1, share);
    out[4 * pixel + 3] = alpha * data[4 * pixel + 3];
    for (let k = 0; k < 3 && alpha > 0; ++k)
      out[4 * pixel + k] = background[k] + (data[4 * pixel + k] - background[k]) / alpha;
  }
  return { width, height, data: out };

  /** Pixels in the band. */
  function edgeOf(): Uint8Array {
    const found = new Uint8Array(paper.length);
    for (let pixel = 0; pixel < paper.length; ++pixel) {
      const right = pixel % width < width - 1 && paper[pixel] !== paper[pixel + 1];
      const below = pixel + width < paper.length && paper[pixel] !== paper[pixel + width];
      if (right || below) for (const other of around(pixel, band)) found[other] = 1;
    }
    return found;
  }

  function around(pixel: number, radius: number): number[] {
    const [column, row] = [pixel % width, Math.floor(pixel / width)];
    const found: number[] = [];
    for (let y = Math.max(0, row - radius); y <= Math.min(height - 1, row + radius); ++y) {
      for (let x = Math.max(0, column - radius); x <= Math.min(width - 1, column + radius); ++x)
        found.push(y * width + x);
    }
    return found;
  }

  /** The mean colour beside a pixel that is no mixture; of something thinner, the one least like the background. */
  function foreground(pixel: number): Color {
    const pixels = around(pixel, reach);
    const pure = pixels.filter((other) => !paper[other] && !edge[other]);
    const far = (other: number) => distance(data, 4 * other, background);
    const chosen = pure.length > 0 ? pure : [pixels.reduce((a, b) => (far(b) > far(a) ? b : a))];
    const mean = (k: number) => chosen.reduce((sum, other) => sum + data[4 * other + k], 0) / chosen.length;
    return [mean(0), mean(1), mean(2)];
  }
}

/** How much of the way from one colour to another a pixel is. */
function mixture(data: Image["data"], at: number, from: Color, to: Color): number {
  let [along, whole] = [0, 0];
  for (let k = 0; k < 3; ++k) {
    along += (data[at + k] - from[k]) * (to[k] - from[k]);
    whole += (to[k] - from[k]) ** 2;
  }
  return along / Math.max(whole, 1e-9);
}

function allOf({ width, height, data }: Image, color: Color, range: number): Uint8Array {
  return Uint8Array.from({ length: width * height }, (_, pixel) => Number(distance(data, 4 * pixel, color) <= range));
}

function distance(data: Image["data"], at: number, color: Color): number {
  return Math.hypot(data[at] - color[0], data[at + 1] - color[1], data[at + 2] - color[2]);
}

/** Pixels of a colour that are joined to the border by such. */
function besideBorder({ width, height, data }: Image, color: Color, range: number): Uint8Array {
  const found = new Uint8Array(width * height);
  const open: number[] = [];
  const visit = (column: number, row: number) => {
    const pixel = row * width + column;
    if (
      column < 0 ||
      row < 0 ||
      column >= width ||
      row >= height ||
      found[pixel] ||
      distance(data, 4 * pixel, color) > range
    )
      return;
    found[pixel] = 1;
    open.push(pixel);
  };
  for (let column = 0; column < width; ++column) [0, height - 1].forEach((row) => visit(column, row));
  for (let row = 0; row < height; ++row) [0, width - 1].forEach((column) => visit(column, row));
  for (let pixel = open.pop(); pixel !== undefined; pixel = open.pop()) {
    const [column, row] = [pixel % width, Math.floor(pixel / width)];
    visit(column - 1, row);
    visit(column + 1, row);
    visit(column, row - 1);
    visit(column, row + 1);
  }
  return found;
}
