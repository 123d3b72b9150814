// Pictures as shapes in the plane: outline, mesh, drawing, and every method over them.

import { afterAll, describe, expect, it } from "vitest";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import {
  areasOf,
  cornersOf,
  cover,
  disc,
  dotted,
  inScout,
  middleOf,
  painted,
  pixelAt,
  scout,
  sum,
  visibleArea,
} from "./support/pictures.js";
import { entries, errorOf, installed, pliant } from "./support/package.js";

const { rasterize, spreadDepths, backToFront, frameOf } = entries.picture;
const red = (alpha: number) => [220, 60, 40, alpha] as const;

const ball = painted(160, 120, (x, y) => red(cover(disc(80, 60, 45)(x, y))));
const ring = painted(160, 120, (x, y) => red(cover(Math.max(disc(80, 60, 50)(x, y), -disc(80, 60, 20)(x, y)))));

/** Lengths of all sides of all triangles. */
function sidesOf({ positions, triangles }: { positions: ArrayLike<number>; triangles: ArrayLike<number> }): number[] {
  return Array.from({ length: triangles.length / 3 }, (_, t) => cornersOf(positions, triangles, t)).flatMap(
    ([a, b, c]) =>
      [
        [a, b],
        [b, c],
        [c, a],
      ].map(([p, q]) => Math.hypot(p[0] - q[0], p[1] - q[1])),
  );
}

describe("the shape of a picture", () => {
  it("is its visible part, in pixels from the bottom left corner, evenly triangulated", async () => {
    const shape = await pliant.picture({ ...ball, spacing: 8 });
    expect(shape).toBeInstanceOf(entries.pliant.Shape);
    expect(shape.dimension).toBe(2);
    const { positions, triangles, texcoords } = shape;
    expect(shape.report).toMatchObject({
      vertices: positions.length / 2,
      triangles: triangles.length / 3,
      components: 1,
      nonManifoldEdges: 0,
    });
    const areas = areasOf(positions, triangles);
    expect(Math.min(...areas)).toBeGreaterThan(0);
    expect(sum(areas) / (Math.PI * 45 ** 2)).toBeGreaterThan(1);
    expect(sum(areas) / (Math.PI * 45 ** 2)).toBeLessThan(1.06);
    const sides = sidesOf(shape);
    expect(Math.min(...sides)).toBeGreaterThan(3);
    expect(Math.max(...sides)).toBeLessThan(14);
    texcoords.forEach((share, i) => expect(share).toBeCloseTo(positions[i] / (i % 2 ? 120 : 160), 6));
  });

  it("keeps the outline within a margin of what is visible, with crossings between pixels", async () => {
    const { positions, triangles } = await pliant.picture({ ...ball, spacing: 200, tolerance: 0, margin: 2 });
    const shape = pliant.shape({ positions, triangles, dimension: 2 });
    expect(shape.report.boundaryEdges).toBe(positions.length / 2); // nothing but the outline
    for (let v = 0; v < positions.length; v += 2) {
      const apart = disc(80, 60, 45)(positions[v], positions[v + 1]);
      expect(apart).toBeGreaterThan(1);
      expect(apart).toBeLessThan(3);
    }
    expect(new Set(positions.map((x) => x % 1)).size).toBeGreaterThan(20);
  });

  it("keeps holes open, unless they are not wanted, and parts apart", async () => {
    const euler = async (input: Parameters<typeof pliant.picture>[0]) => {
      const {
        report: { vertices, triangles, boundaryEdges, components },
      } = await pliant.picture(input);
      return [vertices - (3 * triangles + boundaryEdges) / 2 + triangles, components];
    };
    expect(await euler({ ...ring, spacing: 7 })).toEqual([0, 1]);
    expect(await euler({ ...ring, spacing: 7, holes: false })).toEqual([1, 1]);
    const two = painted(160, 120, (x, y) => red(cover(Math.min(disc(45, 60, 30)(x, y), disc(112, 60, 30)(x, y)))));
    expect(await euler({ ...two, spacing: 7 })).toEqual([2, 2]);
    // Nested: a disc in the hole of a ring.
    const target = painted(160, 120, (x, y) =>
      red(cover(Math.min(Math.max(disc(80, 60, 55)(x, y), -disc(80, 60, 38)(x, y)), disc(80, 60, 20)(x, y)))),
    );
    expect(await euler({ ...target, spacing: 7 })).toEqual([1, 2]);
  });

  it("leaves specks out and fills small holes", async () => {
    const dirty = painted(160, 120, (x, y) =>
      red(cover(Math.min(Math.max(disc(60, 60, 40)(x, y), -disc(60, 60, 3)(x, y)), disc(140, 100, 2)(x, y)))),
    );
    const { report, triangles, positions } = await pliant.picture({ ...dirty, spacing: 8 });
    expect(report.components).toBe(1);
    expect(report.vertices - (3 * report.triangles + report.boundaryEdges) / 2 + report.triangles).toBe(1);
    expect(Math.max(...positions)).toBeLessThan(110);
    expect(triangles.length).toBeGreaterThan(0);
    expect((await pliant.picture({ ...dirty, spacing: 8, speck: 0 })).report.components).toBe(2);
  });

  it("is the same every time, and a picture that fills its frame is a rectangle", async () => {
    const [a, b] = [await pliant.picture(ring), await pliant.picture(ring)];
    expect(a.positions).toEqual(b.positions);
    expect(a.triangles).toEqual(b.triangles);
    const whole = painted(60, 40, () => red(255));
    const { positions, triangles } = await pliant.picture(whole);
    expect(sum(areasOf(positions, triangles)) / 2400).toBeCloseTo(1.03, 1); // with the margin
    expect(frameOf(positions)).toEqual({ width: 62, height: 42, origin: [-1, -1] });
  });

  it("triangulates any outline, with thin gaps and thin parts", async () => {
    let state = 7;
    const random = () => (state = (Math.imul(state, 1103515245) + 12345) >>> 0) / 2 ** 32;
    for (let round = 0; round < 60; ++round) {
      const [width, height] = [20 + Math.floor(60 * random()), 20 + Math.floor(60 * random())];
      const density = [0.03, 0.2, 0.5][round % 3];
      const noisy = painted(width, height, () => red(random() < density ? 255 : 0));
      const shape = await pliant.picture({
        ...noisy,
        speck: 0,
        tolerance: 6 * random(),
        margin: 0.5 + 4 * random(),
        spacing: 1 + 15 * random(),
      });
      expect(Math.min(...areasOf(shape.positions, shape.triangles))).toBeGreaterThan(0);
      expect(shape.report.nonManifoldEdges).toBe(0);
    }
  });
});

