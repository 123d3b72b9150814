// Files of any size through a deformation: `rewrite` of pliant/io, transformPoints and transformNormals of a living
// edit, and `pliant deform --carry`.

import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { EditDocument } from "../../bindings/js/index.js";
import { Folder, objPositions } from "./support/command.js";
import { entries, errorOf, pliant } from "./support/package.js";
import { barObj, cloud } from "./support/shapes.js";

const { io } = entries;

const barPositions = objPositions(barObj(24));
const cornersOf = (line: string) => line.slice(2).split(" ").map((corner) => Number(corner.split("/")[0]) - 1);
const quads = barObj(24).split("\n").filter((line) => line.startsWith("f ")).map(cornersOf);
const barTriangles = quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);

type Step = EditDocument["steps"][number];

const bend: Step = {
  method: "embedded-graph", options: { nodeCount: 12 },
  fixed: [{ box: { min: [-1, -1, -1], max: [1, 2, 2] } }],
  handles: [{
    select: { halfSpace: { normal: [1, 0, 0], offset: 7 } },
    move: { rotate: { axis: [0, 0, 1], degrees: 50 }, translate: [-1, 2, 0] },
  }],
};
const raise: Step = {
  ...bend, fixed: [{ vertices: [0, 1, 2, 3] }],
  handles: [{ select: { vertices: [96, 97, 98, 99] }, move: { translate: [0, 1, 0] } }],
};
const placed = (...parts: Extract<Step, { method: "place" }>["parts"]): Step => ({ method: "place", parts });
const right = { halfSpace: { normal: [1, 0, 0], offset: 4 } };
const bytesOf = (text: string) => new TextEncoder().encode(text);
const textOf = (bytes: Uint8Array) => new TextDecoder().decode(bytes);
const lift: Step = {
  method: "place",
  parts: [
    { select: { all: true }, move: { rotate: { axis: [1, 0, 0], degrees: 30 }, scale: 2, translate: [0, 0, 1] } },
  ],
};
const document = (...steps: Step[]): EditDocument => ({ format: "pliant-edit", version: 1, steps });

async function edited(...steps: Step[]) {
  const edit = pliant.open(pliant.shape({ positions: barPositions, triangles: barTriangles }));
  edit.apply(document(...steps));
  await edit.settle();
  return edit;
}

const points = cloud(7).map((x, i) => (i % 3 === 0 ? 8 * x : x));
const unit = (n: ArrayLike<number>, at: number) => {
  const length = Math.hypot(n[at], n[at + 1], n[at + 2]);
  return [n[at] / length, n[at + 1] / length, n[at + 2] / length];
};
const directions = cloud(9).map((x) => x - 0.4);
const normals = points.map((_, i) => unit(directions, i - (i % 3))[i % 3]);

/** One file of every kind, all of the same points. */
const row = (i: number) => `${points[3 * i]} ${points[3 * i + 1]} ${points[3 * i + 2]}`;
const rows = (line: (i: number) => string) => Array.from({ length: points.length / 3 }, (_, i) => line(i));
const plyHeader = (format: string) => [
  "ply", `format ${format} 1.0`, "comment carried along",
  "element vertex 7", "property uchar red", "property double x", "property double y",
  "property float nx", "property float ny", "property float nz", "property double z", "property list uchar short tags",
  "element face 2", "property list uchar int vertex_indices", "property float area", "end_header", "",
].join("\n");

function binaryPly(big: boolean): Uint8Array {
  const bytes: number[] = [...new TextEncoder().encode(plyHeader(big ? "binary_big_endian" : "binary_little_endian"))];
  const put = (size: number, write: (view: DataView) => void) => {
    const view = new DataView(new ArrayBuffer(size));
    write(view);
    bytes.push(...new Uint8Array(view.buffer));
  };
  const double = (x: number) => put(8, (view) => view.setFloat64(0, x, !big));
  const float = (x: number) => put(4, (view) => view.setFloat32(0, x, !big));
  for (let i = 0; i < points.length / 3; ++i) {
    bytes.push(i);
    double(points[3 * i]);
    double(points[3 * i + 1]);
    for (let k = 0; k < 3; ++k) float(normals[3 * i + k]);
    double(points[3 * i + 2]);
    bytes.push(i % 3);
    for (let k = 0; k < i % 3; ++k) put(2, (view) => view.setInt16(0, 300 + k, !big));
  }
  for (const face of [[0, 1, 2], [3, 4, 5, 6]]) {
    bytes.push(face.length);
    for (const id of face) put(4, (view) => view.setInt32(0, id, !big));
    float(0.5);
  }
  bytes.push(...new TextEncoder().encode("behind the elements"));
  return Uint8Array.from(bytes);
}

