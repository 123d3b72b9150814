// Sketch steps of edit scripts: what the calls do, what they report, and every way in which one can be wrong.

import { describe, expect, it } from "vitest";
import { script } from "./support/edit_script.js";
import { arc, camera, curved, limb, longArc, pixel, straight, twoLimbs } from "./support/limb.js";
import { entries, errorOf, pliant } from "./support/package.js";
import { sheet } from "./support/shapes.js";

const mesh = limb();
const shape = pliant.shape(mesh);
const coarse = limb(12, 13);
const coarseShape = pliant.shape(coarse);

const base = { method: "sketch", camera, reference: straight };
const bend = { ...base, bend: { target: arc } };
const stretch = { ...base, bend: { target: longArc }, refine: true };
const run = (steps: unknown, of = shape, more = {}) => pliant.edit(of, script(steps, more) as never);

type Sketch = ReturnType<typeof pliant.sketch>;
const make = (more: object = {}, of = shape) => pliant.sketch(of, { camera, reference: straight, ...more });
const doubles = (sketch: Sketch) => sketch.positions(new Float64Array(3 * sketch.vertices));
const difference = (a: ArrayLike<number>, b: ArrayLike<number>) =>
  Math.max(...Array.from(a, (x, i) => Math.abs(x - b[i])));