describe("a background", () => {
  const eyes = (x: number, y: number) => Math.min(disc(65, 70, 8)(x, y), disc(95, 70, 8)(x, y));
  /** On white paper, a blue ball with white eyes. */
  const onPaper = painted(160, 120, (x, y) => {
    const share = Math.max(cover(-disc(80, 60, 45)(x, y)), cover(eyes(x, y))) / 255;
    return [30 + 225 * share, 60 + 195 * share, 200 + 55 * share, 255];
  });
  const share = async (input: Parameters<typeof pliant.picture>[0]) => {
    const { positions, triangles } = await pliant.picture({ ...input, spacing: 6 });
    return sum(areasOf(positions, triangles)) / (Math.PI * 45 ** 2);
  };

  it("of one colour is not part of the shape", async () => {
    const withoutEyes = 1 - (2 * 8 ** 2) / 45 ** 2;
    expect(await share({ ...onPaper, background: [255, 255, 255] })).toBeCloseTo(withoutEyes + 0.03, 1);
    expect(await share({ ...onPaper, background: "border" })).toBeCloseTo(withoutEyes + 0.03, 1);
    expect(await share(onPaper)).toBeGreaterThan(2.9); // all of the paper
  });

  it("found by itself hangs together with the border; none is where alpha tells or colours are many", async () => {
    expect(await share({ ...onPaper, background: "auto" })).toBeCloseTo(1.03, 1);
    expect(await share({ ...ball, background: "auto" })).toBeCloseTo(1.03, 1);
    const photo = painted(160, 120, (x, y) => [x, 2 * y, 128, 255]);
    expect(await share({ ...photo, background: "auto" })).toBeGreaterThan(2.9);
    const blank = painted(160, 120, () => [255, 255, 255, 255]);
    expect(await share({ ...blank, background: "auto" })).toBeGreaterThan(2.9);
  });

  it("leaves no seam of its colour around the shape", async () => {
    const { image } = await pliant.picture({ ...onPaper, background: "auto" });
    expect(pixelAt(image, 2, 2)[3]).toBe(0);
    expect(pixelAt(image, 65, 70)).toEqual([255, 255, 255, 255]);
    for (let i = 0; i < image.data.length; i += 4) {
      if (image.data[i + 3] > 0 && image.data[i + 3] < 255) expect(image.data[i]).toBeLessThan(120); // not pale
    }
    expect(visibleArea(image) / (Math.PI * 45 ** 2)).toBeCloseTo(1, 1);
  });
});

