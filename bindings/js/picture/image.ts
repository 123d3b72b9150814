// Pictures: rows of pixels from top to bottom, as ImageData has them, and how callers hand them over.

import {
  choice,
  fields,
  type Fields,
  finite,
  flag,
  integer,
  list,
  notNegative,
  Place,
  positive,
} from "../boundary/check.js";
import { PliantError } from "../boundary/errors.js";

/** Pixels, row by row from the top: red, green, blue, alpha, from 0 to 255; colours are not multiplied by alpha. */
export interface Image {
  width: number;
  height: number;
  data: Uint8Array | Uint8ClampedArray;
}

/** A colour in sRGB, each from 0 to 255. */
export type Color = readonly [red: number, green: number, blue: number];

export type Background = Color | "border" | "auto";

/** A picture, and how its outline is found. Lengths are in pixels. */
export interface PictureInput extends Image {
  /**
   * What is of this colour is not part of the shape; "border": of the colour most of the border has. "auto": where the
   * picture is opaque and nine tenths of its border are of one colour, what is of that colour and hangs together with
   * the
   * border, so that white eyes on white paper stay. Left out: alpha alone tells.
   */
  background?: Background;
  /**
   * How far a colour may be from the background's and still be it, from 0 to 441: the diagonal of the cube of colours.
   * Default 48.
   */
  backgroundRange?: number;
  /** A pixel whose alpha is above this is part of the shape, from 0 to 254. Default 8. */
  threshold?: number;
  /** How far the outline keeps from the outermost pixels of the shape: they fade out within. Default 1.25. */
  margin?: number;
  /** How far the outline may be from the traced one. Default 0.75. */
  tolerance?: number;
  /** Distance of neighbouring vertices. Default: so that about 1,500 fill the shape. */
  spacing?: number;
  /**
   * Parts and holes of less than so many square pixels are left out, or filled. Default 64, in small pictures a
   * hundredth of all.
   */
  speck?: number;
  /** Whether holes stay open. Default true. */
  holes?: boolean;
}

/** A picture after reading: every option given, but the spacing, which the outline decides. */
export interface PicturePlan {
  image: Image;
  background: Background | undefined;
  backgroundRange: number;
  threshold: number;
  margin: number;
  tolerance: number;
  spacing: number | undefined;
  speck: number;
  holes: boolean;
}

/** Along a side. */
const largestSide = 16384;
export const largestPixels = 64e6;

const keys = [
  "width",
  "height",
  "data",
  "background",
  "backgroundRange",
  "threshold",
  "margin",
  "tolerance",
  "spacing",
  "speck",
  "holes",
];

/** Errors: invalid-shape for the pixels, invalid-option for the rest, too-large. */
export function readPicture(value: unknown): PicturePlan {
  const picture = fields(new Place("invalid-shape", "picture"), value, keys, "key of a picture");
  const image = readImage(new Place("invalid-shape", ""), picture);
  const place = new Place("invalid-option", "");
  const read = <T>(key: string, reader: (place: Place, value: unknown) => T, otherwise: T): T =>
    picture[key] === undefined ? otherwise : reader(place.at(key), picture[key]);
  return {
    image,
    background: read<Background | undefined>("background", readBackground, undefined),
    backgroundRange: read("backgroundRange", between(0, 441), 48),
    threshold: read("threshold", (here, given) => integer(here, given, 0, 254), 8),
    margin: read("margin", between(0.5, 64), 1.25),
    tolerance: read("tolerance", between(0, 64), 0.75),
    spacing: read<number | undefined>("spacing", positive, undefined),
    speck: read("speck", notNegative, Math.min(64, (image.width * image.height) / 100)),
    holes: read("holes", flag, true),
  };
}

/** Errors: as the place has them, too-large. */
export function readImage(place: Place, { width: w, height: h, data: pixels }: Fields): Image {
  const width = integer(place.at("width"), w, 1, largestSide, "pixels");
  const height = integer(place.at("height"), h, 1, largestSide, "pixels");
  if (width * height > largestPixels)
    throw new PliantError(
      "too-large",
      `the picture has ${width} x ${height} pixels; expected at most ${largestPixels}`,
    );
  const all = `red, green, blue and alpha of ${width} x ${height} pixels`;
  const expected = `a Uint8Array or Uint8ClampedArray of length ${4 * width * height}: ${all}`;
  const data = list(place.at("data"), pixels, expected);
  const fits = (data instanceof Uint8Array || data instanceof Uint8ClampedArray) && data.length === 4 * width * height;
  return fits ? { width, height, data } : place.at("data").fail(data, expected);
}

function readBackground(place: Place, value: unknown): Background {
  if (typeof value === "string") return choice<"border" | "auto">(place, value, ["border", "auto"]);
  const expected = 'three numbers from 0 to 255, "border" or "auto"';
  const color = list(place, value, expected);
  if (color.length !== 3) place.fail(value, expected);
  const [red, green, blue] = Array.from(color, (share, i) => integer(place.item(i), share, 0, 255));
  return [red, green, blue];
}

function between(least: number, most: number) {
  return (place: Place, value: unknown): number => {
    const expected = `a number from ${least} to ${most}`;
    const number = finite(place, value, expected);
    return number >= least && number <= most ? number : place.fail(value, expected);
  };
}