describe("a sketch step", () => {
  const profile = [[0, 1], [0.5, 1.4], [1, 0.8]];
  const gestures: [string, object, (sketch: Sketch) => void, object?][] = [
    ["a bend", { bend: { target: arc } }, (sketch) => sketch.bend(arc)],
    ["a twist", { twist: { degrees: 200 } }, (sketch) => sketch.twist(200)],
    ["a scale", { scale: { profile } }, (sketch) => sketch.scale(profile)],
    [
      "the turning control alone",
      { turning: { profile: [[0, 0.5], [1, 1.5]] } },
      (sketch) =>
        sketch.turning([[0, 0.5], [1, 1.5]]),
    ],
    [
      "all at once, in any order",
      {
        twistSpeed: { profile: [[0, 0], [0.3, 1]] },
        scale: { profile },
        twist: { degrees: 90 },
        bend: { target: arc },
        smooth: false,
      },
      (sketch) => {
        sketch.bend(arc);
        sketch.twist(90);
        sketch.scale(profile);
        sketch.twistSpeed([[0, 0], [0.3, 1]]);
      },
      { smooth: false },
    ],
    [
      "a morph",
      { bend: { target: arc }, morph: 0.3 },
      (sketch) => {
        sketch.bend(arc);
        sketch.morph(0.3);
      },
    ],
    ["partitions", { bend: { target: arc }, partitions: [[pixel(-0.2, 0.65), pixel(0.2, 0.65)]] },
      (sketch) => sketch.bend(arc), { partitions: [[pixel(-0.2, 0.65), pixel(0.2, 0.65)]] }],
  ];

  it.each(gestures)("does what the calls do, bit for bit: %s", async (_, step, calls, options) => {
    const sketch = make(options);
    calls(sketch);
    const { positions, state } = await run([{ ...base, ...step }]);
    expect(positions).toEqual(doubles(sketch));
    expect(state).toEqual({ handles: [], ...sketch.state() });
    expect(difference(positions, mesh.positions)).toBeGreaterThan(0.001);
  });

  it("replays another stroke over the same region", async () => {
    const leaning = curved(0.01, 0.22, 0.55, () => 0.1);
    const sketch = make();
    sketch.redraw(camera, leaning);
    sketch.bend(arc);
    const { positions } = await run([{ ...bend, reference: leaning, region: { camera, reference: straight } }]);
    expect(positions).toEqual(doubles(sketch));
  });

  it("takes over the region of the sketch step before, wherever it is by then", async () => {
    const { positions, state, report } = await run([
      bend,
      {
        method: "embedded-graph",
        options: { nodeCount: 30 },
        handles: [{ select: { all: true }, move: { translate: [0, 0.5, 0] } }],
      },
      { ...base, region: "previous", twist: { degrees: 30 }, reference: arc },
    ]);
    expect(report.steps.map(({ method }) => method)).toEqual(["sketch", "embedded-graph", "sketch"]);
    expect((state as never as { labels: number[] }).labels).toEqual(Array.from(make().labels()));
    expect(positions.every(Number.isFinite)).toBe(true);
  });

  it("edits both sides of a symmetric shape", async () => {
    const two = pliant.shape(twoLimbs());
    const reference = curved(0.2, 0.2, 0.6, () => 0);
    const target = curved(0.2, 0.2, 0.6, () => 1);
    const sketch = pliant.sketch(two, { camera, reference, mirror: { normal: [1, 0, 0] } });
    sketch.bend(target);
    const { positions } = await run(
      [{ ...base, reference, bend: { target }, mirror: { normal: [1, 0, 0], offset: 0 } }], two,
    );
    expect(positions).toEqual(doubles(sketch));
  });

  it("starts from the result of the step before", async () => {
    const once = await run([bend]);
    const again = pliant.shape({ positions: once.positions, triangles: mesh.triangles });
    const second = { ...base, reference: arc, twist: { degrees: 45 } };
    expect((await run([bend, second])).positions).toEqual((await run([second], again)).positions);
  });

  it("reports what it did", async () => {
    const seen: object[] = [];
    const { report } = await pliant.edit(shape, script([bend]) as never, {
      onProgress: (progress) => seen.push(progress),
    });
    const region = make()
      .labels()
      .filter((label) => label === 1).length;
    expect(report.steps[0]).toMatchObject({
      method: "sketch", unknowns: region, factorizations: 1, converged: true, start: 0, energy: { total: 0 },
    });
    expect(report.steps[0].iterations).toHaveLength(1);
    expect(report.quality.stretch.mean).toBeLessThan(0.1);
    expect(report.quality).toMatchObject({ folds: 0, constraintError: 0 });
    expect(report.quality.volume).toBeCloseTo(1, 1);
    expect(seen).toEqual([{ frame: 0, frames: 1, step: 0, steps: 1, iteration: 1, energy: 0 }]);
    expect(JSON.parse(JSON.stringify(report))).toEqual(report);
    expect((await run([{ ...bend, smooth: false }])).report.steps[0]).toMatchObject({ unknowns: 0, factorizations: 0 });
  });

  it("can be finished by a solver", async () => {
    const finish = { method: "embedded-graph", options: { nodeCount: 60 }, spacing: 0.1, solve: { iterations: 30 } };
    const [sketched, finished] = [await run([bend]), await run([{ ...bend, finish }])];
    const [step] = finished.report.steps;
    expect(step).toMatchObject({ method: "sketch", finish: { method: "embedded-graph" } });
    expect(step.finish!.iterations.length).toBeGreaterThan(0);
    expect(step.finish!.iterations.length).toBeLessThanOrEqual(30);
    expect(finished.state.finish).toMatchObject({ method: "embedded-graph" });
    const seed = make().seed({ spacing: 0.1 });
    expect(finished.state.handles[0].vertices).toEqual(Array.from(seed.vertices));
    expect(difference(finished.positions, sketched.positions)).toBeLessThan(0.05);
    expect(difference(finished.positions, sketched.positions)).toBeGreaterThan(1e-6);
    expect(finished.report.quality.constraintError).toBeLessThan(0.02);
  });

  it("is finished the long way round where it turns far", async () => {
    const round = curved(0, 0.2, 0.6, () => 1.7 * Math.PI);
    const finish = { method: "embedded-graph", options: { nodeCount: 120 }, spacing: 0.05 };
    const [sketched, finished] = [
      await run([{ ...base, bend: { target: round } }]), await run([{ ...base, bend: { target: round }, finish }]),
    ];
    expect(difference(finished.positions, sketched.positions)).toBeLessThan(0.05);
  });
});

