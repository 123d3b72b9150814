// Files in and out: what is exported is what is on the screen, what is dropped is read or refused in words.
import { NodeIO } from "@gltf-transform/core";
import { beforeEach, expect, test } from "vitest";
import { farthest } from "./support/browser.ts";
import { drop, exported, shows } from "./support/files.ts";
import { replay } from "./support/replay.ts";
import { ask, demo, rest, useVisits, visit } from "./support/visit.ts";

useVisits();
beforeEach(async () => {
  await visit("from a file", { tool: "pose" });
});

const notice = () => demo.page.locator("#notice span").innerText();
const shape = () => ask((hook) => hook.shape());
/** Bends the creature: two drags under one grab, and a handle placed before them. */
async function bend(): Promise<void> {
  const handle = await demo.handle();
  await demo.drag(handle, { x: handle.x + 30, y: handle.y - 60 }, { x: handle.x + 50, y: handle.y - 110 });
  await demo.drag(await demo.handle(), { x: handle.x - 30, y: handle.y - 80 });
}

/** The coordinates of an OBJ, in single precision, as the screen has them. */
const vertexLines = (text: string) =>
  text
    .split("\n")
    .filter((line) => line.startsWith("v "))
    .flatMap((line) =>
      line
        .split(" ")
        .slice(1, 4)
        .map((x) => Math.fround(Number(x))),
    );

test("OBJ and GLB hold the bent shape", async () => {
  await bend();
  const [positions, { vertices, triangles, diagonal }] = [await demo.positions(), await shape()];

  const obj = await exported("obj");
  expect(obj.name).toBe("creature-bent.obj");
  const text = obj.bytes.toString();
  expect(vertexLines(text)).toEqual(positions);
  expect(text.split("\n").filter((line) => line.startsWith("f "))).toHaveLength(triangles);

  const glb = await exported("glb");
  expect(glb.name).toBe("creature-bent.glb");
  const primitive = (await new NodeIO().readBinary(new Uint8Array(glb.bytes)))
    .getRoot()
    .listMeshes()[0]!
    .listPrimitives()[0]!;
  expect(farthest(primitive.getAttribute("POSITION")!.getArray()!, positions)).toBeLessThan(1e-6 * diagonal);
  expect(primitive.getAttribute("NORMAL")!.getCount()).toBe(vertices);
  expect(primitive.getAttribute("COLOR_0")!.getCount()).toBe(vertices);
  expect(primitive.getIndices()!.getCount()).toBe(3 * triangles);
});

test("a picture exports with its texture, points without faces", async () => {
  await demo.choose("gingerbread");
  const glb = (await new NodeIO().readBinary(new Uint8Array((await exported("glb")).bytes))).getRoot();
  expect(glb.listTextures()[0]!.getSize()).toEqual([640, 768]);
  expect(glb.listMeshes()[0]!.listPrimitives()[0]!.getAttribute("TEXCOORD_0")!.getCount()).toBe(
    (await shape()).vertices,
  );
  expect((await exported("obj")).bytes.toString()).toMatch(/\nvt .*\nf \d+\/\d+ /);

  await demo.choose("tree");
  const points = (await new NodeIO().readBinary(new Uint8Array((await exported("glb")).bytes))).getRoot();
  expect(points.listMeshes()[0]!.listPrimitives()[0]!.getMode()).toBe(0);
  expect((await exported("obj")).bytes.toString()).not.toContain("\nf ");
});

test("the exported script bends the rest shape to the same pose with the package", async () => {
  await bend();
  const { name, bytes } = await exported("script");
  expect(name).toBe("creature-edit.json");
  const script = JSON.parse(bytes.toString());
  expect(script).toMatchObject({ format: "pliant-edit", version: 1 });
  expect(script.steps[0].drag.length).toBeGreaterThan(1);

  const [before, positions, { diagonal }] = [await rest(), await demo.positions(), await shape()];
  const obj = (await exported("obj")).bytes.toString();
  const triangles = obj
    .split("\n")
    .filter((line) => line.startsWith("f "))
    .flatMap((line) =>
      line
        .split(" ")
        .slice(1)
        .map((c) => parseInt(c, 10) - 1),
    );
  expect(farthest(before, positions)).toBeGreaterThan(0.1 * diagonal);
  expect(farthest((await replay(script, before, triangles)).positions, positions)).toBeLessThan(1e-6 * diagonal);
});

