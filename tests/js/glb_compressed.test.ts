// Compressed .glb files through the command, made here by the encoders that assets are made with.

import { createRequire } from "node:module";
import { Document, WebIO } from "@gltf-transform/core";
import { EXTMeshoptCompression, KHRDracoMeshCompression, KHRMeshQuantization } from "@gltf-transform/extensions";
import { MeshoptEncoder } from "meshoptimizer";
import { afterAll, describe, expect, it } from "vitest";
import { Folder } from "./support/command.js";
import { sheet } from "./support/shapes.js";

const folder = new Folder();
afterAll(() => folder.remove());
const plain = new WebIO();

const mesh = sheet(9);
const vertices = mesh.positions.length / 3;

/** The smallest and the largest coordinate along an axis. */
const extent = (values: ArrayLike<number>, axis: number) => {
  const along = Array.from(values).filter((_, i) => i % 3 === axis);
  return [Math.min(...along), Math.max(...along)];
};

/** A sheet with normals, half its size and shifted by its node. */
function scene(): Document {
  const made = new Document();
  const buffer = made.createBuffer();
  const accessor = (type: "VEC3" | "SCALAR", values: Float32Array<ArrayBuffer> | Uint16Array<ArrayBuffer>) =>
    made.createAccessor().setType(type).setArray(values).setBuffer(buffer);
  const primitive = made.createPrimitive()
    .setIndices(accessor("SCALAR", Uint16Array.from(mesh.triangles)))
    .setAttribute("POSITION", accessor("VEC3", Float32Array.from(mesh.positions)))
    .setAttribute("NORMAL", accessor("VEC3", Float32Array.from(mesh.positions, (_, i) => Number(i % 3 === 2))));
  const node = made
    .createNode("sheet")
    .setMesh(made.createMesh().addPrimitive(primitive))
    .setScale([0.5, 0.5, 0.5])
    .setTranslation([3, 0, 0]);
  made.createScene().addChild(node);
  return made;
}

async function draco(): Promise<Uint8Array> {
  const encoder = await createRequire(import.meta.url)("draco3dgltf").createEncoderModule();
  const made = scene();
  made
    .createExtension(KHRDracoMeshCompression)
    .setRequired(true)
    .setEncoderOptions({
      method: KHRDracoMeshCompression.EncoderMethod.EDGEBREAKER, quantizationBits: { POSITION: 16 },
    });
  return new WebIO()
    .registerExtensions([KHRDracoMeshCompression])
    .registerDependencies({ "draco3d.encoder": encoder })
    .writeBinary(made);
}

async function meshopt(): Promise<Uint8Array> {
  await MeshoptEncoder.ready;
  const made = scene();
  const [primitive] = made.getRoot().listMeshes()[0].listPrimitives();
  // As gltfpack does: coordinates in 16 bits, of a box that the node brings to its size.
  primitive
    .getAttribute("POSITION")!
    .setArray(Int16Array.from(mesh.positions, (x) => Math.round((32767 * x) / 2)))
    .setNormalized(true);
  made.getRoot().listNodes()[0].setScale([1, 1, 1]);
  made.createExtension(KHRMeshQuantization).setRequired(true);
  made
    .createExtension(EXTMeshoptCompression)
    .setRequired(true)
    .setEncoderOptions({ method: EXTMeshoptCompression.EncoderMethod.FILTER });
  return new WebIO()
    .registerExtensions([KHRMeshQuantization, EXTMeshoptCompression])
    .registerDependencies({ "meshopt.encoder": MeshoptEncoder })
    .writeBinary(made);
}

const script = {
  format: "pliant-edit",
  version: 1,
  steps: [
    {
      method: "embedded-graph",
      options: { nodeCount: 20 },
      handles: [{ select: { all: true }, move: { translate: [1, 2, 3] } }],
    },
  ],
};

describe.each([["draco", draco], ["meshopt", meshopt]])("a .glb compressed by %s", (name, make) => {
  const extension = name === "draco" ? "KHR_draco_mesh_compression" : "EXT_meshopt_compression";

  it("is read", async () => {
    const bytes = await make();
    expect(new TextDecoder().decode(bytes)).toContain(extension);
    folder.write("in.glb", bytes);
    const found = JSON.parse(folder.run("inspect", "in.glb", "--json").out);
    expect(found).toMatchObject({ vertices, triangles: mesh.triangles.length / 3, components: 1 });
    for (const axis of [0, 1, 2]) {
      const [least, most] = extent(mesh.positions, axis).map((x) => x / 2 + [3, 0, 0][axis]);
      expect(found.min[axis]).toBeCloseTo(least, 4);
      expect(found.max[axis]).toBeCloseTo(most, 4);
    }
  });

  it("is deformed into a file that every reader takes", async () => {
    folder.write("in.glb", await make());
    folder.write("edit.json", script);
    expect(folder.run("deform", "in.glb", "--script", "edit.json", "--out", "out.glb")).toEqual({
      status: 0, out: "", err: "",
    });
    const bytes = folder.bytes("out.glb");
    expect(new TextDecoder().decode(bytes)).not.toContain(extension);
    const after = await plain.registerExtensions([KHRMeshQuantization]).readBinary(bytes as Uint8Array<ArrayBuffer>);
    const [primitive] = after.getRoot().listMeshes()[0].listPrimitives();
    const moved = primitive.getAttribute("POSITION")!.getArray()!;
    expect(moved).toBeInstanceOf(Float32Array);
    expect(moved).toHaveLength(3 * vertices);
    const scale = after.getRoot().listNodes()[0].getScale()[0];
    for (const axis of [0, 1, 2]) {
      const expected = extent(mesh.positions, axis).map((x) => x / 2 + axis + 1);
      extent(moved, axis).forEach((x, i) => expect(scale * x).toBeCloseTo(expected[i], 3));
    }
  });

  it("that is garbage is refused, and leaves no file", async () => {
    const broken = (await make()).slice();
    broken.fill(0xa5, broken.length - 200);
    folder.write("broken.glb", broken);
    folder.write("edit.json", script);
    const { status, err } = folder.run("deform", "broken.glb", "--script", "edit.json", "--out", "none.glb");
    expect(status).toBe(2);
    expect(err).toMatch(/^pliant: broken\.glb: .*\n$/);
    expect(folder.list()).not.toContain("none.glb");
  });
});
