// A textured mesh drawn into a picture, without a GPU.

import { fields, finite, type FloatArray, list, integer, Place, vector } from "../boundary/check.js";
import { type Image, readImage } from "./image.js";
import { backToFront } from "./order.js";

/** What is drawn, and where to. */
export interface Drawing {
  /** The picture on the mesh. */
  image: Image;
  /** Two numbers a vertex: pixels from the bottom left corner, y up. */
  positions: ArrayLike<number>;
  /** Two numbers a vertex, from 0 to 1 over the picture, v up; beyond it all is transparent. */
  texcoords: ArrayLike<number>;
  /** Three vertex ids each, from back to front. */
  triangles: ArrayLike<number>;
  /** One a vertex: larger ones are in front, and those of one depth in the order of the triangles. */
  depths?: ArrayLike<number>;
  /** Size of the result, and where its bottom left corner is. Default: the frame of the picture, at the origin. */
  width?: number;
  height?: number;
  origin?: readonly [x: number, y: number];
}

/**
 * Coordinates are rounded to 1 / 256 of a pixel to tell what a triangle covers: sums of such are exact, and no seam is
 * left or drawn twice.
 */
const subpixels = 256;

/**
 * Draws the mesh: each pixel whose centre a triangle covers, bilinear between the pixels of the picture, with colours
 * multiplied by alpha meanwhile, over what is drawn there already. Undistorted, it is the picture itself.
 * Errors: invalid-option, too-large.
 */
export function rasterize(drawing: Drawing): Image & { data: Uint8ClampedArray<ArrayBuffer> } {
  const { image, positions, texcoords, triangles, width, height, origin } = readDrawing(drawing);
  const source = premultiplied(image);
  const target = new Canvas(width, height);
  const corner = (v: number): Corner => {
    const [x, y] = [positions[2 * v] - origin[0], height - (positions[2 * v + 1] - origin[1])];
    // A pixel's centre is half a pixel from its corner, on both sides.
    const [u, v2] = [texcoords[2 * v] * image.width - 0.5, (1 - texcoords[2 * v + 1]) * image.height - 0.5];
    return { x, y, column: Math.round(x * subpixels), row: Math.round(y * subpixels), u, v: v2 };
  };
  for (let t = 0; t < triangles.length; t += 3) {
    target.draw(corner(triangles[t]), corner(triangles[t + 1]), corner(triangles[t + 2]), source);
  }
  return target.image();
}

/** The smallest whole frame around positions in the plane: size, and the bottom left corner. */
export function frameOf(positions: ArrayLike<number>): { width: number; height: number; origin: [number, number] } {
  const [least, most] = [
    [Infinity, Infinity],
    [-Infinity, -Infinity],
  ];
  for (let i = 0; i < positions.length; ++i) {
    least[i % 2] = Math.min(least[i % 2], positions[i]);
    most[i % 2] = Math.max(most[i % 2], positions[i]);
  }
  const origin: [number, number] = [Math.floor(least[0]), Math.floor(least[1])];
  return { width: Math.ceil(most[0]) - origin[0], height: Math.ceil(most[1]) - origin[1], origin };
}

function readDrawing(value: Drawing) {
  const known = ["image", "positions", "texcoords", "triangles", "depths", "width", "height", "origin"];
  const place = new Place("invalid-option", "");
  const given = fields(new Place("invalid-option", "drawing"), value, known);
  const image = readImage(place.at("image"), fields(place.at("image"), given.image, ["width", "height", "data"]));
  const positions = numbers(place.at("positions"), given.positions, undefined);
  const texcoords = numbers(place.at("texcoords"), given.texcoords, positions.length);
  const ids = numbers(place.at("triangles"), given.triangles, undefined);
  const triangles = Uint32Array.from(ids);
  triangles.forEach((id, i) => {
    if (id !== ids[i] || id >= positions.length / 2)
      integer(place.at("triangles").item(i), ids[i], 0, positions.length / 2 - 1, "a vertex id");
  });
  const depths =
    given.depths === undefined ? undefined : numbers(place.at("depths"), given.depths, positions.length / 2);
  const origin = given.origin === undefined ? [0, 0] : vector(place.at("origin"), given.origin, 2);
  const side = (key: "width" | "height") =>
    given[key] === undefined ? image[key] : integer(place.at(key), given[key], 1, 16384, "pixels");
  return {
    image,
    positions,
    texcoords,
    origin,
    width: side("width"),
    height: side("height"),
    triangles: depths ? backToFront(triangles, depths) : triangles,
  };
}

function numbers(place: Place, value: unknown, length: number | undefined): FloatArray {
  const expected = length === undefined ? "an array of numbers" : `${length} numbers`;
  const given = list(place, value, expected) as ArrayLike<number>;
  for (let i = 0; i < given.length; ++i) if (!Number.isFinite(given[i])) finite(place.item(i), given[i]);
  return length === undefined || given.length === length ? Float64Array.from(given) : place.fail(value, expected);
}