describe("a step that refines", () => {
  it("adds vertices behind those of the input, for all that follows", async () => {
    const sketch = make({}, coarseShape);
    sketch.bend(longArc);
    const refinement = sketch.refine();
    const edit = await run([stretch], coarseShape);
    expect(edit.positions).toEqual(doubles(sketch));
    expect(edit.refinement).toEqual(refinement);
    expect(edit.report.steps[0].added).toBe(refinement.parents.length / 2);
    expect(edit.state).toEqual({ handles: [], ...sketch.state() });
    expect(edit.report.quality.stretch.mean).toBeGreaterThan(0.1);
  });

  it("hands its result on", async () => {
    const up = { translate: [0, 0.1, 0] };
    const solver = {
      method: "embedded-graph", options: { nodeCount: 30 },
      handles: [{ name: "all", select: { any: [{ not: { vertices: [0] } }, { all: true }] }, move: up }],
    };
    const again = { ...stretch, bend: { target: curved(0, 0.2, 2.6, () => -2) }, region: "previous" };
    const first = await run([stretch], coarseShape);
    const added = first.positions.length / 3 - coarse.positions.length / 3;
    const { positions, state, refinement, report } = await run([stretch, solver, again], coarseShape);
    const { parents, rest } = state as never as { parents: number[][]; rest: number[][] };
    const more = positions.length / 3 - coarse.positions.length / 3;
    expect(more).toBeGreaterThan(added);
    expect(parents).toHaveLength(more);
    expect(rest).toHaveLength(more);
    expect(parents.flat()).toEqual(Array.from(refinement!.parents));
    expect(Math.max(...refinement!.triangles)).toBe(positions.length / 3 - 1);
    expect(Math.max(...refinement!.triangleParents)).toBe(coarse.triangles.length / 3 - 1);
    expect(report.steps.map((step) => step.added)).toEqual([added, undefined, more - added]);
    // At rest in the last step: what the step before has made of the first refinement, moved up.
    rest.slice(0, added).forEach((point, i) =>
      expect(
        difference(
          point,
          Array.from(
            first.positions.slice(coarse.positions.length + 3 * i, coarse.positions.length + 3 * i + 3),
            (x, k) => x + up.translate[k],
          ),
        ),
      ).toBeLessThan(1e-3),
    );
  });

  it("stays within what it may add", async () => {
    const { code, message } = await errorOf(() => run([{ ...stretch, refine: { maxAdded: 2 } }], coarseShape));
    expect([code, message]).toEqual(["too-large", expect.stringContaining("more than 2 vertices")]);
  });
});

describe("keyframes", () => {
  const frames = (a: object, b: object, more = {}) => pliant.edit(shape, {
    format: "pliant-edit", version: 1, frames: 3, ...more,
    keyframes: [{ time: 0, steps: [{ ...base, ...a }] }, { time: 2, steps: [{ ...base, ...b }] }],
  } as never);

  it("blend poses by lengths and angles", async () => {
    const result = await frames(
      { twist: { degrees: 0 } }, { bend: { target: arc }, twist: { degrees: 90 }, morph: 0.8 },
    );
    const sketch = make();
    sketch.twist(0);
    const rest = sketch.pose();
    sketch.bend(arc);
    sketch.twist(90);
    sketch.setPose(rest, sketch.pose(), 0.5);
    sketch.morph(0.9);
    expect(result.frames).toHaveLength(3);
    expect(difference(result.frames![1], doubles(sketch))).toBeLessThan(1e-12);
    expect(difference(result.frames![0], mesh.positions)).toBeLessThan(1e-12);
  });

  it.each([
    ["another stroke", { bend: { target: arc }, reference: arc }, "keyframes[1].steps[0].reference differs"],
    ["a refinement", { bend: { target: arc }, refine: true }, "keyframes[1].steps[0].refine is given in a keyframe"],
  ])("refuse %s", async (_, second, says) => {
    const { code, message } = await errorOf(() => frames({ bend: { target: arc } }, second));
    expect([code, message]).toEqual(["invalid-script", expect.stringContaining(says)]);
  });
});