/** A sheet of 12 x 12 quads with all that an OBJ may hold beside coordinates. */
function quadSheet(): string {
  const lines = ["# a sheet", "mtllib nothing.mtl", "o sheet"];
  for (let i = 0; i < 169; i++) {
    lines.push(`v ${(i % 13) / 12} ${Math.floor(i / 13) / 12} ${0.1 * Math.sin(i % 13)} 0.5 0.25 1`);
  }
  lines.push("vt 0 0", "vt 1 1", "vn 0 0 1", "usemtl red");
  for (let i = 0; i < 144; i++) {
    const a = 13 * Math.floor(i / 12) + (i % 12) + 1;
    lines.push(`f ${a}/1/1 ${a + 1}/2/1 ${a + 14}/1/1 ${a + 13}/2/1`);
  }
  lines.push("g end", "s off", "f -1 -2 -14", "");
  return lines.join("\n");
}

test("a dropped OBJ keeps its vertex order, and its export everything but the coordinates", async () => {
  const text = quadSheet();
  await drop("my sheet.obj", text);
  await shows("my sheet.obj");
  await demo.idle();
  expect(await shape()).toMatchObject({ name: "my sheet.obj", vertices: 169, triangles: 289 });
  expect(await rest()).toEqual(vertexLines(text));
  await demo.page.keyboard.press("3");
  const near = await demo.page.evaluate(() => window.pliantDemo.vertexAt(13 * 11 + 6));
  await demo.drag(near, { x: near.x + 20, y: near.y - 60 });
  const { name, bytes } = await exported("obj");
  expect(name).toBe("my sheet-bent.obj");
  // Normals belong to the old shape: they are left out.
  const other = (content: string) =>
    content.split("\n").map((line) => (line.startsWith("v ") ? line.split(" ").slice(4) : line));
  expect(other(bytes.toString())).toEqual(other(text.replace("vn 0 0 1\n", "").replace(/(\d\/\d)\/1/g, "$1")));
  expect(vertexLines(bytes.toString())).toEqual(await demo.positions());
  expect(farthest(vertexLines(bytes.toString()), vertexLines(text))).toBeGreaterThan(0.05);
});

test("a dropped picture becomes a shape in pixels that bends in its plane", async () => {
  const transfer = await demo.page.evaluateHandle(async () => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [80, 40];
    canvas.getContext("2d")!.fillRect(0, 0, 40, 40); // the right half stays transparent
    const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve));
    const data = new DataTransfer();
    data.items.add(new File([blob!], "half.png"));
    return data;
  });
  await demo.page.dispatchEvent("body", "drop", { dataTransfer: transfer });
  await shows("half.png");
  const before = await rest();
  expect(Math.max(...before)).toBeLessThan(42); // the half that shows nothing is left out
  expect(Math.max(...before)).toBeGreaterThan(40);
  await demo.page.keyboard.press("3");
  const middle = await demo.page.evaluate(() => window.pliantDemo.project([20, 20, 0]));
  await demo.drag(middle, { x: middle.x + 40, y: middle.y - 20 });
  const now = await demo.positions();
  expect(farthest(before, now)).toBeGreaterThan(2);
  expect(now.every((x, i) => i % 3 !== 2 || x === 0)).toBe(true);
});

test("other formats open as well", async () => {
  await demo.choose("plane");
  const glb = (await exported("glb")).bytes;
  const { vertices } = await shape();
  await demo.page.locator("#file").setInputFiles({ name: "sheet.glb", mimeType: "model/gltf-binary", buffer: glb });
  await shows("sheet.glb");
  expect((await shape()).vertices).toBe(vertices);

  await drop("dots.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n");
  await shows("dots.xyz");
  expect(await shape()).toMatchObject({ vertices: 5, triangles: 0 });

  await drop(
    "tetra.ply",
    `ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4
property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n`,
  );
  await shows("tetra.ply");
  expect(await shape()).toMatchObject({ vertices: 4, triangles: 4 });

  await drop(
    "one.stl",
    "solid a\nfacet normal 0 0 1\nouter loop\n" +
      "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
  );
  await shows("one.stl");
  expect(await shape()).toMatchObject({ vertices: 3, triangles: 1 });
  await demo.idle();
});