const asciiPly = plyHeader("ascii") + [
  ...rows((i) => {
    const [x, y, z] = points.subarray(3 * i);
    return `${i} ${x}  ${y} ${normals.subarray(3 * i, 3 * i + 3).join(" ")} ${z} ${i % 3}${" 9".repeat(i % 3)}`;
  }),
  "3 0 1 2 0.5", "4 3 4 5 6 0.5", "",
].join("\n");

const files: Record<string, Uint8Array> = {
  "a.xyz": bytesOf(`# a scan\r\n${rows((i) => ` ${row(i)}\t255 0 ${i} words`).join("\r\n")}\n\n// end`),
  "a.obj": bytesOf([
    "# first", "mtllib m.mtl", ...rows((i) => `v ${row(i)} 0.5 0.25 1 # ${i}`), "vt 0.5 0.5",
    "f 1/1 2/1 \\", " 3/1", "g some  group", "f -1 -2 -3", "",
  ].join("\n")),
  "a.ply": bytesOf(asciiPly),
  "little.ply": binaryPly(false),
  "big.ply": binaryPly(true),
};

function* pieces(file: Uint8Array, size: () => number): Generator<Uint8Array> {
  for (let at = 0; at < file.length; ) {
    const next = at + size();
    yield file.slice(at, next);
    at = next;
  }
}

async function all(stream: AsyncIterable<Uint8Array>): Promise<Uint8Array> {
  const bytes: number[] = [];
  for await (const piece of stream) bytes.push(...piece);
  return Uint8Array.from(bytes);
}

/** A fixed sequence of numbers from 0 to 1. */
function sequence(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 16807) % 2147483647) / 2147483647;
}

const cross = (a: ArrayLike<number>, b: ArrayLike<number>) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

const close = (a: ArrayLike<number>, b: ArrayLike<number>, within: number) => {
  expect(a.length).toBe(b.length);
  for (let i = 0; i < a.length; ++i) expect(Math.abs(a[i] - b[i])).toBeLessThan(within);
};