describe("bad pictures", () => {
  const clear = painted(20, 20, () => [9, 9, 9, 0]);
  it.each([
    ["invalid-shape", "picture is undefined; expected an object", undefined],
    ["invalid-shape", "width is 0; expected pixels from 1 to 16384", { ...clear, width: 0 }],
    ["invalid-shape", "height is 2.5; expected pixels from 1 to 16384", { ...clear, height: 2.5 }],
    [
      "invalid-shape",
      "expected a Uint8Array or Uint8ClampedArray of length 1680: red, green, blue and alpha of 21 x 20 pixels",
      { ...clear, width: 21 },
    ],
    [
      "invalid-shape",
      "data is an array of length 1600; expected a Uint8Array",
      { ...clear, data: Array(1600).fill(0) },
    ],
    [
      "invalid-shape",
      "data shows nothing; expected a part of at least 4 square pixels more opaque than alpha 8",
      clear,
    ],
    [
      "invalid-shape",
      "data shows nothing; expected a part of at least 4 square pixels unlike the background",
      { ...painted(20, 20, () => red(255)), background: "border" },
    ],
    ["invalid-shape", "picture.colour is not a known key of a picture", { ...clear, colour: 1 }],
    ["invalid-option", 'background is "white"; expected "border" or "auto"', { ...clear, background: "white" }],
    [
      "invalid-option",
      "background[1] is 256; expected an integer from 0 to 255",
      { ...clear, background: [0, 256, 0] },
    ],
    ["invalid-option", "spacing is 0; expected a number above 0", { ...ball, spacing: 0 }],
    ["invalid-option", "spacing is NaN; expected a number above 0", { ...ball, spacing: NaN }],
    ["invalid-option", "margin is 0.1; expected a number from 0.5 to 64", { ...ball, margin: 0.1 }],
    ["invalid-option", "threshold is 255; expected an integer from 0 to 254", { ...ball, threshold: 255 }],
    ["invalid-option", "tolerance is -1; expected a number from 0 to 64", { ...ball, tolerance: -1 }],
    ["invalid-option", "holes is 1; expected true or false", { ...ball, holes: 1 }],
    [
      "too-large",
      "the picture has 16000 x 16000 pixels; expected at most 64000000",
      { width: 16000, height: 16000, data: new Uint8Array(4) },
    ],
  ])("%s: %s", async (code, message, input) => {
    const error = await errorOf(() => pliant.picture(input as never));
    expect(error).toMatchObject({ code, message: expect.stringContaining(message) });
    expect((await pliant.picture({ ...ball, spacing: 20 })).report.components).toBe(1);
  });
});

