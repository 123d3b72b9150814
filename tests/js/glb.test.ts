// .glb through the command: scenes with transforms, instances, materials and texture coordinates.

import { Document, WebIO } from "@gltf-transform/core";
import { afterAll, describe, expect, it } from "vitest";
import { Folder } from "./support/command.js";
import { barObj, sheet } from "./support/shapes.js";

const folder = new Folder();
afterAll(() => folder.remove());
const io = new WebIO();

/** Moves everything by one vector: the answer is known in every coordinate system. */
const shift = (by: number[]) => ({
  format: "pliant-edit",
  version: 1,
  steps: [
    {
      method: "embedded-graph",
      options: { nodeCount: 20 },
      handles: [{ select: { all: true }, move: { translate: by } }],
    },
  ],
});

/**
 * Two instances of a textured sheet, one turned, doubled and shifted, and a triangle beside them in its own primitive.
 */
async function scene(): Promise<Uint8Array> {
  const document = new Document();
  const buffer = document.createBuffer();
  const { positions, triangles } = sheet(6);
  const accessor = (
    type: "VEC2" | "VEC3" | "VEC4" | "SCALAR", values: Float32Array<ArrayBuffer> | Uint16Array<ArrayBuffer>,
  ) => document.createAccessor().setType(type).setArray(values).setBuffer(buffer);
  const vertices = positions.length / 3;
  const material = document.createMaterial("paint").setBaseColorFactor([1, 0, 0, 1]);
  const primitive = document.createPrimitive().setMaterial(material)
    .setIndices(accessor("SCALAR", Uint16Array.from(triangles)))
    .setAttribute("POSITION", accessor("VEC3", Float32Array.from(positions)))
    .setAttribute(
      "NORMAL", accessor("VEC3", Float32Array.from({ length: 3 * vertices }, (_, i) => Number(i % 3 === 2))),
    )
    .setAttribute(
      "TANGENT", accessor("VEC4", Float32Array.from({ length: 4 * vertices }, (_, i) => Number(i % 4 === 0))),
    )
    .setAttribute(
      "TEXCOORD_0",
      accessor("VEC2", Float32Array.from({ length: 2 * vertices }, (_, i) => positions[3 * (i >> 1) + (i & 1)])),
    );
  const plain = document
    .createPrimitive()
    .setAttribute("POSITION", accessor("VEC3", Float32Array.of(0, 0, 3, 1, 0, 3, 0, 1, 3)));
  const mesh = document.createMesh("sheet").addPrimitive(primitive).addPrimitive(plain);
  const turned = document
    .createNode("turned")
    .setTranslation([5, 0, 0])
    .setRotation([0, 0, Math.SQRT1_2, Math.SQRT1_2])
    .setScale([2, 2, 2])
    .setMesh(mesh);
  document
    .createScene()
    .addChild(document.createNode("plain").setMesh(mesh))
    .addChild(document.createNode("parent").addChild(turned).setTranslation([0, 1, 0]));
  return io.writeBinary(document);
}

async function deformed(script: object): Promise<{ before: Document; after: Document }> {
  const bytes = await scene();
  folder.write("scene.glb", bytes);
  folder.write("edit.json", script);
  expect(folder.run("deform", "scene.glb", "--script", "edit.json", "--out", "moved.glb")).toEqual({
    status: 0, out: "", err: "",
  });
  return { before: await io.readBinary(bytes), after: await io.readBinary(folder.bytes("moved.glb")) };
}

const node = (document: Document, name: string) =>
  document
    .getRoot()
    .listNodes()
    .find((found) => found.getName() === name)!;
const attribute = (document: Document, name: string, primitive: number, semantic: string) =>
  Array.from<number>(node(document, name).getMesh()!.listPrimitives()[primitive].getAttribute(semantic)!.getArray()!);

