// File formats, by the ending of a name.

import { Place } from "../boundary/check.js";

/** Formats of pliant-io.wasm; their files can be passed through in pieces. */
export const textFormats = ["obj", "ply", "off", "stl", "xyz"] as const;

/** What `read` and `write` know: names end so. A .png is a shape in the plane. */
export const formats = [...textFormats, "glb", "png"] as const;

/** What `write` knows: a picture, deformed, is an .svg, too. */
export const writtenFormats = [...formats, "svg"] as const;

export type TextFormat = (typeof textFormats)[number];
export type FileFormat = (typeof formats)[number];
export type WrittenFormat = (typeof writtenFormats)[number];

/** The format that a name asks for. Errors: invalid-option. */
export function formatOf<Format extends WrittenFormat>(place: Place, name: unknown, among: readonly Format[]): Format {
  const expected = `a name that ends in ${among.map((format) => `.${format}`).join(" ")}`;
  if (typeof name !== "string") return place.fail(name, expected);
  const ending = /\.([^./\\]*)$/.exec(name)?.[1].toLowerCase();
  return among.find((format) => format === ending) ?? place.fail(name, expected);
}
