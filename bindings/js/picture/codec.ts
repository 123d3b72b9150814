// Pixels from the bytes of a picture, and back: by the browser, which can, or by what stands in for it elsewhere.

import { PliantError } from "../boundary/errors.js";
import type { Image } from "./image.js";

/** Where a browser is missing: how the bytes of a picture become pixels, and pixels a .png. */
export interface PictureCodec {
  decode(bytes: Uint8Array<ArrayBuffer>): Image | Promise<Image>;
  encode(image: Image): Uint8Array<ArrayBuffer> | Promise<Uint8Array<ArrayBuffer>>;
}

/**
 * The browser's own, on pages and in their workers: .png, .jpg, .webp, and what else it knows. Errors: parse-error,
 * load-failed.
 */
export const browserCodec: PictureCodec = {
  async decode(bytes) {
    const context = canvas(1, 1);
    const bitmap = await createImageBitmap(new Blob([bytes]), { colorSpaceConversion: "none" }).catch((error) => {
      throw new PliantError("parse-error", "not a readable picture", { cause: error });
    });
    const { width, height } = bitmap;
    [context.canvas.width, context.canvas.height] = [width, height];
    context.drawImage(bitmap, 0, 0);
    bitmap.close();
    const { data } = context.getImageData(0, 0, width, height);
    return { width, height, data };
  },
  async encode({ width, height, data }) {
    const context = canvas(width, height);
    context.putImageData(new ImageData(new Uint8ClampedArray(data), width, height), 0, 0);
    const blob = await context.canvas.convertToBlob({ type: "image/png" });
    return new Uint8Array(await blob.arrayBuffer());
  },
};

function canvas(width: number, height: number): OffscreenCanvasRenderingContext2D {
  const context = typeof OffscreenCanvas === "undefined" ? null : new OffscreenCanvas(width, height).getContext("2d");
  if (context) return context;
  throw new PliantError(
    "load-failed",
    "pictures are read and written by the browser, and here is none; " +
      "expected init({ pictures }) of pliant/io with a decoder and an encoder",
  );
}