describe("drawing", () => {
  it("gives the picture itself where nothing has moved", async () => {
    for (const image of [ball, ring, scout(200), scout(320), painted(50, 40, (x, y) => [5 * x, 6 * y, 90, 255])]) {
      const { positions, triangles, texcoords } = await pliant.picture({ ...image, speck: 0 });
      const drawn = rasterize({ image, positions, triangles, texcoords });
      expect(drawn).toMatchObject({ width: image.width, height: image.height });
      let worst = 0;
      for (let i = 0; i < drawn.data.length; ++i)
        if (image.data[i | 3] > 8) worst = Math.max(worst, Math.abs(drawn.data[i] - image.data[i]));
      expect(worst).toBe(0);
    }
  });

  it("leaves no seam and draws none twice, however it is turned", async () => {
    const glass = painted(120, 120, () => [200, 100, 50, 128]);
    const { positions, triangles, texcoords } = await pliant.picture({ ...glass, spacing: 9 });
    for (const angle of [0.1, 0.7854, 1, 2.5]) {
      const turned = positions.map((_, i) => {
        const [x, y] = [positions[i - (i % 2)] - 60, positions[i - (i % 2) + 1] - 60];
        return (
          60 + 0.7 * (i % 2 ? Math.sin(angle) * x + Math.cos(angle) * y : Math.cos(angle) * x - Math.sin(angle) * y)
        );
      });
      const drawn = rasterize({ image: glass, positions: turned, triangles, texcoords });
      for (let x = 35; x < 85; ++x)
        for (let y = 35; y < 85; ++y) expect(pixelAt(drawn, x, y)).toEqual([200, 100, 50, 128]);
      expect(pixelAt(drawn, 1, 1)).toEqual([0, 0, 0, 0]);
    }
  });

  it("mixes colours by their alpha, so that what is invisible does not show", () => {
    // A white and an invisible black pixel, stretched: between them white that fades, never grey.
    const image = { width: 2, height: 1, data: Uint8Array.of(255, 255, 255, 255, 0, 0, 0, 0) };
    const quad = {
      positions: [0, 0, 40, 0, 40, 20, 0, 20],
      texcoords: [0, 0, 1, 0, 1, 1, 0, 1],
      triangles: [0, 1, 2, 0, 2, 3],
    };
    const drawn = rasterize({ image, ...quad, width: 40, height: 20 });
    const alphas = Array.from({ length: 40 }, (_, x) => pixelAt(drawn, x, 10)).map(([r, g, b, a]) => {
      if (a > 0) expect([r, g, b]).toEqual([255, 255, 255]);
      return a;
    });
    expect(alphas[10]).toBeGreaterThan(240);
    expect(alphas[20]).toBeGreaterThan(100);
    expect(alphas[20]).toBeLessThan(150);
    expect(alphas[35]).toBeLessThan(20);
  });

  it("puts triangles over those before them, and larger depths over smaller ones", () => {
    const image = { width: 2, height: 1, data: Uint8Array.of(255, 0, 0, 255, 0, 0, 255, 255) };
    // Two squares at one place, the first red, the second blue.
    const square = [2, 2, 8, 2, 8, 8, 2, 8];
    const mesh = {
      image,
      positions: [...square, ...square],
      triangles: [0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7],
      texcoords: [...Array(4)].flatMap(() => [0.25, 0.5]).concat([...Array(4)].flatMap(() => [0.75, 0.5])),
      width: 10,
      height: 10,
    };
    expect(pixelAt(rasterize(mesh), 5, 5)).toEqual([0, 0, 255, 255]);
    expect(pixelAt(rasterize({ ...mesh, depths: [1, 1, 1, 1, 0, 0, 0, 0] }), 5, 5)).toEqual([255, 0, 0, 255]);
    expect(pixelAt(rasterize({ ...mesh, depths: Array(8).fill(3) }), 5, 5)).toEqual([0, 0, 255, 255]);
    expect(pixelAt(rasterize({ ...mesh, origin: [4, 0], width: 3 }), 0.5, 5)).toEqual([0, 0, 255, 255]);
  });

  it.each([
    ["image.data is", { image: { width: 2, height: 2, data: new Uint8Array(3) } }],
    ["texcoords is an array of length 2; expected 8 numbers", { texcoords: [0, 0] }],
    ["triangles[2] is 4; expected a vertex id from 0 to 3", { triangles: [0, 1, 4] }],
    ["positions[3] is NaN; expected a finite number", { positions: [0, 0, 4, NaN, 4, 4, 0, 4] }],
    ["depths is an array of length 1; expected 4 numbers", { depths: [1] }],
    ["width is 0; expected pixels from 1 to 16384", { width: 0 }],
    ["origin is", { origin: [1] }],
    ["drawing.colour is not a known", { colour: 1 }],
  ])("tells a bad argument: %s", async (message, change) => {
    const drawing = {
      image: { width: 1, height: 1, data: Uint8Array.of(1, 2, 3, 255) },
      positions: [0, 0, 4, 0, 4, 4, 0, 4],
      texcoords: [0, 0, 1, 0, 1, 1, 0, 1],
      triangles: [0, 1, 2, 0, 2, 3],
    };
    const error = await errorOf(() => rasterize({ ...drawing, ...change } as never), entries.picture.PliantError);
    expect(error).toMatchObject({ code: "invalid-option", message: expect.stringContaining(message) });
  });
});

