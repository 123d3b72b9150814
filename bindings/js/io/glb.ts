// Binary glTF in and out. The vertices are those of every mesh where its node puts it; nodes keep
// their transforms: results go back into the coordinates of each mesh. Normals follow, tangents (which
// viewers compute when they are missing) are dropped, all else in the file stays.

import {
  type Accessor, Document, Logger, type mat4, type Node, Primitive, TextureInfo, WebIO,
} from "@gltf-transform/core";
import { ALL_EXTENSIONS, KHRMaterialsUnlit } from "@gltf-transform/extensions";
import { PliantError } from "../boundary/errors.js";
import { NormalGroups } from "../shape/normals.js";
import { linearColors, srgbColor } from "./colors.js";
import { decodersFor, withoutCompression } from "./compression.js";
import { applyInverse, applyTo, directionBack, directionOut } from "./matrix.js";
import { triangleCorners } from "./refined.js";
import type { Mesh } from "./shape_file.js";

const io = new WebIO().setLogger(new Logger(Logger.Verbosity.SILENT)).registerExtensions(ALL_EXTENSIONS);

/** One POSITION accessor as one node shows it. */
interface Part {
  node: Node;
  primitives: Primitive[];
  accessor: Accessor;
  /** Coordinates of the mesh -> of the scene, column by column. */
  matrix: mat4;
  /** Id of its first vertex. */
  first: number;
}

export class Glb {
  readonly #document: Document;
  readonly #parts: Part[] = [];
  readonly #count: number = 0;

  /** Takes over a document. Errors: parse-error. */
  constructor(document: Document) {
    this.#document = document;
    for (const node of document.getRoot().listNodes()) {
      if (!node.getMesh()) continue;
      separate(node);
      const matrix = node.getSkin() ? identity : node.getWorldMatrix();
      for (const [accessor, primitives] of byPosition(node)) {
        this.#parts.push({ node, primitives, accessor, matrix, first: this.#count });
        this.#count += accessor.getCount();
      }
    }
  }

  /** Errors: parse-error. */
  static async read(bytes: Uint8Array): Promise<Glb> {
    try {
      io.registerDependencies(await decodersFor(bytes));
      return new Glb(withoutCompression(await io.readBinary(bytes as Uint8Array<ArrayBuffer>)));
    } catch (error) {
      throw new PliantError("parse-error", `not a readable .glb: ${(error as Error).message}`, { cause: error });
    }
  }

  get mesh(): Mesh {
    const positions = this.#positions();
    const faceVertices = this.#triangles();
    const faceOffsets = Uint32Array.from({ length: faceVertices.length / 3 + 1 }, (_, i) => 3 * i);
    return {
      positions,
      triangles: faceVertices,
      faceVertices,
      faceOffsets,
      texcoords: this.#texcoords(faceVertices),
      colors: this.#colors(),
    };
  }

  /** The one picture that everything in the scene shows. */
  get texture(): Blob | undefined {
    const primitives = this.#parts.flatMap((part) => part.primitives);
    const [first, ...others] = new Set(primitives.map((primitive) => primitive.getMaterial()?.getBaseColorTexture()));
    const image = first?.getImage();
    if (!image || others.length > 0 || !primitives.every((primitive) => primitive.getAttribute("TEXCOORD_0"))) {
      return undefined;
    }
    return new Blob([image], { type: first!.getMimeType() });
  }

