// The deformed shape as binary glTF 2.0: positions, normals, triangles or points, colours or the picture.
import type { ShapeData } from "../shapes/shape.ts";
import { boundingBox } from "../shapes/shape.ts";

const [floats, integers, bytes] = [5126, 5125, 5121];

/** Collects pieces of the binary chunk, each at a multiple of four bytes. */
class Buffers {
  readonly pieces: Uint8Array<ArrayBuffer>[] = [];
  readonly views: object[] = [];
  readonly accessors: object[] = [];
  private size = 0;

  view(data: ArrayBufferView): number {
    const piece = new Uint8Array(4 * Math.ceil(data.byteLength / 4));
    piece.set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
    this.pieces.push(piece);
    this.views.push({ buffer: 0, byteOffset: this.size, byteLength: data.byteLength });
    this.size += piece.length;
    return this.views.length - 1;
  }
  accessor(data: ArrayBufferView, componentType: number, type: string, count: number, more: object = {}): number {
    this.accessors.push({ bufferView: this.view(data), componentType, type, count, ...more });
    return this.accessors.length - 1;
  }
  get length(): number {
    return this.size;
  }
}

/** glTF colours are linear. */
function linearColors(colors: Uint8Array): Uint8Array {
  const out = new Uint8Array((colors.length / 3) * 4).fill(255);
  colors.forEach((c, i) => {
    out[4 * Math.floor(i / 3) + (i % 3)] = Math.round(255 * (c / 255) ** 2.2);
  });
  return out;
}

async function png(image: TexImageSource): Promise<Uint8Array> {
  const { width, height } = image as HTMLCanvasElement;
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  canvas.getContext("2d")!.drawImage(image as HTMLCanvasElement, 0, 0);
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
  return new Uint8Array(await blob!.arrayBuffer());
}

export async function writeGlb(shape: ShapeData, positions: Float32Array, normals: Float32Array): Promise<Uint8Array<ArrayBuffer>> {
  const buffers = new Buffers();
  const count = positions.length / 3;
  const { min, max } = boundingBox(positions);
  const surface = shape.triangles.length > 0;
  const attributes: Record<string, number> = { POSITION: buffers.accessor(positions, floats, "VEC3", count, { min, max }) };
  if (surface) attributes["NORMAL"] = buffers.accessor(normals, floats, "VEC3", count);
  if (shape.colors) attributes["COLOR_0"] = buffers.accessor(linearColors(shape.colors), bytes, "VEC4", count, { normalized: true });
  if (shape.picture) attributes["TEXCOORD_0"] = buffers.accessor(shape.picture.uv.map((x, i) => (i % 2 ? 1 - x : x)), floats, "VEC2", count);
  const primitive = {
    attributes, material: 0, mode: surface ? 4 : 0,
    ...(surface ? { indices: buffers.accessor(shape.triangles, integers, "SCALAR", shape.triangles.length) } : {}),
  };
  const image = shape.picture && buffers.view(await png(shape.picture.image));
  const textured = image === undefined ? {} : {
    images: [{ bufferView: image, mimeType: "image/png" }], textures: [{ source: 0 }],
  };
  const base = image === undefined ? {} : { baseColorTexture: { index: 0 } };
  return pack({
    asset: { version: "2.0", generator: "Pliant" },
    scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, name: shape.name }],
    meshes: [{ primitives: [primitive] }],
    materials: [{ doubleSided: true, pbrMetallicRoughness: { ...base, metallicFactor: 0, roughnessFactor: 0.65 } }],
    ...textured,
    accessors: buffers.accessors, bufferViews: buffers.views, buffers: [{ byteLength: buffers.length }],
  }, buffers);
}

/** Header, JSON chunk, binary chunk. */
function pack(json: object, buffers: Buffers): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const padded = new Uint8Array(4 * Math.ceil(text.length / 4)).fill(32);
  padded.set(text);
  const total = 12 + 8 + padded.length + 8 + buffers.length;
  const out = new Uint8Array(total);
  const view = new DataView(out.buffer);
  [0x46546c67, 2, total, padded.length, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  out.set(padded, 20);
  view.setUint32(20 + padded.length, buffers.length, true);
  view.setUint32(24 + padded.length, 0x004e4942, true);
  let at = 28 + padded.length;
  for (const piece of buffers.pieces) {
    out.set(piece, at);
    at += piece.length;
  }
  return out;
}
