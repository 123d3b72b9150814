// pliant/io: files in and out as plain data, the same on the page's thread, in the worker and in Node.

import { afterAll, describe, expect, it } from "vitest";
import { entries, errorOf, pliant } from "./support/package.js";

const { io } = entries;
const encode = (text: string) => new TextEncoder().encode(text);
const decode = (bytes: Uint8Array) => new TextDecoder().decode(bytes);

/** A concave pentagon and a triangle, with colours, texture coordinates and what else an OBJ may hold. */
const arrow = `# an arrow
mtllib nothing.mtl
v 0 0 0 1 0 0
v 4 0 0 0 1 0
v 4 4 0.125 0 0 1
v 2 1 0 0.2 0.4 0.6
v 0 4 0 1 1 1
vt 0 0
vt 1 0.25
vn 0 0 1
usemtl red
f 1/1/1 2/2/1 3/1/1 4/2/1 5/1/1
f 1/1 4/1 2/2
`;

const worker = await entries.worker.init();
afterAll(() => worker.dispose());
const places = [["here", io], ["in the worker", worker]] as const;

describe.each(places)("%s", (_, files) => {
  it("reads what a file holds: polygons as they are and as triangles, texture coordinates, colours", async () => {
    const file = await files.read(encode(arrow), "arrow.OBJ");
    expect(file).toMatchObject({ format: "obj", dimension: 3 });
    expect(Array.from(file.positions).slice(6, 12)).toEqual([4, 4, 0.125, 2, 1, 0]);
    expect([...file.faceVertices]).toEqual([0, 1, 2, 3, 4, 0, 3, 1]);
    expect([...file.faceOffsets]).toEqual([0, 5, 8]);
    expect([...file.texcoords].slice(0, 4)).toEqual([0, 0, 1, 0.25]);
    expect([...file.colors]).toEqual([255, 0, 0, 0, 255, 0, 0, 0, 255, 51, 102, 153, 255, 255, 255]);
    // No triangle crosses the notch at vertex 3.
    expect(file.triangles).toHaveLength(12);
    expect([...file.triangles.subarray(0, 9)].filter((v) => v === 3).length).toBeGreaterThan(1);
  });

  it("writes the same file with other coordinates, and every other byte as it was", async () => {
    const file = await files.read(new Blob([arrow]), "arrow.obj");
    const moved = decode(await files.write({ ...file, positions: file.positions.map((x) => x + 0.5) }, "bent.obj"));
    expect(moved).toBe(arrow.replace("vn 0 0 1\n", "").replaceAll("/1/1", "/1").replaceAll("/2/1", "/2")
      .replace(/^v (\S+) (\S+) (\S+)/gm, (_, ...xyz) => `v ${xyz.slice(0, 3).map((x) => Number(x) + 0.5).join(" ")}`));
  });

  it.each(["ply", "off", "glb"])("keeps colours and what else there is room for as .%s", async (format) => {
    const file = await files.read(encode(arrow), "arrow.obj");
    const back = await files.read(await files.write(file, `arrow.${format}`), `arrow.${format}`);
    expect(back.triangles.length).toBe(12);
    if (format === "glb") expect(back.texcoords.length).toBe(24);
    else expect([...back.faceOffsets]).toEqual([0, 5, 8]);
    const colorAt = (x: number, y: number) => {
      const v = Array.from({ length: back.positions.length / 3 }, (_, i) => i).find(
        (i) => back.positions[3 * i] === x && back.positions[3 * i + 1] === y,
      )!;
      return [...back.colors.subarray(3 * v, 3 * v + 3)];
    };
    expect([colorAt(4, 0), colorAt(2, 1)]).toEqual([[0, 255, 0], [51, 102, 153]]);
  });

  it.each([
    ["notes.txt", "hello",
      "invalid-option", /name is "notes.txt"; expected a name that ends in \.obj \.ply \.off \.stl \.xyz \.glb/],
    ["empty.obj", "# nothing\n", "parse-error", /^empty.obj: the file has no vertices$/],
    ["broken.obj", "v 0 0 0\nv 1 0 zero\n",
      "parse-error", /^broken.obj: line 2: z is "zero"; expected a finite decimal number$/],
    ["thing.glb", "not a glb at all, but long enough", "parse-error", /^thing.glb: not a readable .glb/],
  ])("says what is wrong with %s", async (name, text, code, message) => {
    const error = await errorOf(() => files.read(encode(text), name));
    expect(error).toMatchObject({ code, message: expect.stringMatching(message) });
  });

  it.each([
    ["no positions", { positions: [] }, /positions is empty/],
    ["a vertex that is not there", { positions: [0, 0, 0], triangles: [0, 0, 1] }, /triangles\[2\] is 1/],
    ["an unknown key", { positions: [0, 0, 0], faces: [] }, /faces is not a known key/],
    ["a polygon of two", { positions: [0, 0, 0], faceVertices: [0, 0], faceOffsets: [0, 2] }, /faceOffsets\[1\] is 2/],
    ["too few colours", { positions: [0, 0, 0], colors: [1] }, /colors is an array of length 1; expected 3 numbers/],
  ])("refuses to write %s", async (_, shape, message) => {
    expect(await errorOf(() => files.write(shape as never, "a.ply"))).toMatchObject({
      code: "invalid-shape", message: expect.stringMatching(message),
    });
  });

  it("refuses another number of vertices than the file has", async () => {
    for (const name of ["a.obj", "a.glb"]) {
      const source = await files.read(
        await files.write({ positions: new Float64Array(9), triangles: Uint32Array.of(0, 1, 2) }, name), name,
      );
      expect(
        await errorOf(() =>
          files.write(
            { ...source, triangles: [], faceVertices: [], faceOffsets: [], positions: new Float64Array(6) } as never,
            name,
          ),
        ),
      ).toMatchObject({
        code: "invalid-shape", message: expect.stringMatching(/positions has 2 vertices; expected 3/),
      });
    }
  });

  it("tells how far it is, and stops when it is told to", async () => {
    const lines = Array.from({ length: 400_000 }, (_, v) => `v ${v} 0.5 1e-3`).join("\n");
    const told: number[] = [];
    const file = await files.read(encode(lines), "points.obj", { onProgress: ({ fraction }) => told.push(fraction) });
    expect(file.positions).toHaveLength(1_200_000);
    expect(told.length).toBeGreaterThan(2);
    expect(told).toEqual(told.toSorted((a, b) => a - b));
    expect(told.every((fraction) => fraction >= 0 && fraction < 1)).toBe(true);
    const controller = new AbortController();
    const stopped = files.read(encode(lines), "points.obj", {
      signal: controller.signal, onProgress: () => controller.abort(),
    });
    expect(await errorOf(() => stopped)).toMatchObject({ code: "aborted" });
    expect((await files.read(encode("v 1 2 3\n"), "one.obj")).positions).toHaveLength(3);
  });
});

it("a file passes as a shape", async () => {
  const file = await io.read(encode(arrow), "arrow.obj");
  expect(pliant.shape(file).report).toMatchObject({ vertices: 5, triangles: 4 });
  expect((await worker.shape(file)).report).toMatchObject({ vertices: 5, triangles: 4 });
});

it("a picture on a .glb comes along, and goes with the shape into another", async () => {
  const png = Uint8Array.from(
    atob("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="),
    (c) => c.charCodeAt(0),
  );
  const square = {
    positions: Float32Array.of(0, 0, 1, 0, 1, 1),
    dimension: 2 as const,
    triangles: Uint32Array.of(0, 1, 2),
    texcoords: Float64Array.of(0, 0, 1, 0, 1, 1),
  };
  const glb = await io.write({ ...square, texture: new Blob([png], { type: "image/png" }) }, "picture.glb");
  const file = await io.read(glb, "picture.glb");
  expect(file.texture?.type).toBe("image/png");
  expect(new Uint8Array(await file.texture!.arrayBuffer())).toEqual(png);
  expect([...file.texcoords]).toEqual([0, 0, 1, 0, 1, 1]);
});