  /** The file with the vertices at these positions. Errors: invalid-option. */
  async write(positions: Float64Array): Promise<Uint8Array<ArrayBuffer>> {
    if (positions.length !== 3 * this.#count) {
      throw new PliantError(
        "invalid-shape",
        `positions has ${positions.length / 3} vertices; expected ${this.#count}, as the file it was read from`,
      );
    }
    const normals = this.#movedNormals(positions);
    const unused = new Set<Accessor>();
    for (const part of this.#parts) {
      const moved = this.#accessor(localPositions(part, positions));
      const lit = part.primitives.filter((primitive) => primitive.getAttribute("NORMAL"));
      for (const primitive of part.primitives) {
        for (const name of ["POSITION", "NORMAL", "TANGENT"]) {
          const old = primitive.getAttribute(name);
          if (old) unused.add(old);
        }
        primitive.setAttribute("POSITION", moved).setAttribute("TANGENT", null);
      }
      if (normals && lit.length > 0) {
        const turned = this.#accessor(localNormals(part, normals));
        for (const primitive of lit) primitive.setAttribute("NORMAL", turned);
      }
    }
    const root = this.#document.getRoot();
    for (const accessor of unused) if (accessor.listParents().every((parent) => parent === root)) accessor.dispose();
    return (await io.writeBinary(this.#document)) as Uint8Array<ArrayBuffer>;
  }

  /** Turns the document into an animation: `frames` one after the other at `times` in seconds. */
  animate(frames: Float64Array[], times: number[]): void {
    const rest = this.#positions();
    const animation = this.#document.createAnimation("pliant");
    const input = this.#scalars(times);
    const output = this.#scalars(times.flatMap((_, i) => times.map((_, j) => Number(i === j))));
    for (const part of this.#parts) {
      const base = localPositions(part, rest);
      for (const frame of frames) {
        const moved = this.#accessor(localPositions(part, frame).map((x, i) => x - base[i]));
        const target = this.#document.createPrimitiveTarget().setAttribute("POSITION", moved);
        for (const primitive of part.primitives) primitive.addTarget(target);
      }
    }
    for (const node of new Set(this.#parts.map((part) => part.node))) {
      const sampler = this.#document.createAnimationSampler().setInput(input).setOutput(output);
      const channel = this.#document
        .createAnimationChannel()
        .setTargetNode(node)
        .setTargetPath("weights")
        .setSampler(sampler);
      animation.addSampler(sampler).addChannel(channel);
      node.getMesh()!.setWeights(times.map(() => 0));
    }
  }

  #positions(): Float64Array {
    return this.#gather((part, i, out) => applyTo(part.matrix, part.accessor.getElement(i, out)));
  }

  /** Three numbers a vertex, in the scene. */
  #gather(read: (part: Part, i: number, out: number[]) => number[]): Float64Array {
    const values = new Float64Array(3 * this.#count);
    for (const part of this.#parts) {
      for (let i = 0; i < part.accessor.getCount(); ++i) values.set(read(part, i, [0, 0, 0]), 3 * (part.first + i));
    }
    return values;
  }

  #triangles(): Uint32Array {
    return Uint32Array.from(
      this.#parts.flatMap(({ primitives, first }) => primitives.flatMap((p) => trianglesOf(p).map((v) => first + v))),
    );
  }

  /** Two a corner, v upwards as everywhere but in glTF; empty where no primitive has any. */
  #texcoords(corners: Uint32Array): Float64Array {
    const ofVertex = new Float64Array(2 * this.#count);
    let any = false;
    for (const { primitives, first } of this.#parts) {
      const accessor = primitives.map((p) => p.getAttribute("TEXCOORD_0")).find((found) => found);
      for (let i = 0; accessor && i < accessor.getCount(); ++i) {
        const [u, v] = accessor.getElement(i, [0, 0]);
        ofVertex.set([u, 1 - v], 2 * (first + i));
        any = true;
      }
    }
    return any
      ? Float64Array.from({ length: 2 * corners.length }, (_, i) => ofVertex[2 * corners[i >> 1] + (i & 1)])
      : new Float64Array(0);
  }

  /** Three bytes a vertex: its own colour times that of its material; empty where all are white. */
  #colors(): Uint8Array {
    const colors = new Uint8Array(3 * this.#count).fill(255);
    let any = false;
    for (const { primitives, first } of this.#parts) {
      for (const primitive of primitives) {
        const own = primitive.getAttribute("COLOR_0");
        const factor = primitive.getMaterial()?.getBaseColorFactor() ?? [1, 1, 1];
        if (!own && factor.slice(0, 3).every((channel) => channel === 1)) continue;
        any = true;
        const color = [1, 1, 1, 1];
        for (const v of idsOf(primitive)) {
          own?.getElement(v, color);
          srgbColor(color, factor, colors, 3 * (first + v));
        }
      }
    }
    return any ? colors : new Uint8Array(0);
  }

  /** Of the whole scene, so that primitives that meet stay smooth; undefined where nothing has normals. */
  #movedNormals(positions: Float64Array): Float32Array | undefined {
    const normalOf = (part: Part) => part.primitives.map((p) => p.getAttribute("NORMAL")).find((found) => found);
    if (!this.#parts.some(normalOf)) return undefined;
    const rest = this.#gather((part, i, out) => directionOut(part.matrix, normalOf(part)?.getElement(i, out) ?? out));
    const normals = Float32Array.from(rest);
    new NormalGroups(this.#positions(), rest, this.#triangles()).compute(positions, normals);
    return normals;
  }

  #accessor(values: Float32Array): Accessor {
    return this.#document
      .createAccessor()
      .setType("VEC3")
      .setArray(values as Float32Array<ArrayBuffer>)
      .setBuffer(this.#buffer());
  }

  #scalars(values: number[]): Accessor {
    return this.#document
      .createAccessor()
      .setType("SCALAR")
      .setArray(Float32Array.from(values))
      .setBuffer(this.#buffer());
  }

  #buffer() {
    return this.#document.getRoot().listBuffers()[0] ?? this.#document.createBuffer();
  }
}

const identity: mat4 = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** Gives a node a mesh of its own, where several show one. */
function separate(node: Node): void {
  const mesh = node.getMesh()!;
  if (mesh.listParents().filter((parent) => parent.propertyType === "Node").length < 2) return;
  const own = mesh.clone();
  for (const primitive of mesh.listPrimitives()) own.removePrimitive(primitive).addPrimitive(primitive.clone());
  node.setMesh(own);
}

function byPosition(node: Node): Map<Accessor, Primitive[]> {
  const groups = new Map<Accessor, Primitive[]>();
  for (const primitive of node.getMesh()!.listPrimitives()) {
    const accessor = primitive.getAttribute("POSITION");
    if (accessor) groups.set(accessor, [...(groups.get(accessor) ?? []), primitive]);
  }
  return groups;
}

/** The vertices of a primitive, as its mode strings them together. */
function idsOf(primitive: Primitive): ArrayLike<number> & Iterable<number> {
  return (
    primitive.getIndices()?.getArray() ??
    Uint32Array.from({ length: primitive.getAttribute("POSITION")!.getCount() }, (_, v) => v)
  );
}

/** Vertex ids, three a triangle; none for points and lines. */
function trianglesOf(primitive: Primitive): number[] {
  const { TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN } = Primitive.Mode;
  const mode = primitive.getMode();
  const ids: number[] = Array.from(idsOf(primitive));
  if (mode === TRIANGLES) return ids.slice(0, ids.length - (ids.length % 3));
  const corners = (i: number) =>
    mode === TRIANGLE_FAN ? [0, i + 1, i + 2] : i % 2 ? [i + 1, i, i + 2] : [i, i + 1, i + 2];
  if (mode !== TRIANGLE_STRIP && mode !== TRIANGLE_FAN) return [];
  return Array.from({ length: Math.max(0, ids.length - 2) }, (_, i) => corners(i).map((corner) => ids[corner])).flat();
}

function localPositions({ matrix, first, accessor, node }: Part, positions: Float64Array): Float32Array {
  const inverse = applyInverse(matrix);
  if (!inverse) {
    throw new PliantError(
      "invalid-shape",
      `node "${node.getName()}" has no size in some direction; expected a transform that can be undone`,
    );
  }
  return perVertex(accessor.getCount(), (i) => inverse(positions.subarray(3 * (first + i), 3 * (first + i) + 3)));
}

function localNormals({ matrix, first, accessor }: Part, normals: Float32Array): Float32Array {
  return perVertex(accessor.getCount(), (i) =>
    directionBack(matrix, normals.subarray(3 * (first + i), 3 * (first + i) + 3)),
  );
}

function perVertex(count: number, value: (i: number) => ArrayLike<number>): Float32Array {
  const values = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) values.set(value(i), 3 * i);
  return values;
}

