// Pictures in the command: .png in and out, .svg, .glb and other shapes out, and files that are none.

import { NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import { encode } from "fast-png";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { Folder, objPositions } from "./support/command.js";
import { entries, errorOf, pliant } from "./support/package.js";
import {
  areasOf,
  cover,
  disc,
  dotted,
  inScout,
  middleOf,
  painted,
  pixelAt,
  png,
  readPng,
  scout,
  sum,
  visibleArea,
} from "./support/pictures.js";

const folder = new Folder();
afterAll(() => folder.remove());

const size = 320;
const green = [0, 255, 0, 255];
const [hand, hip, head] = [
  [0.77, 0.2],
  [0, -0.1],
  [0, 0.55],
].map((at) => inScout(at as [number, number], size));
const target = [hand[0] - 150, hand[1] - 50];
const hero = dotted(scout(size), hand[0], hand[1], 4, green);
const pins = (depth?: number) => [
  {
    name: "hand",
    select: { sphere: { center: hand, radius: 10 } },
    move: { translate: [-150, -50], rotate: { degrees: -190 } },
    ...(depth === undefined ? {} : { depth }),
  },
  { select: { sphere: { center: hip, radius: 12 } } },
  { select: { sphere: { center: head, radius: 12 } } },
];
const script = (handles: object[]) => ({ format: "pliant-edit", version: 1, steps: [{ method: "arap", handles }] });

beforeAll(() => {
  folder.write("hero.png", png(hero));
  folder.write("edit.json", script(pins(1)));
  folder.write("behind.json", script(pins(-1)));
  folder.write("still.json", script(pins().map(({ select }) => ({ select }))));
  folder.write("away.json", script([{ select: { all: true }, move: { translate: [-100, 40] } }]));
});

const fine = { status: 0, out: "", err: "" };

describe("a picture", () => {
  it("comes back to the last bit where nothing moves", () => {
    expect(folder.run("deform", "hero.png", "--script", "still.json", "--out", "same.png", "--quiet")).toEqual(fine);
    const same = readPng(folder.bytes("same.png"));
    const visible = (data: ArrayLike<number>) =>
      Uint8Array.from(Array.from(data).filter((_, i) => hero.data[i | 3] > 8));
    expect(Buffer.compare(visible(same.data), visible(hero.data))).toBe(0);
    expect(same).toMatchObject({ width: size, height: size });
  });

  it("follows its pins, in depth order where it overlaps itself, and stays transparent where it is", () => {
    expect(
      folder.run(
        "deform",
        "hero.png",
        "--script",
        "edit.json",
        "--out",
        "bent.png",
        "--report",
        "r.json",
        "--state",
        "s.json",
        "--quiet",
      ),
    ).toEqual(fine);
    const bent = readPng(folder.bytes("bent.png"));
    expect(bent).toMatchObject({ width: size, height: size });
    const [x, y] = middleOf(bent, green);
    expect(Math.hypot(x - target[0], y - target[1])).toBeLessThan(1);
    expect(pixelAt(bent, ...(hand as [number, number]))).toEqual([0, 0, 0, 0]);
    for (const [cx, cy] of [
      [2, 2],
      [size - 3, 2],
      [2, size - 3],
      [size - 3, size - 3],
    ])
      expect(pixelAt(bent, cx, cy)[3]).toBe(0);
    expect(Math.abs(folder.json("r.json").quality.area - 1)).toBeLessThan(0.05);
    expect(folder.json("s.json").result[0]).toHaveLength(3);
    // Behind the body the hand is out of sight.
    expect(folder.run("deform", "hero.png", "--script", "behind.json", "--out", "behind.png", "--quiet")).toEqual(fine);
    expect(middleOf(readPng(folder.bytes("behind.png")), green)).toEqual([NaN, NaN]);
  });

  it("keeps its frame, or shows all of itself", () => {
    expect(folder.run("deform", "hero.png", "--script", "away.json", "--out", "cut.png", "--quiet")).toEqual(fine);
    expect(folder.run("deform", "hero.png", "--script", "away.json", "--out", "whole.png", "--fit", "--quiet")).toEqual(
      fine,
    );
    const [cut, whole] = [readPng(folder.bytes("cut.png")), readPng(folder.bytes("whole.png"))];
    expect(cut).toMatchObject({ width: size, height: size });
    expect(visibleArea(cut)).toBeLessThan(0.9 * visibleArea(hero));
    expect(whole.width).toBeLessThan(size);
    expect(visibleArea(whole) / visibleArea(hero)).toBeCloseTo(1, 2);
    expect(folder.run("deform", "hero.png", "--script", "away.json", "--out", "x.obj", "--fit")).toMatchObject({
      status: 2,
      err: "pliant: --fit is given, and x.obj is no picture; expected a .png or .svg\n",
    });
  });

  it("goes out as .svg with clip paths, as .glb with its texture, as .obj in the plane", async () => {
    for (const name of ["bent.svg", "bent.glb", "bent.obj"])
      expect(folder.run("deform", "hero.png", "--script", "edit.json", "--out", name, "--quiet")).toEqual(fine);
    const { triangles, positions } = await pliant.picture(hero);
    const svg = folder.text("bent.svg");
    expect(svg).toMatch(/^<svg xmlns="http:\/\/www.w3.org\/2000\/svg" viewBox="0 0 320 320"/);
    expect(svg.match(/<clipPath /g)).toHaveLength(triangles.length / 3);
    expect(svg.match(/<use href="#picture" clip-path="url\(#t\d+\)" transform="matrix\(/g)).toHaveLength(
      triangles.length / 3,
    );
    expect(svg.match(/data:image\/png;base64,/g)).toHaveLength(1);

    const glb = (await new NodeIO().registerExtensions(ALL_EXTENSIONS).readBinary(folder.bytes("bent.glb"))).getRoot();
    const [material] = glb.listMaterials();
    expect(readPng(material.getBaseColorTexture()!.getImage()!).data).toEqual(Uint8Array.from(hero.data));
    expect(material.getAlphaMode()).toBe("BLEND");
    expect(material.getExtension("KHR_materials_unlit")).not.toBeNull();
    const [primitive] = glb.listMeshes()[0].listPrimitives();
    const obj = objPositions(folder.text("bent.obj"));
    expect(obj.length / 3).toBe(positions.length / 2);
    expect(obj.every((x, i) => i % 3 !== 2 || x === 0)).toBe(true);
    // The last triangle is the frontmost: it belongs to the hand.
    const ids = [...primitive.getIndices()!.getArray()!].slice(-3);
    for (const id of ids) {
      const [x, y] = primitive.getAttribute("POSITION")!.getElement(id, [0, 0, 0]);
      expect(Math.hypot(x - target[0], y - target[1])).toBeLessThan(25);
    }
  });

  it("moves by keyframes: numbered pictures, or one .glb", () => {
    const [b, a] = [pins(), pins().map((pin) => ({ ...pin, move: {} }))];
    folder.write("frames.json", {
      format: "pliant-edit",
      version: 1,
      frames: 3,
      keyframes: [
        { time: 0, steps: [{ method: "arap", handles: a }] },
        { time: 1, steps: [{ method: "arap", handles: b }] },
      ],
    });
    expect(folder.run("deform", "hero.png", "--script", "frames.json", "--out", "f_%02d.png", "--quiet")).toEqual(fine);
    const ways = ["f_01.png", "f_02.png", "f_03.png"].map((name) => middleOf(readPng(folder.bytes(name)), green));
    expect(Math.hypot(ways[0][0] - hand[0], ways[0][1] - hand[1])).toBeLessThan(1);
    expect(Math.hypot(ways[1][0] - (hand[0] + target[0]) / 2, ways[1][1] - (hand[1] + target[1]) / 2)).toBeLessThan(
      1.5,
    );
    expect(folder.run("deform", "hero.png", "--script", "frames.json", "--out", "f.glb", "--quiet")).toEqual(fine);
    expect(folder.bytes("f.glb").length).toBeGreaterThan(10_000);
  });

  it("is inspected in pixels, with the spacing that is asked for", () => {
    const [coarse, fine] = ["30", "6"].map((spacing) =>
      JSON.parse(folder.run("inspect", "hero.png", "--json", "--spacing", spacing).out),
    );
    expect(coarse).toMatchObject({ format: "png", components: 1, textureCoordinates: true });
    expect(coarse.min).toHaveLength(2);
    expect(fine.vertices).toBeGreaterThan(3 * coarse.vertices);
  });

  it("loses its background where that is asked for", () => {
    const paper = painted(120, 90, (x, y) => {
      const share = cover(disc(60, 45, 30)(x, y)) / 255;
      return [255 - 205 * share, 255 - 175 * share, 255 - 55 * share, 255];
    });
    folder.write("paper.png", png(paper));
    for (const color of ["#ffffff", "border", "auto"]) {
      expect(
        folder.run(
          "deform",
          "paper.png",
          "--script",
          "all.json",
          "--out",
          `${color.slice(-4)}.png`,
          "--background",
          color,
        ),
      ).toMatchObject({ status: 2 });
    }
    folder.write("all.json", script([{ select: { all: true }, move: { translate: [10, 0] } }]));
    for (const color of ["#ffffff", "border", "auto"]) {
      expect(
        folder.run("deform", "paper.png", "--script", "all.json", "--out", "cut.png", "--background", color, "--quiet"),
      ).toEqual(fine);
      const cut = readPng(folder.bytes("cut.png"));
      expect(pixelAt(cut, 20, 20)[3]).toBe(0);
      expect(pixelAt(cut, 70, 45)).toEqual([50, 80, 200, 255]);
      expect(visibleArea(cut) / (Math.PI * 30 ** 2)).toBeCloseTo(1, 1);
    }
    expect(folder.run("inspect", "paper.png", "--background", "white")).toMatchObject({
      status: 2,
      err: 'pliant: --background is "white"; expected a colour as #ffffff, border or auto\n',
    });
    expect(folder.run("inspect", "paper.png", "--spacing", "0")).toMatchObject({
      status: 2,
      err: 'pliant: --spacing is "0"; expected a number of pixels above 0\n',
    });
    folder.write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect(folder.run("inspect", "tri.obj", "--spacing", "3")).toMatchObject({
      status: 2,
      err: "pliant: --spacing is given, and tri.obj is no picture; expected a .png\n",
    });
    expect(folder.run("deform", "tri.obj", "--script", "away.json", "--out", "tri.png").err).toMatch(
      /^pliant: (away|tri)/,
    );
  });
});

describe("kinds of .png", () => {
  /** Left half dark, right half light, by the channels a kind has. */
  const halves = (channels: number, depth: 8 | 16, dark: number[], light: number[]) => {
    const values = depth === 16 ? new Uint16Array(64 * 64 * channels) : new Uint8Array(64 * 64 * channels);
    for (let pixel = 0; pixel < 64 * 64; ++pixel) values.set(pixel % 64 < 32 ? dark : light, channels * pixel);
    return encode({ width: 64, height: 64, data: values, channels, depth });
  };

  it.each([
    ["grey", halves(1, 8, [10], [200]), [10, 10, 10, 255], [200, 200, 200, 255]],
    ["grey with alpha", halves(2, 8, [10, 255], [200, 0]), [10, 10, 10, 255], [0, 0, 0, 0]],
    ["colours", halves(3, 8, [10, 20, 30], [200, 150, 100]), [10, 20, 30, 255], [200, 150, 100, 255]],
    [
      "16 bits",
      halves(4, 16, [10 * 257, 0, 65535, 65535], [200 * 257, 1, 2, 65535]),
      [10, 0, 255, 255],
      [200, 0, 0, 255],
    ],
    [
      "one bit",
      encode({
        width: 64,
        height: 64,
        data: new Uint8Array(512).map((_, i) => (i % 8 < 4 ? 0 : 255)),
        channels: 1,
        depth: 1,
      }),
      [0, 0, 0, 255],
      [255, 255, 255, 255],
    ],
    [
      "a palette",
      encode({
        width: 64,
        height: 64,
        data: new Uint8Array(4096).map((_, i) => Number(i % 64 > 31)),
        channels: 1,
        depth: 8,
        palette: [
          [9, 8, 7, 255],
          [1, 200, 3, 255],
        ],
      }),
      [9, 8, 7, 255],
      [1, 200, 3, 255],
    ],
    [
      "interlaced",
      encode(
        {
          width: 64,
          height: 64,
          data: new Uint8Array(64 * 64 * 3).map((_, i) => (i % 192 < 96 ? 30 : 220)),
          channels: 3,
          depth: 8,
        },
        { interlace: "Adam7" },
      ),
      [30, 30, 30, 255],
      [220, 220, 220, 255],
    ],
  ])("%s", (name, bytes, dark, light) => {
    folder.write("kind.png", bytes);
    folder.write("shift.json", script([{ select: { all: true }, move: { translate: [0, 0] } }]));
    expect(folder.run("deform", "kind.png", "--script", "shift.json", "--out", "out.png", "--quiet"), name).toEqual(
      fine,
    );
    const out = readPng(folder.bytes("out.png"));
    expect(pixelAt(out, 10, 30)).toEqual(dark);
    expect(pixelAt(out, 50, 30)).toEqual(light);
  });
});

describe("a damaged picture", () => {
  const whole = png(hero);
  const changed = (at: number, ...bytes: number[]) => {
    const copy = whole.slice();
    copy.set(bytes, at);
    return copy;
  };

  it.each([
    ["nothing", new Uint8Array(0)],
    ["text", new TextEncoder().encode("this is no picture, though it is called one")],
    ["a .jpg by another name", Uint8Array.of(0xff, 0xd8, 0xff, 0xe0, ...Array(60).fill(0))],
    ["a beginning", whole.subarray(0, 20)],
    ["a header alone", whole.subarray(0, 33)],
    ["two thirds", whole.subarray(0, Math.floor((2 * whole.length) / 3))],
    ["all but the end", whole.subarray(0, whole.length - 12)],
    ["a flipped bit among the pixels", changed(Math.floor(whole.length / 2), whole[Math.floor(whole.length / 2)] ^ 4)],
    ["no width", changed(16, 0, 0, 0, 0)],
    ["a size beyond all memory", changed(16, 0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff)],
    ["an unknown kind", changed(25, 5)],
    ["a depth of 3 bits", changed(24, 3)],
  ])("that holds %s is one line and exit code 2, and leaves nothing", (_, bytes) => {
    folder.write("bad.png", bytes);
    const before = folder.list();
    for (const args of [
      ["deform", "bad.png", "--script", "edit.json", "--out", "never.png", "--report", "never.json"],
      ["inspect", "bad.png"],
    ]) {
      const { status, out, err } = folder.run(...args);
      expect(status).toBe(2);
      expect(out).toBe("");
      expect(err).toMatch(/^pliant: bad\.png: [^\n]+\n$/);
    }
    expect(folder.list()).toEqual(before);
  });

  it("that shows nothing says so", () => {
    folder.write("clear.png", png(painted(30, 30, () => [255, 255, 255, 0])));
    expect(folder.run("inspect", "clear.png")).toEqual({
      status: 2,
      out: "",
      err:
        "pliant: clear.png: data shows nothing; " +
        "expected a part of at least 9 square pixels more opaque than alpha 8\n",
    });
  });
});

describe("pliant/io in Node", () => {
  it("has no decoder of its own, and takes one", async () => {
    const worker = await entries.worker.init();
    afterAll(() => worker.dispose());
    const error = await errorOf(() => worker.read(png(hero), "hero.png"));
    expect(error).toMatchObject({
      code: "load-failed",
      message: expect.stringContaining("hero.png: pictures are read and written by the browser, and here is none"),
    });
    const decoded: number[] = [];
    const files = entries.io.init({
      pictures: {
        decode: (bytes) => (decoded.push(bytes.length), readPng(bytes)),
        encode: (image) => png(image) as Uint8Array<ArrayBuffer>,
      },
    });
    const file = await files.read(png(hero), "hero.png", { picture: { spacing: 12 } });
    expect(file).toMatchObject({ format: "png", dimension: 2 });
    expect(decoded).toHaveLength(1);
    const shape = pliant.shape(file);
    expect(shape.dimension).toBe(2);
    expect(sum(areasOf(file.positions, file.triangles))).toBeGreaterThan(visibleArea(hero));
    const moved = await files.write(
      { ...file, positions: file.positions.map((x, i) => (i % 2 ? x : x + 7)) },
      "moved.png",
    );
    expect(middleOf(readPng(moved), green)[0]).toBeCloseTo(hand[0] + 7, 0);
    const error2 = await errorOf(
      () => files.write({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0] as never, triangles: [0, 1, 2] as never }, "x.png"),
      entries.io.PliantError,
    );
    expect(error2).toMatchObject({
      code: "invalid-shape",
      message: "dimension is 3; expected 2: a .png shows a shape in the plane",
    });
    const error3 = await errorOf(
      () =>
        files.write(
          { positions: Float32Array.of(0, 0, 1, 0, 0, 1), triangles: Uint32Array.of(0, 1, 2), dimension: 2 },
          "x.svg",
        ),
      entries.io.PliantError,
    );
    expect(error3).toMatchObject({
      code: "invalid-shape",
      message: "texture is missing; expected a picture on the shape, to draw it",
    });
    expect(
      await errorOf(() => entries.io.init({ pictures: { decode: 1 } } as never), entries.io.PliantError),
    ).toMatchObject({
      code: "invalid-option",
      message: "options.pictures lacks a function; expected decode and encode",
    });
  });
});
