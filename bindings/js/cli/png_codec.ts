// The pixels of .png files, in Node: by fast-png, which is part of the command only.

import { convertIndexedToRgb, decode, type DecodedPng, encode } from "fast-png";
import { PliantError } from "../boundary/errors.js";
import type { PictureCodec } from "../picture/codec.js";
import { largestPixels } from "../picture/image.js";

/** Errors: parse-error for a file that is none or is damaged, too-large. */
export const pngCodec: PictureCodec = {
  decode(bytes) {
    checkHeader(bytes);
    try {
      const png = decode(bytes, { checkCrc: true });
      return { width: png.width, height: png.height, data: pixelsOf(png) };
    } catch (error) {
      throw new PliantError("parse-error", `not a readable .png: ${(error as Error).message}`, { cause: error });
    }
  },
  encode({ width, height, data }) {
    return encode({ width, height, data, channels: 4, depth: 8 }, { zlib: { level: 6 } }) as Uint8Array<ArrayBuffer>;
  },
};

/** Eight bytes that no other file begins with, then the size, before anything is made of it. */
function checkHeader(bytes: Uint8Array): void {
  const reject = (reason: string): never => {
    throw new PliantError("parse-error", `not a readable .png: ${reason}`);
  };
  const signature = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
  if (signature.some((byte, i) => bytes[i] !== byte)) reject("it does not begin as one");
  if (bytes.length < 33) reject(`it ends at byte ${bytes.length}`);
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const [width, height] = [view.getUint32(16), view.getUint32(20)];
  if (String.fromCharCode(...bytes.subarray(12, 16)) !== "IHDR" || width === 0 || height === 0)
    reject("its header is damaged");
  if (width * height > largestPixels)
    throw new PliantError("too-large", `it has ${width} x ${height} pixels; expected at most ${largestPixels}`);
}

/** Red, green, blue and alpha, a byte each, of whatever a file has. */
function pixelsOf(png: DecodedPng): Uint8ClampedArray {
  const { width, height } = png;
  const channels = png.palette ? png.palette[0].length : png.channels;
  const values = png.palette ? convertIndexedToRgb(png) : valuesOf(png);
  const scale = png.palette ? 1 : 255 / (2 ** png.depth - 1);
  const clear = png.palette ? undefined : png.transparency;
  const data = new Uint8ClampedArray(4 * width * height);
  for (let pixel = 0; pixel < width * height; ++pixel) {
    const own = values.subarray(channels * pixel, channels * (pixel + 1));
    const colors = channels < 3 ? 1 : 3;
    for (let k = 0; k < 3; ++k) data[4 * pixel + k] = scale * own[Math.min(k, colors - 1)];
    const hidden = clear !== undefined && clear.every((value, k) => value === own[k]);
    data[4 * pixel + 3] = hidden ? 0 : channels === colors ? 255 : scale * own[colors];
  }
  return data;
}

/** One number a channel; below eight bits a byte holds several, and each row begins with a new one. */
function valuesOf({ width, height, depth, channels, data }: DecodedPng): DecodedPng["data"] {
  if (depth >= 8) return data;
  const values = new Uint8Array(width * height * channels);
  const [line, mask] = [Math.ceil((width * channels * depth) / 8), 2 ** depth - 1];
  for (let i = 0; i < values.length; ++i) {
    const [row, bit] = [Math.floor(i / width), (i % width) * depth];
    values[i] = (data[row * line + (bit >> 3)] >> (8 - depth - (bit & 7))) & mask;
  }
  return values;
}