describe("depth", () => {
  const bar = painted(240, 60, (x, y) => red(x > 10 && x < 230 && y > 20 && y < 40 ? 255 : 0));

  it("spreads from the pins along the shape, and is theirs where they are", async () => {
    const shape = await pliant.picture({ ...bar, spacing: 5 });
    const at = (x: number) => shape.select({ sphere: { center: [x, 30], radius: 6 } });
    const depths = spreadDepths(shape.positions, 2, shape.triangles, [
      { vertices: at(20), depth: 2 },
      { vertices: at(120) },
      { vertices: at(220), depth: -1 },
    ]);
    const mean = (x: number) => sum([...at(x)].map((v) => depths[v])) / at(x).length;
    expect([mean(20), mean(120), mean(220)]).toEqual([2, 0, -1]);
    expect(mean(45)).toBeGreaterThan(mean(70));
    expect(mean(70)).toBeGreaterThan(0.5);
    expect(mean(100)).toBeLessThan(mean(70));
    expect(mean(195)).toBeLessThan(-0.5);
    expect([...spreadDepths(shape.positions, 2, shape.triangles, [])].every((depth) => depth === 0)).toBe(true);
  });

  it("orders triangles from back to front, those of one depth as they were", () => {
    const triangles = Uint32Array.of(0, 1, 2, 3, 4, 5, 6, 7, 8);
    expect(backToFront(triangles, Array(9).fill(1))).toEqual(triangles);
    expect([...backToFront(triangles, [5, 5, 5, 0, 0, 0, 5, 5, 5])]).toEqual([3, 4, 5, 0, 1, 2, 6, 7, 8]);
  });

  it("of a handle moves nothing, and another one costs nothing", async () => {
    const shape = await pliant.picture({ ...bar, spacing: 5 });
    const script = (depth: object) => ({
      format: "pliant-edit" as const,
      version: 1 as const,
      steps: [
        {
          method: "arap" as const,
          fixed: [{ sphere: { center: [20, 30], radius: 8 } }],
          handles: [
            {
              select: { sphere: { center: [220, 30], radius: 8 } },
              move: { translate: [-60, 20], rotate: { degrees: 100 } },
              ...depth,
            },
          ],
        },
      ],
    });
    const plain = await pliant.edit(shape, script({}));
    const deep = await pliant.edit(shape, script({ depth: 2 }));
    expect(plain.depths).toBeUndefined();
    expect(deep.positions).toEqual(plain.positions);
    expect(Math.max(...deep.depths!)).toBe(2);
    expect(Math.min(...deep.depths!)).toBe(0); // the fixed region
    const edit = pliant.open(shape);
    edit.apply(script({ depth: 2 }));
    edit.run();
    const [before] = edit.report().steps;
    edit.apply(script({ depth: -3 }));
    expect(edit.run()).toMatchObject({ iterations: 0, converged: true });
    expect(edit.report().steps[0]).toMatchObject({ factorizations: before.factorizations, analyses: before.analyses });
    edit.dispose();
  });

  it("is a number, of handles in the plane", async () => {
    const handle = (depth: unknown) => ({
      format: "pliant-edit",
      version: 1,
      steps: [{ method: "arap", handles: [{ select: { vertices: [0] }, depth }] }],
    });
    const flat = await pliant.picture({ ...bar, spacing: 9 });
    const solid = pliant.shape({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], triangles: [0, 1, 2] });
    expect(await errorOf(() => pliant.edit(flat, handle("front") as never))).toMatchObject({
      code: "invalid-script",
      message: 'steps[0].handles[0].depth is "front"; expected a finite number',
    });
    expect(await errorOf(() => pliant.edit(solid, handle(1) as never))).toMatchObject({
      code: "invalid-script",
      message: "steps[0].handles[0].depth is given for a shape in space; expected it in the plane only",
    });
  });
});