describe("a .glb", () => {
  it("has the vertices of every instance where its node puts it", async () => {
    folder.write("scene.glb", await scene());
    const found = JSON.parse(folder.run("inspect", "scene.glb", "--json").out);
    expect(found).toMatchObject({ vertices: 2 * 39, triangles: 2 * 51, components: 4, textureCoordinates: true });
    expect(found.max[0]).toBeCloseTo(5, 5);
    expect(found.max[1]).toBeCloseTo(3, 3);
    expect(found.max[2]).toBeCloseTo(6, 5);
  });

  it("gets results in the coordinates of each mesh, its nodes as they were", async () => {
    const { before, after } = await deformed(shift([0, 2, 0]));
    for (const name of ["plain", "turned", "parent"]) {
      for (const part of ["getTranslation", "getRotation", "getScale"] as const) {
        expect(node(after, name)[part]()).toEqual(node(before, name)[part]());
      }
    }
    for (const primitive of [0, 1]) {
      // The turned instance: 2 along y of the scene is 1 along x of the mesh.
      for (const [name, by] of [["plain", [0, 2, 0]], ["turned", [1, 0, 0]]] as const) {
        const [a, b] = [before, after].map((document) => attribute(document, name, primitive, "POSITION"));
        expect(b.length).toBe(a.length);
        b.forEach((x, i) => expect(x - a[i]).toBeCloseTo(by[i % 3], 4));
      }
    }
  });

  it("keeps materials, texture coordinates, indices and primitives", async () => {
    const { before, after } = await deformed(shift([0, 2, 0]));
    for (const name of ["plain", "turned"]) {
      const [a, b] = [before, after].map((document) => node(document, name).getMesh()!.listPrimitives());
      expect(b).toHaveLength(2);
      expect(b[0].getMaterial()!.getBaseColorFactor()).toEqual([1, 0, 0, 1]);
      expect(Array.from(b[0].getIndices()!.getArray()!)).toEqual(Array.from(a[0].getIndices()!.getArray()!));
      expect(attribute(after, name, 0, "TEXCOORD_0")).toEqual(attribute(before, name, 0, "TEXCOORD_0"));
      expect(b[0].getAttribute("TANGENT")).toBeNull();
      expect(b[1].getIndices()).toBeNull();
    }
    // Nothing left behind that no primitive uses.
    const used = new Set(
      after
        .getRoot()
        .listMeshes()
        .flatMap((mesh) => mesh.listPrimitives())
        .flatMap((p) => [...p.listAttributes(), p.getIndices()]),
    );
    for (const accessor of after.getRoot().listAccessors()) expect(used).toContain(accessor);
  });

  it("gets normals that follow", async () => {
    const lift = (move: object) => ({
      format: "pliant-edit", version: 1,
      steps: [{ method: "embedded-graph", options: { nodeCount: 20 }, handles: [{ select: { all: true }, move }] }],
    });
    const { after } = await deformed(lift({ rotate: { axis: [1, 0, 0], degrees: 90 } }));
    for (const name of ["plain", "turned"]) {
      const normals = attribute(after, name, 0, "NORMAL");
      // z turned by 90 degrees about x of the scene is -y; in the turned mesh, -x.
      const expected = name === "plain" ? [0, -1, 0] : [-1, 0, 0];
      for (let v = 0; v < 36; ++v) {
        const normal = normals.slice(3 * v, 3 * v + 3);
        expect(Math.hypot(...normal)).toBeCloseTo(1, 5);
        expect(normal.reduce((sum, x, axis) => sum + x * expected[axis], 0)).toBeGreaterThan(0.9);
      }
    }
  });

  it("comes from other formats with seams where texture coordinates differ", async () => {
    folder.write("bar.obj", barObj(6));
    folder.write("edit.json", shift([0, 0, 1]));
    expect(folder.run("deform", "bar.obj", "--script", "edit.json", "--out", "bar.glb").err).toBe("");
    const document = await io.readBinary(folder.bytes("bar.glb"));
    const [primitive] = document.getRoot().listMeshes()[0].listPrimitives();
    expect(primitive.getAttribute("POSITION")!.getCount()).toBe(7 * 5); // the seam twice
    expect(primitive.getAttribute("NORMAL")!.getElement(0, []).some((x) => x !== 0)).toBe(true);
    // And back: the seam is one vertex again to the solver, v is upwards again.
    folder.run("deform", "bar.glb", "--script", "edit.json", "--out", "back.obj");
    const texcoords = (text: string) =>
      new Set(
        text
          .split("\n")
          .filter((line) => line.startsWith("vt "))
          .map((line) =>
            line
              .split(" ")
              .slice(1)
              .map((x) => Number(x).toFixed(5))
              .join(" "),
          ),
      );
    expect(texcoords(folder.text("back.obj"))).toEqual(texcoords(barObj(6)));
  });

  it("shows keyframes as one animation", async () => {
    const steps = (z: number) => shift([0, 0, z]).steps;
    folder.write("bar.obj", barObj(6));
    folder.write("edit.json", {
      format: "pliant-edit",
      version: 1,
      frames: 3,
      keyframes: [{ time: 1, steps: steps(0) }, { time: 2, steps: steps(2) }],
    });
    for (const shape of ["bar.obj", "scene.glb"]) {
      folder.write("scene.glb", await scene());
      expect(folder.run("deform", shape, "--script", "edit.json", "--out", "moving.glb")).toEqual({
        status: 0, out: "", err: "",
      });
      const document = await io.readBinary(folder.bytes("moving.glb"));
      const [animation] = document.getRoot().listAnimations();
      for (const channel of animation.listChannels()) {
        expect(channel.getTargetPath()).toBe("weights");
        expect(Array.from(channel.getSampler()!.getInput()!.getArray()!)).toEqual([0, 0.5, 1]);
        expect(Array.from(channel.getSampler()!.getOutput()!.getArray()!)).toEqual([1, 0, 0, 0, 1, 0, 0, 0, 1]);
        for (const primitive of channel.getTargetNode()!.getMesh()!.listPrimitives()) {
          const targets = primitive
            .listTargets()
            .map((target) => Array.from<number>(target.getAttribute("POSITION")!.getArray()!));
          expect(targets).toHaveLength(3);
          const along = targets.map((values) => values.reduce((sum, x) => sum + x, 0) / (values.length / 3));
          const unit = channel.getTargetNode()!.getName() === "turned" ? 2 : 1;
          [0, 1 / unit, 2 / unit].forEach((z, frame) => expect(along[frame]).toBeCloseTo(z, 3));
        }
      }
    }
  });
});