/** The picture on a mesh. `flat`: in the plane, seen as it is, and transparent where it is. */
interface Skin {
  bytes: Uint8Array<ArrayBuffer>;
  type: string;
  flat: boolean;
}

/** A mesh from another kind of file: vertices are repeated where texture coordinates differ. */
export function glbOf(mesh: Mesh, image?: Skin): { glb: Glb; expand(positions: Float64Array): Float64Array } {
  const document = new Document();
  document.createBuffer();
  const { source, indices, uv } = splitSeams(mesh);
  const expand = (positions: Float64Array) =>
    Float64Array.from({ length: 3 * source.length }, (_, i) => positions[3 * source[Math.floor(i / 3)] + (i % 3)]);
  const accessor = (type: "VEC2" | "VEC3" | "VEC4" | "SCALAR", array: Float32Array | Uint32Array | Uint16Array) =>
    document
      .createAccessor()
      .setType(type)
      .setArray(array as Float32Array<ArrayBuffer>)
      .setBuffer(document.getRoot().listBuffers()[0]);
  const primitive = document
    .createPrimitive()
    .setAttribute("POSITION", accessor("VEC3", Float32Array.from(expand(mesh.positions))));
  if (indices.length > 0)
    primitive
      .setIndices(accessor("SCALAR", indices))
      .setAttribute("NORMAL", accessor("VEC3", new Float32Array(3 * source.length)));
  else primitive.setMode(Primitive.Mode.POINTS);
  if (uv.length > 0) primitive.setAttribute("TEXCOORD_0", accessor("VEC2", uv));
  if (mesh.colors.length > 0) {
    primitive.setAttribute("COLOR_0", accessor("VEC4", linearColors(mesh.colors, source)).setNormalized(true));
  }
  primitive.setMaterial(matte(document, image));
  document
    .createScene()
    .addChild(document.createNode("shape").setMesh(document.createMesh("shape").addPrimitive(primitive)));
  return { glb: new Glb(document), expand };
}