interface Corner {
  x: number;
  y: number;
  /** In parts of a pixel, whole. */
  column: number;
  row: number;
  /** In the picture: 0 at the centre of its first pixel. */
  u: number;
  v: number;
}

/** Colours times alpha, from 0 to 1, in a frame of transparent pixels. */
interface Source {
  width: number;
  height: number;
  values: Float32Array;
}

function premultiplied({ width, height, data }: Image): Source {
  const values = new Float32Array(4 * (width + 2) * (height + 2));
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column) {
      const [from, to] = [4 * (row * width + column), 4 * ((row + 1) * (width + 2) + column + 1)];
      const alpha = data[from + 3] / 255;
      for (let k = 0; k < 3; ++k) values[to + k] = (alpha * data[from + k]) / 255;
      values[to + 3] = alpha;
    }
  }
  return { width, height, values };
}

class Canvas {
  readonly #values: Float32Array;

  constructor(
    readonly width: number,
    readonly height: number,
  ) {
    this.#values = new Float32Array(4 * width * height);
  }

  /** Pixels whose centres the triangle covers; of two triangles that meet in an edge, one has those on it. */
  draw(a: Corner, b: Corner, c: Corner, source: Source): void {
    const twice = across(a, b, c.column, c.row);
    if (twice === 0) return;
    if (twice < 0) return this.draw(a, c, b, source);
    const at = (i: number, bound: number) => Math.min(bound, Math.max(0, i));
    const half = subpixels / 2;
    const first = at(Math.ceil((Math.min(a.row, b.row, c.row) - half) / subpixels), this.height);
    const last = at(Math.floor((Math.max(a.row, b.row, c.row) - half) / subpixels) + 1, this.height);
    const left = at(Math.ceil((Math.min(a.column, b.column, c.column) - half) / subpixels), this.width);
    const right = at(Math.floor((Math.max(a.column, b.column, c.column) - half) / subpixels) + 1, this.width);
    const [du, dv] = [slope(a, b, c, "u"), slope(a, b, c, "v")];
    for (let row = first; row < last; ++row) {
      const y = row * subpixels + half;
      for (let column = left; column < right; ++column) {
        const x = column * subpixels + half;
        if (!(covers(a, b, x, y) && covers(b, c, x, y) && covers(c, a, x, y))) continue;
        const dx = column + 0.5 - a.x;
        const dy = row + 0.5 - a.y;
        this.#put(row * this.width + column, a.u + du[0] * dx + du[1] * dy, a.v + dv[0] * dx + dv[1] * dy, source);
      }
    }
  }

  /** What the picture has at a place, over what is there. */
  #put(pixel: number, u: number, v: number, { width, height, values }: Source): void {
    if (!(u > -1 && v > -1 && u < width && v < height)) return;
    const column = Math.floor(u);
    const row = Math.floor(v);
    const right = u - column;
    const below = v - row;
    const a = 4 * ((row + 1) * (width + 2) + column + 1);
    const c = a + 4 * (width + 2);
    const wa = (1 - right) * (1 - below);
    const wb = right * (1 - below);
    const wc = (1 - right) * below;
    const wd = right * below;
    const under = 1 - (wa * values[a + 3] + wb * values[a + 7] + wc * values[c + 3] + wd * values[c + 7]);
    const out = this.#values;
    for (let k = 0; k < 4; ++k) {
      const over = wa * values[a + k] + wb * values[a + 4 + k] + wc * values[c + k] + wd * values[c + 4 + k];
      out[4 * pixel + k] = over + under * out[4 * pixel + k];
    }
  }

  image(): Image & { data: Uint8ClampedArray<ArrayBuffer> } {
    const values = this.#values;
    const data = new Uint8ClampedArray(values.length);
    for (let i = 0; i < data.length; i += 4) {
      const alpha = values[i + 3];
      data[i + 3] = 255 * alpha;
      if (data[i + 3] === 0) continue; // invisible: nothing but zeros
      for (let k = 0; k < 3; ++k) data[i + k] = (255 * values[i + k]) / alpha;
    }
    return { width: this.width, height: this.height, data };
  }
}

/** Twice the area left of the way from a to b, with y down: positive where the point is clockwise of it. */
function across(a: Corner, b: Corner, x: number, y: number): number {
  return (b.column - a.column) * (y - a.row) - (b.row - a.row) * (x - a.column);
}

/** Inside, or on an edge that is this triangle's: a top one or a left one. */
function covers(a: Corner, b: Corner, x: number, y: number): boolean {
  const side = across(a, b, x, y);
  if (side !== 0) return side > 0;
  return b.row < a.row || (b.row === a.row && b.column > a.column);
}

/** How fast a value changes over the triangle with x and with y. */
function slope(a: Corner, b: Corner, c: Corner, key: "u" | "v"): [number, number] {
  const [bx, by, cx, cy] = [b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y];
  const twice = bx * cy - by * cx;
  if (twice === 0) return [0, 0]; // thinner than a part of a pixel
  const [p, q] = [b[key] - a[key], c[key] - a[key]];
  return [(p * cy - q * by) / twice, (q * bx - p * cx) / twice];
}
