// Binary glTF 2.0: every mesh of the scene, with its place in it, as one shape. Read here rather than
// by three's GLTFLoader, which is a tenth of the whole page.
import { Color, Matrix4, Quaternion, Vector3 } from "three";
import { asCanvas } from "./picture.ts";
import type { Loaded } from "./read_obj.ts";

interface Accessor { bufferView?: number; byteOffset?: number; componentType: number; normalized?: boolean; count: number; type: string; sparse?: object }
interface View { byteOffset?: number; byteLength: number; byteStride?: number }
interface Primitive { attributes: Record<string, number>; indices?: number; material?: number; mode?: number }
interface Node { children?: number[]; mesh?: number; matrix?: number[]; translation?: number[]; rotation?: number[]; scale?: number[] }
interface Material { pbrMetallicRoughness?: { baseColorFactor?: number[]; baseColorTexture?: { index: number } } }
interface Gltf {
  scene?: number; scenes?: { nodes?: number[] }[]; nodes?: Node[]; meshes?: { primitives: Primitive[] }[];
  accessors?: Accessor[]; bufferViews?: View[]; materials?: Material[]; buffers?: { uri?: string }[];
  textures?: { source?: number }[]; images?: { bufferView?: number; mimeType?: string }[]; extensionsRequired?: string[];
}

const componentTypes = {
  5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array,
} as const;
const sizes: Record<string, number> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
/** Extensions that change nothing this reader reads. */
const harmless = /^KHR_(mesh_quantization|materials_|texture_transform|lights_)/;

class Container {
  readonly json: Gltf;
  private readonly binary: DataView;

  constructor(bytes: ArrayBuffer) {
    const view = new DataView(bytes);
    if (bytes.byteLength < 20 || view.getUint32(0, true) !== 0x46546c67) throw new Error("it is not a binary glTF file");
    if (view.getUint32(4, true) !== 2) throw new Error(`it is glTF version ${view.getUint32(4, true)}, not 2`);
    const length = view.getUint32(12, true);
    this.json = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 20, length))) as Gltf;
    const start = 20 + length + 8;
    this.binary = start <= bytes.byteLength ? new DataView(bytes, start) : new DataView(bytes, 0, 0);
    const strange = this.json.extensionsRequired?.find((name) => !harmless.test(name));
    if (strange) throw new Error(`it needs the extension ${strange}, which is not known here`);
    if (this.json.buffers?.some((b) => b.uri !== undefined)) throw new Error("it keeps its data in other files");
  }

  bytes(index: number): Uint8Array<ArrayBuffer> {
    const { byteOffset = 0, byteLength } = this.view(index);
    return new Uint8Array(this.binary.buffer as ArrayBuffer, this.binary.byteOffset + byteOffset, byteLength);
  }

  private view(index: number): View {
    const view = this.json.bufferViews?.[index];
    if (!view) throw new Error(`it names buffer view ${index}, which is not there`);
    return view;
  }

  /** `width` numbers an element; normalised integers as the fractions they stand for. */
  read(index: number, width: number): { data: Float64Array; count: number } {
    const accessor = this.json.accessors?.[index];
    const Type = componentTypes[accessor?.componentType as keyof typeof componentTypes];
    if (!accessor || !Type || accessor.bufferView === undefined || accessor.sparse) throw new Error(`its accessor ${index} is of a kind that is not known here`);
    const own = sizes[accessor.type] ?? 1;
    const view = this.view(accessor.bufferView);
    const stride = view.byteStride ?? own * Type.BYTES_PER_ELEMENT;
    const start = (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
    const get = this.getter(Type.BYTES_PER_ELEMENT, accessor);
    const data = new Float64Array(width * accessor.count).fill(1);
    for (let i = 0; i < accessor.count; i++) {
      for (let k = 0; k < Math.min(width, own); k++) data[width * i + k] = get(start + i * stride + k * Type.BYTES_PER_ELEMENT);
    }
    return { data, count: accessor.count };
  }

  private getter(bytes: number, { componentType, normalized }: Accessor): (at: number) => number {
    const { binary } = this;
    if (componentType === 5126) return (at) => binary.getFloat32(at, true);
    const signed = componentType === 5120 || componentType === 5122;
    const name = `get${signed ? "Int" : "Uint"}${8 * bytes}` as "getUint16";
    const scale = normalized ? 1 / (2 ** (8 * bytes - (signed ? 1 : 0)) - 1) : 1;
    return (at) => Math.max(binary[name](at, true) * scale, normalized ? -1 : -Infinity);
  }
}

const localMatrix = ({ matrix, translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] }: Node): Matrix4 =>
  matrix
    ? new Matrix4().fromArray(matrix)
    : new Matrix4().compose(new Vector3(...translation), new Quaternion(...rotation), new Vector3(...scale));