test.each([
  ["notes.txt", "hello", /notes\.txt: this kind of file is not known here\. Known are \.obj/],
  ["empty.obj", "# nothing\n", /empty\.obj could not be read: the file has no vertices\.$/],
  ["broken.obj", "v 0 0 0\nv 1 0 zero\n",
    /broken\.obj could not be read: line 2: z is "zero"; expected a finite decimal number/],
  ["faces.obj", "v 0 0 0\nf 1 2 3\n", /faces\.obj could not be read: line 2: face refers to vertex 3/],
  ["thing.glb", "not a glb at all, but long enough", /thing\.glb could not be read: not a readable \.glb/],
  ["bad.ply", "ply\nformat ascii 1.0\n", /bad\.ply could not be read/],
  ["bad.png", "no picture", /bad\.png could not be read: it is not a picture/],
  ["words.xyz", "1 2 three\n", /words\.xyz could not be read: line 1: z is "three"/],
])("a bad file says so: %s", async (name, content, message) => {
  const before = await demo.positions();
  await drop(name, content);
  await demo.page.locator("#notice").waitFor({ state: "visible" });
  expect(await notice()).toMatch(message);
  expect(await shape()).toMatchObject({ id: "creature" });
  // Nothing is half changed: the creature still bends.
  const handle = await demo.handle();
  await demo.drag(handle, { x: handle.x, y: handle.y - 50 });
  expect(farthest(before, await demo.positions(), handle.vertices)).toBeGreaterThan(0.01);
});

test("a large file is read in the worker, with a percentage, and can be stopped", async () => {
  const lines = Array.from({ length: 120_000 }, (_, v) => `v ${v % 400} ${Math.floor(v / 400)} ${Math.sin(v / 50)}`);
  const buffer = Buffer.from(lines.join("\n"));
  await demo.page.evaluate(() => {
    // Nothing on the page's own thread looks into the file (streams unpack the reader's WASM).
    for (const name of ["text", "arrayBuffer", "bytes"] as const) {
      Object.assign(Blob.prototype, { [name]: () => Promise.reject(new Error(`${name}() on the page's thread`)) });
    }
    const said: string[] = [];
    Object.assign(window, { said });
    new MutationObserver(() => said.push(document.querySelector("#reading span")!.textContent!))
      .observe(document.querySelector("#reading span")!, { childList: true, characterData: true, subtree: true });
  });
  await demo.page.locator("#file").setInputFiles({ name: "many.obj", mimeType: "text/plain", buffer });
  await shows("many.obj");
  expect((await shape()).vertices).toBe(120_000);
  const said = await demo.page.evaluate(() => (window as unknown as { said: string[] }).said);
  expect(said.length).toBeGreaterThan(2);
  expect(said.every((text) => /^Reading many\.obj: \d+ %$/.test(text))).toBe(true);
  expect(await demo.page.locator("#reading").isHidden()).toBe(true);

  // Stopped as soon as it is under way.
  await demo.page.evaluate(() =>
    new MutationObserver(() => document.querySelector<HTMLElement>("#reading-cancel")!.click()).observe(
      document.querySelector("#reading span")!, { childList: true, characterData: true, subtree: true },
    ),
  );
  await demo.page.locator("#file").setInputFiles({ name: "more.obj", mimeType: "text/plain", buffer });
  await demo.page.waitForFunction(
    () =>
      document.querySelector("#stage")!.getAttribute("aria-busy") === "false" &&
      document.querySelector<HTMLElement>("#reading")!.hidden,
  );
  expect((await shape()).name).toBe("many.obj");
  expect(await demo.page.locator("#notice").isHidden()).toBe(true);
});
