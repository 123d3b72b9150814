// A picture as a shape in the plane: the library traces and triangulates it, in its worker.
import type { PictureInput } from "pliant/worker";
import { connect } from "../solver/pliant.ts";
import type { LoadedShape, PictureOn, StartPose } from "../shapes/shape.ts";

/** Errors: not a picture; nothing to see. */
export async function readPicture(file: Blob): Promise<LoadedShape> {
  const image = await createImageBitmap(file, { colorSpaceConversion: "none" }).catch(() => {
    throw new Error("it is not a picture");
  });
  const context = asCanvas(image, image.width, image.height).getContext("2d")!;
  const { width, height, data } = context.getImageData(0, 0, image.width, image.height);
  const shape = await pictureShape({ width, height, data, background: "auto" });
  // Pins are put where they are wanted: nothing is held from the beginning.
  return { ...shape, start: pinned([]) };
}

/** What puppets are bent with: pins exact, and areas kept. */
export const pinned = (handles: StartPose["handles"]): StartPose =>
  ({ fixed: () => false, handles, method: "arap" });

/** The visible part of a picture, in pixels from its bottom left corner. */
export async function pictureShape(input: PictureInput): Promise<LoadedShape> {
  const picture = await (await connect()).picture(input);
  const { positions: flat, triangles, texcoords: uv, image: { width, height, data } } = picture;
  await picture.dispose();
  const inSpace = (i: number) => (i % 3 === 2 ? 0 : flat[2 * Math.floor(i / 3) + (i % 3)]!);
  const exact = Float64Array.from({ length: (flat.length / 2) * 3 }, (_, i) => inSpace(i));
  const image = new ImageData(new Uint8ClampedArray(data), width, height);
  const positions = Float32Array.from(exact);
  return { positions, exact, triangles, dimension: 2, viewFrom: [0, 0, 1], picture: { image, uv } };
}

/** A canvas: what the renderer and the exports can both turn the right way up. */
export function asCanvas(image: ImageBitmap, width: number, height: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  canvas.getContext("2d")!.drawImage(image, 0, 0, width, height);
  return canvas;
}

/** A picture as a file. */
export async function asPng({ image }: PictureOn): Promise<Blob> {
  let canvas = image as HTMLCanvasElement;
  if (image instanceof ImageData) {
    canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    canvas.getContext("2d")!.putImageData(image, 0, 0);
  }
  return new Promise((resolve) => canvas.toBlob((blob) => resolve(blob!), "image/png"));
}