describe("a wrong sketch step", () => {
  const seen = (more: object) => ({ ...bend, camera: { ...camera, ...more } });
  const rows: [string, object, ...string[]][] = [
    ["an unknown key", { ...bend, handles: [] }, "steps[0].handles", "not a known key", "reference"],
    ["nothing asked for", base, "steps[0]", "asks for nothing", "bend"],
    ["only refinement", { ...base, refine: true }, "steps[0]", "asks for nothing"],
    ["no camera", { ...bend, camera: undefined }, "steps[0].camera", "undefined"],
    ["an unknown key of the camera", seen({ fov: 3 }), "steps[0].camera.fov", "fovY"],
    ["two kinds of views", seen({ fovY: 40 }), "steps[0].camera", "fovY and orthographicHeight"],
    ["no kind of view", seen({ orthographicHeight: undefined }), "steps[0].camera", "neither"],
    ["an eye in the plane", seen({ eye: [0, 1] }), "steps[0].camera.eye", "length 2"],
    ["an eye nowhere", seen({ eye: [0, NaN, 0] }), "steps[0].camera.eye[1]", "NaN"],
    ["an eye at its target", seen({ eye: camera.target }), "steps[0]", "camera.target equals camera.eye"],
    ["a view straight up", seen({ up: [0, 1, 0] }), "steps[0]", "camera.up"],
    ["a flat picture", seen({ height: 0 }), "steps[0]", "camera.height is 0"],
    ["a wide angle", seen({ orthographicHeight: undefined, fovY: 180 }), "steps[0]", "camera.fovY is 180"],
    ["no reference", { ...bend, reference: undefined }, "steps[0].reference", "undefined"],
    ["an empty reference", { ...bend, reference: [] }, "steps[0].reference", "empty"],
    ["one sample", { ...bend, reference: [[1, 2]] }, "steps[0]", "reference has 1 samples"],
    ["a sample in space", { ...bend, reference: [[1, 2, 3], [4, 5, 6]] }, "steps[0].reference[0]", "length 3"],
    ["a sample nowhere", { ...bend, reference: [[1, 2], [4, NaN]] }, "steps[0].reference[1][1]", "NaN"],
    ["a dot", { ...bend, reference: [[500, 500], [501, 500]] }, "steps[0]", "reference", "5"],
    ["a bend to nowhere", { ...base, bend: {} }, "steps[0].bend.target", "undefined"],
    ["a bend as points", { ...base, bend: arc }, "steps[0].bend", "object"],
    ["a short target", { ...base, bend: { target: [[500, 500], [501, 500]] } }, "steps[0].bend: target"],
    ["a twist without degrees", { ...base, twist: {} }, "steps[0].twist.degrees", "undefined"],
    ["a twist in radians", { ...base, twist: { radians: 3 } }, "steps[0].twist.radians", "degrees"],
    ["an endless twist", { ...base, twist: { degrees: Infinity } }, "steps[0].twist.degrees", "Infinity"],
    ["a twist beside the limb", { ...base, reference: curved(0.2, 0.2, 0.6, () => 0), twist: { degrees: 30 } },
      "steps[0].twist: reference meets the shape"],
    ["an empty profile", { ...base, scale: { profile: [] } }, "steps[0].scale.profile", "empty"],
    ["a profile beyond the stroke", { ...base, scale: { profile: [[0, 1], [2, 1]] } },
      "steps[0].scale: profile[1]", "s from 0 to 1"],
    ["a profile backwards", { ...base, scale: { profile: [[1, 1], [0, 1]] } },
      "steps[0].scale: profile[1]", "not below"],
    ["a scale of zero", { ...base, scale: { profile: [[0, 1], [1, 0]] } }, "steps[0].scale: scale is 0", "above 0"],
    ["a speed without a twist", { ...bend, twistSpeed: { profile: [[0, 0]] } }, "steps[0].twistSpeed", "without twist"],
    ["a turning that is none", { ...base, turning: 3 }, "steps[0].turning", "3"],
    ["a morph beyond the pose", { ...bend, morph: 1.5 }, "steps[0].morph", "1.5", "from 0 to 1"],
    ["smooth as a number", { ...bend, smooth: 1 }, "steps[0].smooth", "true or false"],
    ["refine as text", { ...bend, refine: "yes" }, "steps[0].refine", '"yes"'],
    ["refinement and a solver", { ...bend, refine: true, finish: { method: "embedded-graph" } },
      "steps[0]", "refine and finish"],
    ["partitions as one line", { ...bend, partitions: [[1, 2], [3, 4]] }, "steps[0].partitions[0][0]"],
    ["a partition beside the limb", { ...bend, partitions: [[[10, 10], [40, 10]]] },
      "steps[0]", "partitions[0] cuts nothing off"],
    ["a mirror without direction", { ...bend, mirror: { normal: [0, 0, 0] } }, "steps[0].mirror.normal", "zero vector"],
    ["a mirror through the limb", { ...bend, mirror: { normal: [1, 0, 0] } }, "steps[0]", "mirror"],
    ["a region that is none", { ...bend, region: "last" }, "steps[0].region", '"last"', '"previous"'],
    ["a region before any", { ...bend, region: "previous" }, "steps[0].region", "no sketch step comes before"],
    ["a region with a bad stroke", { ...bend, region: { camera, reference: [[1, 2], [1, 2]] } },
      "steps[0].region: reference"],
    ["a region and partitions", { ...bend, region: "previous", partitions: [arc] }, "steps[0]", "partitions"],
    ["finishing by nothing", { ...bend, finish: {} }, "steps[0].finish.method", "undefined"],
    ["finishing by a sketch", { ...bend, finish: { method: "sketch" } }, "steps[0].finish.method", "not a solver"],
    ["an unknown option of the finish", { ...bend, finish: { method: "embedded-graph", options: { nodes2: 1 } } },
      "steps[0].finish.options.nodes2"],
    ["negative spacing", { ...bend, finish: { method: "embedded-graph", spacing: -1 } },
      "steps[0].finish.spacing", "-1"],
    ["no iterations", { ...bend, finish: { method: "embedded-graph", solve: { iterations: 0 } } },
      "steps[0].finish.solve.iterations", "0"],
  ];

  it.each(rows)("%s", async (_, step, ...says) => {
    const { code, message } = await errorOf(() => run([step]));
    expect(code).toBe("invalid-script");
    for (const words of says) expect(message).toContain(words);
    expect(message).not.toContain("\n");
    expect(message.length).toBeLessThan(300);
  });

  it("needs a mesh in space", async () => {
    const points = pliant.shape({ positions: mesh.positions });
    expect((await errorOf(() => run([bend], points))).message).toContain("no triangles");
    const plane = pliant.shape({ positions: [0, 0, 1, 0, 0, 1], triangles: [0, 1, 2], dimension: 2 });
    expect((await errorOf(() => run([bend], plane))).message).toContain("in the plane");
  });

  it("twists and scales only what has a front and a back", async () => {
    const { positions: flat, triangles } = sheet(11);
    const positions = flat.map((_, i) => [flat[i] - 0.5, flat[i + 1], flat[i - 1]][i % 3]); // upright before the camera
    const open = pliant.shape({ positions, triangles });
    for (const asked of [{ twist: { degrees: 10 } }, { scale: { profile: [[0, 2]] } }]) {
      const { code, message } = await errorOf(() => run([{ ...base, ...asked }], open));
      expect([code, message]).toEqual([
        "invalid-script", expect.stringContaining("meets the shape only once at pixel"),
      ]);
    }
    expect(difference((await run([bend], open)).positions, positions)).toBeGreaterThan(0.1);
  });

  it("leaves nothing behind: the next correct one works", async () => {
    const expected = (await run([bend])).positions;
    for (const [, step] of rows) await errorOf(() => run([step]));
    expect((await run([bend])).positions).toEqual(expected);
  });
});