describe("rewrite", () => {
  const shifted = async (name: string, size: () => number) => {
    const found: number[] = [];
    const turned: number[] = [];
    const stream = io.rewrite(pieces(files[name], size), name, (p, n) => {
      found.push(...p);
      if (n) turned.push(...n);
      p.forEach((_, i) => (p[i] = 2 * p[i] - 1));
      n?.forEach((_, i) => (n[i] = -n[i]));
    });
    return { file: await all(stream), found, turned };
  };

  it.each(Object.keys(files))("gives the same of %s in pieces of any size", async (name) => {
    const whole = await shifted(name, () => 1e9);
    expect(whole.found).toEqual([...points]);
    expect(whole.turned.length).toBe(name.endsWith("ply") ? points.length : 0);
    for (const size of [1, 2, 3, 7, 64]) expect(await shifted(name, () => size)).toEqual(whole);
    for (const seed of [1, 2, 3, 4, 5]) {
      const random = sequence(seed);
      expect(await shifted(name, () => 1 + Math.floor(40 * random() ** 3))).toEqual(whole);
    }
  });

  it.each(Object.keys(files))("keeps all of %s but coordinates and normals", async (name) => {
    const { file } = await shifted(name, () => 11);
    const back = await all(io.rewrite(file, name, (p, n) => {
      p.forEach((_, i) => (p[i] = (p[i] + 1) / 2));
      n?.forEach((_, i) => (n[i] = -n[i]));
    }));
    const same = await all(io.rewrite(files[name], name, () => {}));
    if (["little.ply", "big.ply"].includes(name)) expect(same).toEqual(files[name]); // its numbers are double already
    expect(back.length).toBe(same.length);
    const text = (bytes: Uint8Array) =>
      new TextDecoder("latin1").decode(bytes).replaceAll(/-?\d+(\.\d+)?(e-?\d+)?/g, (x) => Number(x).toPrecision(6));
    expect(text(back)).toBe(text(same));
    if (!name.endsWith(".ply")) expect(text(same)).toBe(text(files[name]));
  });

  it("takes Blobs, streams and functions that take their time", async () => {
    const expected = (await shifted("a.obj", () => 1e9)).file;
    const slow = async (p: Float64Array) => {
      await new Promise((resolve) => setTimeout(resolve));
      p.forEach((_, i) => (p[i] = 2 * p[i] - 1));
    };
    const blob = new Blob([files["a.obj"] as Uint8Array<ArrayBuffer>]);
    for (const source of [blob, blob.stream(), files["a.obj"], await blob.arrayBuffer()]) {
      expect(await all(io.rewrite(source, "a.obj", slow))).toEqual(expected);
    }
  });

  it("leaves out normals that do not say whose they are, and takes numbers that are none for no normal", async () => {
    const copied = async (text: string, name: string) => textOf(await all(io.rewrite(bytesOf(text), name, () => {})));
    const obj = "v 1 2 3\nvn 0 0 1\nv 0 0 1\nv 0 1 0\nf 1//1 2//1 3//1\n";
    expect(await copied(obj, "a.obj")).toBe("v 1 2 3\nv 0 0 1\nv 0 1 0\nf 1 2 3\n");
    const properties = ["x", "y", "z", "nx", "ny", "nz"].map((name) => `property double ${name}\n`);
    const ply = `ply\nformat ascii 1.0\nelement vertex 1\n${properties.join("")}end_header\n1 2 3 nan nan nan\n`;
    expect(await copied(ply, "a.ply")).toBe(ply.replaceAll("nan", "0"));
  });

  it("stops with the line of what is wrong, and goes on with the next file", async () => {
    type Source = Parameters<typeof io.rewrite>[0];
    const leave = (_: Float64Array) => {};
    const says = async (source: Source, name: string, code: string, message: RegExp, move = leave) => {
      const error = await errorOf(() => all(io.rewrite(source, name, move)));
      expect(error).toMatchObject({ code, message: expect.stringMatching(message) });
    };
    const inPieces = (text: string) => pieces(bytesOf(text), () => 5);
    await says(inPieces("1 2 3\n1 2 x\n"), "a.xyz", "parse-error", /^a\.xyz: line 2: z is "x"/);
    await says(inPieces("1 2 3\n\n1 1e31 3\n"), "a.xyz", "parse-error", /^a\.xyz: line 3: .*1e\+31.*1e\+30/);
    await says(inPieces("v 1 2 3\nv 1 2\n"), "a.obj", "parse-error", /^a\.obj: line 2: /);
    await says(inPieces(asciiPly.replace("comment", "commend")), "a.ply", "parse-error", /^a\.ply: line 3: /);
    await says(inPieces("v 1 2 3\nf 1 1 2\nf 1 1 1\n"), "a.obj", "parse-error", /line 2: .* vertex 2; the file has 1/);
    await says(inPieces("v 1 2 3\nf 1 -1 -2\n"), "a.obj", "parse-error", /line 2: .* vertex -2/);
    await says(inPieces("v 1 2 3\nf 1 1 x\n"), "a.obj", "parse-error", /line 2: face corner is "x"/);
    const beyond = asciiPly.replace("4 5 6", "4 5 7");
    await says(inPieces(beyond), "a.ply", "parse-error", /line 25: .* vertex 7; the file has 7/);
    const faceless = files["little.ply"].slice();
    faceless[faceless.length - 19 - 8] = 77;
    await says(faceless, "a.ply", "parse-error", /^a\.ply: byte \d+: face refers to vertex 77/);
    await says(inPieces(""), "a.obj", "parse-error", /no vertices/);
    await says(files["a.obj"], "a.glb", "invalid-option", /a\.glb/);
    await says(7 as never, "a.obj", "invalid-option", /source is 7/);
    await says(["no bytes"] as never, "a.obj", "invalid-option", /Uint8Array/);
    await says(files["a.obj"], "a.obj", "invalid-shape", /NaN/, (p) => void p.fill(NaN));
    const signal = AbortSignal.abort();
    expect(await errorOf(() => all(io.rewrite(files["a.obj"], "a.obj", () => {}, { signal })))).toMatchObject({
      code: "aborted",
    });
    expect((await shifted("a.obj", () => 9)).found).toEqual([...points]);
  });
});

