// The visitor's own file as a shape. Whatever goes wrong is said in words.
import { Color, type BufferAttribute, type BufferGeometry, type InterleavedBufferAttribute } from "three";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";
import type { ShapeData } from "../shapes/shape.ts";
import { readPicture } from "./picture.ts";
import { readGlb } from "./read_glb.ts";
import { readObj, type Loaded } from "./read_obj.ts";

type Reader = (bytes: ArrayBuffer, file: File) => Loaded | Promise<Loaded & { dimension?: 2 }>;

const text = (bytes: ArrayBuffer) => new TextDecoder().decode(bytes);

const readers: Record<string, Reader> = {
  obj: (bytes) => readObj(text(bytes)),
  ply: (bytes) => fromGeometry(new PLYLoader().parse(bytes)),
  stl: (bytes) => fromGeometry(new STLLoader().parse(bytes)),
  glb: readGlb,
  xyz: (bytes) => readXyz(text(bytes)),
  png: (_, file) => readPicture(file),
  jpg: (_, file) => readPicture(file),
  jpeg: (_, file) => readPicture(file),
  webp: (_, file) => readPicture(file),
};

/** Errors: a sentence for the visitor. */
export async function loadFile(file: File): Promise<ShapeData> {
  const extension = file.name.toLowerCase().split(".").pop() ?? "";
  const reader = readers[extension];
  if (!reader) throw new Error(`${file.name}: this kind of file is not known here. Known are ${Object.keys(readers).map((e) => `.${e}`).join(", ")}.`);
  let loaded: Loaded & { dimension?: 2 };
  try {
    loaded = await reader(await file.arrayBuffer(), file);
    check(loaded);
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    throw new Error(`${file.name} could not be read: ${reason}.`);
  }
  return { id: "file", name: file.name, dimension: 3, ...loaded };
}

function check({ positions, triangles }: Loaded): void {
  if (positions.length === 0) throw new Error("it holds no vertices");
  if (!positions.every(Number.isFinite)) throw new Error("a coordinate is not a number");
  const count = positions.length / 3;
  if (!triangles.every((v) => v < count)) throw new Error("a face names a vertex that is not there");
}

function readXyz(content: string): Loaded {
  const rows = content.split("\n").map((line) => line.trim()).filter((line) => line !== "" && !line.startsWith("#"));
  const points = rows.map((line) => line.split(/[\s,;]+/).slice(0, 3).map(Number));
  const bad = points.findIndex((p) => p.length < 3 || !p.every(Number.isFinite));
  if (bad >= 0) throw new Error(`"${rows[bad]!.slice(0, 40)}" is not a point`);
  return { positions: Float32Array.from(points.flat()), triangles: new Uint32Array(0) };
}

/** Linear values of a geometry's colours as sRGB bytes. */
function toBytes(linear: Color, out: Uint8Array, v: number): void {
  const { r, g, b } = linear.clone().convertLinearToSRGB();
  out.set([r, g, b].map((x) => Math.round(255 * Math.min(1, Math.max(0, x)))), 3 * v);
}

type Attribute = BufferAttribute | InterleavedBufferAttribute;

function fromGeometry(geometry: BufferGeometry): Loaded {
  const position = geometry.getAttribute("position") as Attribute | undefined;
  const color = geometry.getAttribute("color") as Attribute | undefined;
  const count = position?.count ?? 0;
  const positions = new Float32Array(3 * count);
  const colors = color && new Uint8Array(3 * count);
  for (let v = 0; v < count; v++) {
    positions.set([position!.getX(v), position!.getY(v), position!.getZ(v)], 3 * v);
    if (colors) toBytes(new Color(color.getX(v), color.getY(v), color.getZ(v)), colors, v);
  }
  // A PLY without faces has an empty index or none, and no normals to say that it is a soup.
  const index = geometry.getIndex();
  const soup = !index && geometry.getAttribute("normal") !== undefined && count % 3 === 0;
  const triangles = index ? Uint32Array.from(index.array) : Uint32Array.from({ length: soup ? count : 0 }, (_, i) => i);
  return { positions, triangles, ...(colors ? { colors } : {}) };
}