describe("wrong calls of a sketch", () => {
  const sketch = make();
  sketch.bend(arc);
  const build = (more: object) => () => make(more);
  const rows: [string, () => unknown, string, ...string[]][] = [
    ["no options", () => pliant.sketch(shape, undefined as never), "invalid-option", "options", "undefined"],
    ["no shape", () => pliant.sketch({} as never, { camera, reference: straight }), "invalid-option", "shape"],
    ["an unknown option", build({ target: arc }), "invalid-option", "options.target", "option of a sketch"],
    ["points", () => pliant.sketch(pliant.shape({ positions: [0, 0, 0] }), { camera, reference: straight }),
      "invalid-shape", "no triangles"],
    ["too few labels", build({ labels: [1] }), "invalid-option", "labels has length 1"],
    ["no labels", build({ labels: [] }), "invalid-option", "labels is empty"],
    ["half a label", build({ labels: Array(mesh.positions.length / 3).fill(0.5) }),
      "invalid-option", "labels[0]", "0.5"],
    ["labels without a region", build({ labels: new Uint8Array(mesh.positions.length / 3) }),
      "invalid-option", "labels", "label 1"],
    ["labels and partitions", build({ labels: make().labels(), partitions: [[pixel(-0.2, 0.6), pixel(0.2, 0.6)]] }),
      "invalid-option", "labels", "partitions"],
    ["a reference without samples", () => sketch.redraw(camera, []), "invalid-option", "reference", "empty"],
    ["a reference of the wrong kind", () => sketch.redraw(camera, "line" as never),
      "invalid-option", "reference", '"line"'],
    ["no target", () => sketch.bend(undefined as never), "invalid-option", "target", "undefined"],
    ["a target of odd length", () => sketch.bend(Float32Array.of(1, 2, 3)), "invalid-option", "target", "length 3"],
    ["an unknown option of a bend", () => sketch.bend(arc, { open: true } as never),
      "invalid-option", "options.open", "unfinished"],
    ["perhaps unfinished", () => sketch.bend(arc, { unfinished: 1 } as never), "invalid-option", "options.unfinished"],
    ["a twist by text", () => sketch.twist("90" as never), "invalid-option", "degrees", '"90"'],
    ["a scale below zero", () => sketch.scale([[0, -1]]), "invalid-option", "scale", "above 0"],
    ["a turning without points", () => sketch.turning([]), "invalid-option", "profile", "empty"],
    ["a speed beyond 1", () => sketch.twistSpeed([[1.5, 1]]), "invalid-option", "profile[0]"],
    ["a morph beyond 1", () => sketch.morph(2), "invalid-option", "morph", "2"],
    ["smooth by text", () => sketch.setSmooth("yes" as never), "invalid-option", "smooth"],
    ["no pose", () => sketch.setPose(undefined as never), "invalid-option", "pose", "undefined"],
    ["a pose of another curve", () => sketch.setPose({ ...sketch.pose(), turns: [1] }),
      "invalid-option", "pose.turns", "length 1"],
    ["an endless pose", () => sketch.setPose({ ...sketch.pose(), turns: Array(1_000_000).fill(0) }),
      "invalid-option", "pose.turns", "length 1000000"],
    ["a pose without length", () => sketch.setPose({ ...sketch.pose(), length: 0 }), "invalid-option", "pose"],
    ["a pose nowhere", () => sketch.setPose({ ...sketch.pose(), heading: NaN }),
      "invalid-option", "pose.heading", "NaN"],
    ["a pose toward another curve", () => sketch.setPose(sketch.pose(), { ...sketch.pose(), turns: [1] }, 0.5),
      "invalid-option", "toward.turns"],
    ["a share beyond 1", () => sketch.setPose(sketch.pose(), sketch.pose(), 3), "invalid-option", "t is 3"],
    ["half a vertex to add", () => sketch.refine({ maxAdded: 0.5 }), "invalid-option", "options.maxAdded", "0.5"],
    ["spacing below zero", () => sketch.seed({ spacing: -1 }), "invalid-option", "options.spacing", "-1"],
    ["a short array for positions", () => sketch.positions(new Float32Array(3)), "invalid-option", "out", "length 3"],
  ];

  it.each(rows)("%s", async (_, action, code, ...says) => {
    const before = doubles(sketch);
    const error = await errorOf(action);
    expect(error.code).toBe(code);
    for (const words of says) expect(error.message).toContain(words);
    expect(doubles(sketch)).toEqual(before);
  });
});