describe("a living edit", () => {
  it("carries points and vertices alike, step by step", async () => {
    for (const steps of [[bend], [lift], [bend, lift], [lift, raise], [lift, bend, lift, raise]]) {
      const edit = await edited(...steps);
      close(edit.transformPoints(barPositions), edit.positions(new Float64Array(barPositions.length)), 1e-12);
      const single = edit.transformPoints(Float32Array.from(points));
      expect(single).toBeInstanceOf(Float32Array);
      const own = points.slice();
      expect(edit.transformPoints(own, own)).toBe(own);
      close(own, edit.transformPoints(points), 1e-15);
      edit.dispose();
    }
  });

  it("turns normals as the surface turns: at right angles to what was at right angles", async () => {
    for (const steps of [[bend], [lift], [lift, bend]]) {
      const edit = await edited(...steps);
      const turned = edit.transformNormals(points, normals);
      const h = 1e-5;
      for (let i = 0; i < points.length; i += 3) {
        const n = normals.subarray(i, i + 3);
        const axis = Math.abs(n[0]) < 0.5 ? [1, 0, 0] : [0, 1, 0];
        const t = unit(cross(n, axis), 0);
        const [a, b] = [-1, 1].map((sign) => edit.transformPoints(t.map((x, k) => points[i + k] + sign * h * x)));
        const along = a.map((x, k) => (b[k] - x) / (2 * h));
        const m = turned.subarray(i, i + 3);
        expect(Math.hypot(...m)).toBeCloseTo(Math.hypot(...n), 9);
        expect(Math.abs(along[0] * m[0] + along[1] * m[1] + along[2] * m[2])).toBeLessThan(1e-3 * Math.hypot(...along));
        const [c, d] = [-1, 1].map((sign) => edit.transformPoints(n.map((x, k) => points[i + k] + sign * h * x)));
        expect((d[0] - c[0]) * m[0] + (d[1] - c[1]) * m[1] + (d[2] - c[2]) * m[2]).toBeGreaterThan(0);
      }
      edit.dispose();
    }
  });

  it("leaves alone what lies outside of the parts of a place step, and zero normals", async () => {
    const edit = await edited(placed({ select: right, move: { rotate: { axis: [0, 0, 1], degrees: 90 } } }));
    // About the centroid of the vertices that were placed, not of the points that come along.
    const far = barPositions.filter((_, i) => barPositions[i - (i % 3)] >= 4);
    const center = [0, 1, 2].map((k) => far.reduce((sum, x, i) => (i % 3 === k ? sum + x : sum), 0) / (far.length / 3));
    const [x, y, z] = center;
    close(edit.transformPoints([3.9, 5, 6, x + 1, y + 2, z + 3]), [3.9, 5, 6, x - 2, y + 1, z + 3], 1e-12);
    const turned = edit.transformNormals([3.9, 5, 6, x + 1, y, z, x, y, z], [1, 0, 0, 1, 0, 0, 0, 0, 0]);
    close(turned, [1, 0, 0, 0, 1, 0, 0, 0, 0], 1e-12);
  });

  it("says what carries nothing", async () => {
    const arap = { ...bend, method: "arap", options: {} } as Step;
    const cases: [Step, RegExp][] = [
      [arap, /not the space around it/],
      [
        { ...bend, follow: [{ select: { vertices: [0] }, along: { vertices: [1] } }] } as Step,
        /steps\[0\]\.follow moves vertices apart/,
      ],
      [placed({ select: { vertices: [1, 2] }, move: {} }), /steps\[0\]\.parts\[0\]\.select names vertices/],
      [placed({ select: { any: [right, { vertices: [1] }] }, move: {} }), /select names vertices/],
      [placed({ select: { vertices: [3] }, targets: [[1, 0, 0]] }), /steps\[0\]\.parts\[0\]\.targets/],
    ];
    for (const [step, says] of cases) {
      const edit = await edited(step);
      const { code, message } = await errorOf(() => edit.transformPoints(points));
      expect(message).toMatch(says);
      expect(code).toBe("not-solvable");
      edit.dispose();
    }
    const edit = await edited(bend);
    const invalid = (words: string) => ({ code: "invalid-option", message: expect.stringContaining(words) });
    expect(await errorOf(() => edit.transformNormals(points, normals.subarray(3)))).toMatchObject(invalid("normals"));
    expect(await errorOf(() => edit.transformPoints([NaN, 0, 0]))).toMatchObject(invalid("points[0]"));
    const plane = pliant.open(pliant.shape({ positions: [0, 0, 1, 0, 0, 1], triangles: [0, 1, 2], dimension: 2 }));
    expect([...plane.transformPoints([5, 6])]).toEqual([5, 6]);
    expect(await errorOf(() => plane.transformNormals([0, 0, 0], [0, 0, 1]))).toMatchObject({ code: "not-solvable" });
  });
});