describe("a puppet", () => {
  const green = [0, 255, 0, 255];
  const size = 400;
  const [hand, hip, head] = [
    [0.77, 0.2],
    [0, -0.1],
    [0, 0.55],
  ].map((at) => inScout(at as [number, number], size));
  const target = [hand[0] - 40, hand[1] + 90];
  const image = dotted(scout(size), hand[0], hand[1], 4, green);
  const handles = [
    { select: { sphere: { center: hand, radius: 12 } }, move: { translate: [-40, 90], rotate: { degrees: 55 } } },
    { select: { sphere: { center: hip, radius: 14 } } },
    { select: { sphere: { center: head, radius: 14 } } },
  ];

  it.each(pliant.methods.map(({ name }) => name))("follows its pins by %s", async (method) => {
    const shape = await pliant.picture(image);
    const options = method === "embedded-graph" ? { exactHandles: true } : {};
    const { positions } = await pliant.edit(shape, {
      format: "pliant-edit",
      version: 1,
      steps: [{ method, options, handles } as never],
    });
    const { triangles, texcoords } = shape;
    const drawn = rasterize({ image, positions, triangles, texcoords });
    const [x, y] = middleOf(drawn, green);
    expect(Math.hypot(x - target[0], y - target[1])).toBeLessThan(1);
    expect(Math.hypot(...[0, 1].map((k) => middleOf(image, green)[k] - hand[k]))).toBeLessThan(0.5);
    expect(pixelAt(drawn, ...(hand as [number, number]))[3]).toBe(0); // it has left
    expect(pixelAt(drawn, 3, 3)).toEqual([0, 0, 0, 0]);
    const area = sum(areasOf(positions, triangles)) / sum(areasOf(shape.positions, triangles));
    expect(Math.abs(area - 1)).toBeLessThan(0.05);
    expect(Math.abs(visibleArea(drawn) / visibleArea(image) - 1)).toBeLessThan(0.05);
  });
});

describe("where it lives", () => {
  it("is the same from the worker, through the one table", async () => {
    const library = await entries.worker.init();
    afterAll(() => library.dispose());
    const [here, there] = [await pliant.picture(ring), await library.picture(ring)];
    for (const key of ["dimension", "diagonal", "report", "positions", "triangles", "texcoords"] as const)
      expect(there[key]).toEqual(here[key]);
    expect(there.image).toEqual({ ...ring, data: new Uint8ClampedArray(ring.data) });
    const options = { method: "arap" } as const;
    const [a, b] = [pliant.deformer(here, options), await library.deformer(there, options)];
    expect(await b.positions()).toEqual(a.positions());
    expect(await errorOf(() => library.picture({ ...ring, spacing: -1 }))).toMatchObject({
      code: "invalid-option",
      message: "spacing is -1; expected a number above 0",
    });
    await there.dispose();
    expect((await errorOf(() => library.deformer(there, options))).code).toBe("disposed");
  });

  it("gives copies, and takes one", async () => {
    const own = { ...ball, data: new Uint8ClampedArray(ball.data) };
    const shape = await pliant.picture(own);
    own.data.fill(0);
    expect(shape.image.data).toEqual(ball.data);
    shape.positions.fill(0);
    shape.image.data.fill(1);
    expect(shape.image.data).toEqual(ball.data);
    expect(Math.max(...shape.positions)).toBeGreaterThan(100);
  });

  it("costs pages nothing that show no pictures", () => {
    const loaded = new Set<string>();
    const load = (file: string) => {
      if (loaded.has(file)) return;
      loaded.add(file);
      const text = readFileSync(join(installed, "dist", file), "utf8");
      for (const [, path] of text.matchAll(/(?:\bfrom|\bimport)\s*["'`](\.[^"'`]+)["'`]/g))
        load(join(file, "..", path));
    };
    load("pliant.js");
    const all = [...loaded].map((file) => readFileSync(join(installed, "dist", file), "utf8")).join("\n");
    expect(loaded.size).toBeGreaterThan(2);
    expect(all).toContain("invalid-handle");
    expect(all).not.toContain("shows nothing"); // of the outline
    expect(all).not.toContain("already constrained"); // of the triangulation
  });
});