describe.each([{ inline: false }, { inline: true }])("pliant/worker $inline", ({ inline }) => {
  it("sketches by promises, with the same results", async () => {
    const library = await entries.worker.init({ inline });
    const there = await library.shape(coarse);
    const [here, sketch] = [make({}, coarseShape), await library.sketch(there, { camera, reference: straight })];
    expect(await sketch.labels()).toEqual(here.labels());
    expect(await sketch.held()).toBe(here.held());
    expect(await library.limbStroke(there, { camera, pixel: pixel(0, 0.9) })).toEqual(
      pliant.limbStroke(coarseShape, { camera, pixel: pixel(0, 0.9) }),
    );
    here.bend(arc, { unfinished: true });
    await sketch.bend(arc, { unfinished: true });
    expect(await sketch.positions()).toEqual(here.positions());
    for (const one of [here, sketch]) {
      await one.bend(longArc);
      await one.twist(40);
      await one.scale([[0, 1], [1, 1.2]]);
      await one.turning([[0, 0.1], [1, 1.1]]);
      await one.twistSpeed([[0, 0], [0.5, 1]]);
      await one.setSmooth(false);
      await one.morph(0.9);
    }
    expect(await sketch.refine()).toEqual(here.refine());
    const out = new Float64Array(3 * here.vertices);
    expect(await sketch.positions(out)).toBe(out);
    expect(out).toEqual(doubles(here));
    expect(await sketch.normals()).toEqual(here.normals());
    expect(await sketch.parameters()).toEqual(here.parameters());
    expect(await sketch.restPositions()).toEqual(here.restPositions());
    expect([await sketch.reference(), await sketch.target()]).toEqual([here.reference(), here.target()]);
    expect(await sketch.seed({ spacing: 0.1 })).toEqual(here.seed({ spacing: 0.1 }));
    expect(await sketch.state()).toEqual(here.state());
    const pose = await sketch.pose();
    expect(pose).toEqual(here.pose());
    await sketch.unrefine();
    await sketch.unbend();
    await sketch.reset();
    await sketch.redraw(camera, straight);
    await sketch.setPose(pose);
    expect((await errorOf(() => sketch.twist(NaN))).code).toBe("invalid-option");
    expect((await errorOf(() => sketch.positions(out))).message).toContain("out");
    await sketch.dispose();
    expect((await errorOf(() => sketch.unbend())).code).toBe("disposed");
    const { positions } = await library.edit(there, script([stretch]) as never);
    expect(positions).toEqual((await run([stretch], coarseShape)).positions);
    library.dispose();
  });
});