/** The primitives of the scene with their matrices, in the order of the nodes. */
function* placed({ json }: Container): Generator<{ primitive: Primitive; matrix: Matrix4 }> {
  const stack = (json.scenes?.[json.scene ?? 0]?.nodes ?? []).map((id) => ({ id, parent: new Matrix4() })).reverse();
  for (let left = 100_000; stack.length > 0 && left > 0; left--) { // a cycle is not glTF, but must not hang
    const { id, parent } = stack.pop()!;
    const node = json.nodes?.[id];
    if (!node) throw new Error(`it names node ${id}, which is not there`);
    const matrix = parent.clone().multiply(localMatrix(node));
    const primitives = node.mesh === undefined ? [] : (json.meshes?.[node.mesh]?.primitives ?? []);
    for (const primitive of primitives) yield { primitive, matrix };
    stack.push(...(node.children ?? []).map((child) => ({ id: child, parent: matrix })).reverse());
  }
}

/** Triangles of a list, strip or fan; none for points and lines. */
function triangleList(mode: number, ids: ArrayLike<number>): number[] {
  const out: number[] = [];
  const count = mode === 4 ? Math.floor(ids.length / 3) : Math.max(0, ids.length - 2);
  for (let t = 0; t < count; t++) {
    if (mode === 4) out.push(ids[3 * t]!, ids[3 * t + 1]!, ids[3 * t + 2]!);
    else if (mode === 5) out.push(ids[t]!, ids[t + 1 + (t % 2)]!, ids[t + 2 - (t % 2)]!);
    else if (mode === 6) out.push(ids[0]!, ids[t + 1]!, ids[t + 2]!);
  }
  return out;
}

/** sRGB bytes of a part: its own colours times the material's. */
function colorsOf(file: Container, { attributes, material }: Primitive, count: number): Uint8Array {
  const factor = file.json.materials?.[material ?? -1]?.pbrMetallicRoughness?.baseColorFactor ?? [1, 1, 1];
  const own = attributes["COLOR_0"] === undefined ? undefined : file.read(attributes["COLOR_0"], 3).data;
  const out = new Uint8Array(3 * count);
  for (let v = 0; v < count; v++) {
    const at = (k: number) => (own?.[3 * v + k] ?? 0.78) * factor[k]!;
    const { r, g, b } = new Color(at(0), at(1), at(2)).convertLinearToSRGB();
    out.set([r, g, b].map((x) => Math.round(255 * Math.min(1, Math.max(0, x)))), 3 * v);
  }
  return out;
}

/** The texture of a single mesh. */
async function pictureOf(file: Container, { attributes, material }: Primitive): Promise<Loaded["picture"]> {
  const index = file.json.materials?.[material ?? -1]?.pbrMetallicRoughness?.baseColorTexture?.index;
  const image = file.json.images?.[file.json.textures?.[index ?? -1]?.source ?? -1];
  if (image?.bufferView === undefined || attributes["TEXCOORD_0"] === undefined) return undefined;
  const { data } = file.read(attributes["TEXCOORD_0"], 2);
  const bitmap = await createImageBitmap(new Blob([file.bytes(image.bufferView)], { type: image.mimeType ?? "" }));
  return { image: asCanvas(bitmap, bitmap.width, bitmap.height), uv: Float32Array.from(data, (x, i) => (i % 2 ? 1 - x : x)) }; // glTF counts v downwards
}

/** Errors: a sentence for the visitor. */
export async function readGlb(bytes: ArrayBuffer): Promise<Loaded> {
  const file = new Container(bytes);
  const [positions, triangles, colors]: [number[], number[], number[]] = [[], [], []];
  const parts = [...placed(file)];
  for (const { primitive, matrix } of parts) {
    if (primitive.attributes["POSITION"] === undefined) throw new Error("it has a part without positions");
    const { data, count } = file.read(primitive.attributes["POSITION"], 3);
    const first = positions.length / 3;
    const point = new Vector3();
    for (let v = 0; v < count; v++) {
      const { x, y, z } = point.fromArray(data, 3 * v).applyMatrix4(matrix);
      positions.push(x, y, z);
    }
    const ids = primitive.indices === undefined ? Uint32Array.from({ length: count }, (_, v) => v) : file.read(primitive.indices, 1).data;
    for (const v of triangleList(primitive.mode ?? 4, ids)) triangles.push(v + first);
    for (const c of colorsOf(file, primitive, count)) colors.push(c);
  }
  const picture = parts.length === 1 ? await pictureOf(file, parts[0]!.primitive) : undefined;
  return {
    positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles),
    ...(picture ? { picture } : { colors: Uint8Array.from(colors) }),
  };
}