describe("pliant deform --carry", () => {
  let folder: Folder;
  beforeAll(() => {
    folder = new Folder();
    const line = (i: number) => barPositions.slice(3 * i, 3 * i + 3).join(" ");
    const lines = Array.from({ length: barPositions.length / 3 }, (_, i) => line(i));
    folder.write("bar.xyz", lines.join("\n"));
    folder.write("edit.json", document(bend, lift));
    for (const [name, file] of Object.entries(files)) folder.write(name, file);
  });
  afterAll(() => folder.remove());
  const run = (from: string, to: string, script = "edit.json") =>
    folder.run("deform", "bar.xyz", "--script", script, "--out", "out.xyz", "--carry", from, "--carry-out", to);

  it.each(Object.keys(files))("carries %s as in memory", async (name) => {
    expect(run(name, `to-${name}`)).toEqual({ status: 0, out: "", err: "" });
    const edit = pliant.open(pliant.shape({ positions: barPositions }));
    edit.apply(document(bend, lift));
    await edit.settle();
    const found: number[] = [];
    const turned: number[] = [];
    for await (const _ of io.rewrite(folder.bytes(`to-${name}`), name, (p, n) => {
      found.push(...p);
      turned.push(...(n ?? []));
    }));
    close(found, edit.transformPoints(points), 1e-9);
    if (name.endsWith(".ply")) close(turned, edit.transformNormals(points, normals), 1e-5);
    const kept = await all(io.rewrite(files[name], name, (p, n) => {
      p.set(edit.transformPoints(p));
      n?.set(edit.transformNormals(points, normals));
    }));
    expect(folder.bytes(`to-${name}`).length).toBe(kept.length);
  });

  it.each<[string, string, string, string | undefined, string[]]>([
    ["a line that is no point", "bad.xyz", "x.xyz", undefined, ["bad.xyz", "line 2", "oops"]],
    ["a coordinate beyond all measure", "far.xyz", "x.xyz", undefined, ["far.xyz", "line 2", "1e+200"]],
    ["vertices placed by id", "a.xyz", "x.xyz", "ids.json", ["ids.json", "--carry", "steps[1].parts[0].select names"]],
    ["standard output", "a.xyz", "-", undefined, ["-: the extension is missing", ".xyz"]],
    ["two outputs in one place", "a.xyz", "./out.xyz", undefined, ["out.xyz", "two outputs"]],
    ["a folder", "folder.xyz", "x.xyz", undefined, ["folder.xyz", "folder"]],
  ])("says in one line what is wrong, and leaves nothing: %s", (_, from, to, script, says) => {
    folder.write("bad.xyz", `${"1 2 3"}\n1 oops 3\n`);
    folder.write("far.xyz", "1 2 3\n1e200 2 3\n");
    folder.write("ids.json", document(bend, placed({ select: { vertices: [1] }, move: {} })));
    mkdirSync(join(folder.path, "folder.xyz"), { recursive: true });
    const before = folder.list();
    const { status, out, err } = run(from, to, script);
    expect([status, out]).toEqual([2, ""]);
    expect(err).toMatch(/^pliant: [^\n]+\n$/);
    for (const words of says) expect(err).toContain(words);
    expect(folder.list()).toEqual(before);
  });
});
