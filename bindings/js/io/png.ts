// Pictures as shape files: read into a mesh in the plane, and drawn from one.

import { PliantError } from "../boundary/errors.js";
import type { PictureCodec } from "../picture/codec.js";
import type { Image, PictureInput } from "../picture/image.js";
import { meshOf } from "../picture/mesh.js";
import { backToFront, depthOrder } from "../picture/order.js";
import { frameOf, rasterize } from "../picture/raster.js";
import { svgOf } from "../picture/svg.js";
import { triangleCorners } from "./refined.js";
import type { Frame, Mesh, PictureOptions } from "./shape_file.js";

/** What `read` gives of a picture, beside its format. */
type PictureFile = Mesh & { dimension: 2; texture: Blob };

/** Errors: parse-error, invalid-shape, too-large, load-failed; invalid-option for the options. */
export async function readPng(
  codec: PictureCodec,
  bytes: Uint8Array<ArrayBuffer>,
  options: PictureOptions = {},
): Promise<PictureFile> {
  const picture = await codec.decode(bytes);
  const { image, positions, triangles, texcoords } = meshOf({ ...options, ...picture } satisfies PictureInput);
  const texture = options.background === undefined ? bytes : await codec.encode(image);
  return {
    positions,
    triangles,
    faceVertices: triangles.slice(),
    dimension: 2,
    faceOffsets: Uint32Array.from({ length: triangles.length / 3 + 1 }, (_, i) => 3 * i),
    texcoords: Float64Array.from(
      { length: 2 * triangles.length },
      (_, i) => texcoords[2 * triangles[i >> 1] + (i & 1)],
    ),
    colors: new Uint8Array(0),
    texture: new Blob([texture], { type: "image/png" }),
  };
}

/** A shape in the plane, and the picture on it. `frame`: what is to be seen; left out: that of the picture. */
interface Shown {
  mesh: Mesh;
  texture: Blob | undefined;
  depths: Float64Array | undefined;
  frame: Frame | "fit" | undefined;
}

/** Draws a mesh with its picture. Errors: invalid-shape, parse-error, too-large, load-failed. */
export async function writePng(codec: PictureCodec, shown: Shown): Promise<Uint8Array<ArrayBuffer>> {
  const { image, corners, frame } = await drawn(codec, shown);
  return codec.encode(rasterize({ image, ...corners, ...frame }));
}

/** Triangles of the picture, clipped. Errors: as `writePng`. */
export async function writeSvg(codec: PictureCodec, shown: Shown): Promise<Uint8Array<ArrayBuffer>> {
  const {
    image: { width, height },
    corners,
    frame,
  } = await drawn(codec, shown);
  const href = await dataUrl(shown.texture!);
  return new TextEncoder().encode(svgOf({ href, width, height, frame, ...corners }));
}

/** Three vertices a triangle, from back to front, and what is on them. */
async function drawn(codec: PictureCodec, { mesh, texture, depths, frame }: Shown) {
  if (!texture || mesh.texcoords.length === 0) {
    throw new PliantError(
      "invalid-shape",
      `${texture ? "texcoords is empty" : "texture is missing"}; expected a picture on the shape, to draw it`,
    );
  }
  const image = await picturesOf(codec, texture);
  const all = Uint32Array.from(mesh.triangles, (_, i) => i);
  const vertex = mesh.triangles;
  const corner = triangleCorners(mesh);
  const positions = Float64Array.from(
    { length: 2 * vertex.length },
    (_, i) => mesh.positions[3 * vertex[i >> 1] + (i & 1)],
  );
  const texcoords = Float64Array.from(
    { length: 2 * vertex.length },
    (_, i) => mesh.texcoords[2 * corner[i >> 1] + (i & 1)],
  );
  const triangles = depths
    ? backToFront(
        all,
        Float64Array.from(vertex, (v) => depths[v]),
      )
    : all;
  const whole = { width: image.width, height: image.height, origin: [0, 0] as const };
  return {
    image,
    corners: { positions, texcoords, triangles },
    frame: frame === "fit" ? frameOf(positions) : (frame ?? whole),
  };
}

/** The same triangles from back to front, as faces. */
export function layered(mesh: Mesh, depths: Float64Array): Mesh {
  const corners = triangleCorners(mesh);
  const order = depthOrder(mesh.triangles, depths);
  const at = (i: number) => 3 * order[Math.floor(i / 3)] + (i % 3);
  const triangles = mesh.triangles.map((_, i) => mesh.triangles[at(i)]);
  const texcoords =
    mesh.texcoords.length === 0
      ? mesh.texcoords
      : Float64Array.from(
          { length: 2 * triangles.length },
          (_, i) => mesh.texcoords[2 * corners[at(i >> 1)] + (i & 1)],
        );
  const faceOffsets = Uint32Array.from({ length: triangles.length / 3 + 1 }, (_, i) => 3 * i);
  return { ...mesh, triangles, faceVertices: triangles.slice(), faceOffsets, texcoords };
}

/** What was decoded last stays while it is asked for: frames of an animation show one picture. */
const decoded = new WeakMap<Blob, Promise<Image>>();

function picturesOf(codec: PictureCodec, texture: Blob): Promise<Image> {
  const known = decoded.get(texture);
  if (known) return known;
  const image = texture.arrayBuffer().then((bytes) => codec.decode(new Uint8Array(bytes)));
  decoded.set(texture, image);
  return image;
}

async function dataUrl(blob: Blob): Promise<string> {
  const bytes = new Uint8Array(await blob.arrayBuffer());
  let text = "";
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return `data:${blob.type || "image/png"};base64,${btoa(text)}`;
}