/** Seen from both sides, and not the metal that a file without a material is made of. */
function matte(document: Document, image: Skin | undefined) {
  const material = document.createMaterial().setDoubleSided(true).setMetallicFactor(0).setRoughnessFactor(0.65);
  if (!image) return material;
  material.setBaseColorTexture(document.createTexture("picture").setImage(image.bytes).setMimeType(image.type));
  if (!image.flat) return material;
  const { CLAMP_TO_EDGE } = TextureInfo.WrapMode;
  material.getBaseColorTextureInfo()!.setWrapS(CLAMP_TO_EDGE).setWrapT(CLAMP_TO_EDGE);
  const unlit = document.createExtension(KHRMaterialsUnlit).createUnlit();
  return material.setAlphaMode("BLEND").setExtension("KHR_materials_unlit", unlit);
}

/** One vertex for each vertex and texture coordinate that go together. `source`: the mesh's vertex of each. */
function splitSeams(mesh: Mesh): { source: number[]; indices: Uint32Array; uv: Float32Array } {
  const vertices = mesh.positions.length / 3;
  if (mesh.texcoords.length === 0) {
    return { source: [...Array(vertices).keys()], indices: mesh.triangles, uv: new Float32Array(0) };
  }
  const source: number[] = [];
  const uv: number[] = [];
  const ids = new Map<string, number>();
  const indices = triangleCorners(mesh).map((corner) => {
    const [v, s, t] = [mesh.faceVertices[corner], mesh.texcoords[2 * corner], mesh.texcoords[2 * corner + 1]];
    const key = `${v} ${s} ${t}`;
    const known = ids.get(key);
    if (known !== undefined) return known;
    ids.set(key, source.length);
    source.push(v);
    uv.push(s, 1 - t);
    return source.length - 1;
  });
  return { source, indices, uv: Float32Array.from(uv) };
}

/** Errors: parse-error. */
export async function readGlb(bytes: Uint8Array): Promise<Mesh & { texture?: Blob }> {
  const { mesh, texture } = await Glb.read(bytes);
  return { ...mesh, ...(texture ? { texture } : {}) };
}

/** A file with its vertices at other places. Errors: invalid-shape. */
export async function rewriteGlb(bytes: Uint8Array, positions: Float64Array): Promise<Uint8Array<ArrayBuffer>> {
  return (await Glb.read(bytes)).write(positions);
}

/** A mesh as a file of its own; `flat`: a picture in the plane. */
export async function writeGlb(mesh: Mesh, texture: Blob | undefined, flat: boolean): Promise<Uint8Array<ArrayBuffer>> {
  const { glb, expand } = glbOf(mesh, await skinOf(texture, flat));
  return glb.write(expand(mesh.positions));
}

export async function skinOf(texture: Blob | undefined, flat: boolean): Promise<Skin | undefined> {
  return texture && { bytes: new Uint8Array(await texture.arrayBuffer()), type: texture.type, flat };
}

/**
 * One file that shows positions one after the other, at times in seconds; `bytes`: the .glb the mesh was read from, if
 * it was.
 */
export async function animateGlb(
  mesh: Mesh, bytes: Uint8Array | undefined, skin: Skin | undefined, frames: Float64Array[], times: number[],
): Promise<Uint8Array<ArrayBuffer>> {
  const asRead = (positions: Float64Array) => positions;
  const { glb, expand } = bytes ? { glb: await Glb.read(bytes), expand: asRead } : glbOf(mesh, skin);
  glb.animate(frames.map(expand), times);
  return glb.write(expand(mesh.positions));
}
