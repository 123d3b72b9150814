// Edit scripts: what they do, what they report, and every way in which one can be wrong.

import { describe, expect, it } from "vitest";
import { half, script } from "./support/edit_script.js";
import { errorOf, pliant } from "./support/package.js";
import { picture, sheet, where } from "./support/shapes.js";

const mesh = sheet(11);
const shape = pliant.shape(mesh);
const left = half([-1, 0, 0], -0.15);
const right = half([1, 0, 0], 0.9);
const rightIds = where(mesh.positions, (x) => x >= 0.9);
const options = { nodeCount: 20 };
const hand = { name: "hand", select: right, move: { translate: [0, 0, 0.2] } };
const step = { method: "embedded-graph", options, fixed: [left], handles: [hand] };

const run = (value: unknown, of = shape, more = {}) => pliant.edit(of, value as never, more);
const difference = (a: ArrayLike<number>, b: ArrayLike<number>) =>
  Math.max(...Array.from(a, (x, i) => Math.abs(x - b[i])));

/** The same edit by the calls of a deformer. */
async function byHand(): Promise<Float64Array> {
  const deformer = pliant.deformer(shape, { method: "embedded-graph", ...options });
  deformer.setFixed(shape.select(left));
  deformer.addHandle(shape.select(right)).move(hand.move);
  await deformer.solve();
  return deformer.positions(new Float64Array(mesh.positions.length));
}

describe("an edit", () => {
  it("does what the calls do", async () => {
    expect((await run(script([step]))).positions).toEqual(await byHand());
  });

  it("gives the same result every time, and another for another seed", async () => {
    const first = await run(script([step]));
    expect((await run(script([step]))).positions).toEqual(first.positions);
    const other = await run(script([step], { seed: 2 }));
    expect(other.state.nodes).not.toEqual(first.state.nodes);
    expect(difference(other.positions, first.positions) / shape.diagonal).toBeLessThan(0.05);
  });

  it("answers in the precision of the shape", async () => {
    const single = pliant.shape({ positions: Float32Array.from(mesh.positions), triangles: mesh.triangles });
    expect((await run(script([step]), single)).positions).toBeInstanceOf(Float32Array);
    expect((await run(script([step]))).positions).toBeInstanceOf(Float64Array);
  });

  it("reports what it did", async () => {
    const { report } = await run(script([step]));
    const { mean, p95, max } = report.quality.stretch;
    expect(report).toMatchObject({ format: "pliant-report", version: 1, shape: { vertices: 121, triangles: 200 } });
    expect(report.steps).toHaveLength(1);
    const [only] = report.steps;
    expect(only).toMatchObject({ method: "embedded-graph", converged: true });
    expect(only.unknowns).toBeGreaterThan(0);
    expect(only.factorizations).toBeGreaterThan(0);
    const energies = [only.start, ...only.iterations.map(({ energy }) => energy)];
    energies.slice(1).forEach((energy, i) => expect(energy).toBeLessThanOrEqual(energies[i]));
    expect(energies.at(-1)).toBe(only.energy.total);
    expect(only.iterations.every(({ ms }) => ms >= 0)).toBe(true);
    expect(only.energy.rotation + 10 * only.energy.regularization + 100 * only.energy.constraint).toBeCloseTo(
      only.energy.total, 9,
    );
    expect(mean).toBeLessThanOrEqual(p95);
    expect(p95).toBeLessThanOrEqual(max);
    expect(report.quality).toMatchObject({ volume: null, folds: 0, intersections: 0 });
    expect(JSON.parse(JSON.stringify(report))).toEqual(report);
  });

  it("tells its progress", async () => {
    const seen: object[] = [];
    const { report } = await run(script([step, step]), shape, {
      onProgress: (progress: object) => seen.push(progress),
    });
    expect(seen[0]).toMatchObject({ frame: 0, frames: 1, step: 0, steps: 2, iteration: 1 });
    expect(seen.at(-1)).toMatchObject({ step: 1, steps: 2 });
    expect(seen.length).toBeGreaterThanOrEqual(report.steps[0].iterations.length + report.steps[1].iterations.length);
  });

  it("stops after `iterations` in all", async () => {
    const { report } = await run(script([{ ...step, solve: { iterations: 2 } }]));
    expect(report.steps[0]).toMatchObject({ converged: false });
    expect(report.steps[0].iterations).toHaveLength(2);
  });

  it("moves a handle to targets, one a vertex, ascending ids", async () => {
    const targets = rightIds.map((v) => [mesh.positions[3 * v], mesh.positions[3 * v + 1], 0.3]);
    const { state } = await run(
      script([{ ...step, handles: [{ select: { vertices: [...rightIds].reverse() }, targets }] }]),
    );
    expect(state.handles).toEqual([{ vertices: rightIds, targets }]);
  });

  it("holds a handle that has neither move nor targets", async () => {
    const held = { ...step, fixed: [], handles: [{ select: left }, hand] };
    const { positions } = await run(script([held]));
    expect(positions[3 * rightIds[0] + 2] - mesh.positions[3 * rightIds[0] + 2]).toBeGreaterThan(0.15);
    expect(Math.abs(positions[2])).toBeLessThan(0.02);
  });

  it("starts a later step from the result of the one before", async () => {
    const once = await run(script([step]));
    const again = pliant.shape({ positions: once.positions, triangles: mesh.triangles });
    const twice = await run(script([step, { ...step, handles: [{ ...hand, select: { vertices: rightIds } }] }]));
    const expected = await run(script([{ ...step, handles: [{ ...hand, select: { vertices: rightIds } }] }]), again);
    expect(difference(twice.positions, expected.positions)).toBe(0);
    expect(twice.report.steps).toHaveLength(2);
    expect(twice.state.nodes).toEqual(expected.state.nodes);
  });

  it("works in the plane", async () => {
    const flat = picture(11);
    const plane = pliant.shape({ ...flat, dimension: 2 });
    const bend = {
      method: "embedded-graph", options, fixed: [half([-1, 0], -0.15)],
      handles: [{ select: half([1, 0], 0.9), move: { rotate: { degrees: 30 }, translate: [0, 0.2] } }],
    };
    const { positions, report } = await run(script([bend]), plane);
    expect(positions).toHaveLength(242);
    expect(positions[241]).toBeGreaterThan(1.1);
    expect(report.quality.constraintError).toBeLessThan(0.05);
  });

  it("can be aborted, and leaves nothing behind", async () => {
    const controller = new AbortController();
    const outcome = errorOf(() =>
      run(script([step]), shape, { signal: controller.signal, onProgress: () => controller.abort() }),
    );
    expect((await outcome).code).toBe("aborted");
    expect((await errorOf(() => run(script([step]), shape, { signal: AbortSignal.abort() }))).code).toBe("aborted");
    expect((await run(script([step]))).report.steps[0].converged).toBe(true);
  });
});

describe("a drag", () => {
  const drag = [0.25, 0.3, 0.35].map((z) => ({
    handles: [{ name: "hand", move: { translate: [0, 0, z] } }], iterations: 2,
  }));

  it("replays what happened under one grab, without a factorisation", async () => {
    const { report } = await run(script([{ ...step, drag }]));
    expect(report.steps[0].drag).toHaveLength(3);
    for (const entry of report.steps[0].drag!) {
      expect(entry).toMatchObject({ factorizations: 0, analyses: 0 });
      expect(entry.iterations.length).toBeLessThanOrEqual(2);
    }
    expect(report.steps[0].drag!.at(-1)!.iterations.at(-1)!.energy).toBe(report.steps[0].energy.total);
  });

  it("is what a page does", async () => {
    const { positions } = await run(script([{ ...step, drag }]));
    const deformer = pliant.deformer(shape, { method: "embedded-graph", ...options });
    deformer.setFixed(shape.select(left));
    const handle = deformer.addHandle(shape.select(right));
    handle.move(hand.move);
    await deformer.solve();
    for (const { handles: [{ move }] } of drag) {
      handle.move(move);
      await deformer.solve({ maxIterations: 2 });
    }
    expect(deformer.positions(new Float64Array(mesh.positions.length))).toEqual(positions);
  });
});

describe("keyframes", () => {
  const at = (degrees: number, z: number) => [
    { ...step, handles: [{ ...hand, move: { rotate: { axis: [0, 1, 0], degrees }, translate: [0, 0, z] } }] },
  ];
  const animation = {
    format: "pliant-edit",
    version: 1,
    frames: 5,
    keyframes: [{ time: 1, steps: at(0, 0) }, { time: 3, steps: at(-60, 0.4) }],
  };

  it("are met, and turned between by degrees", async () => {
    const { frames, report, positions } = await run(animation);
    expect(frames).toHaveLength(5);
    expect(report.frames!.map(({ time }) => time)).toEqual([1, 1.5, 2, 2.5, 3]);
    expect(frames![0]).toEqual(mesh.positions);
    expect(frames![4]).toEqual(positions);
    expect(frames![4]).toEqual((await run(script(at(-60, 0.4)))).positions);
    expect(difference(frames![2], (await run(script(at(-30, 0.2)))).positions)).toBeLessThan(1e-9);
  });

  it.each([
    ["targets", { targets: rightIds.map((v) => [1, v, 0]) },
      { targets: rightIds.map((v) => [2, v, 4]) }, { targets: rightIds.map((v) => [1.5, v, 2]) }],
    ["nothing and a move", {}, { move: { scale: 3, rotate: { axis: [1, 0, 0], degrees: 90 } } },
      { move: { scale: 2, rotate: { axis: [1, 0, 0], degrees: 45 } } }],
  ])("go from %s by the numbers", async (_, first, last, middle) => {
    const made = (goal: object) => [{ ...step, handles: [{ select: right, ...goal }], solve: { iterations: 1 } }];
    const { report } = await run({
      ...animation, frames: 3, keyframes: [{ time: 0, steps: made(first) }, { time: 1, steps: made(last) }],
    });
    const single = await run(script(made(middle)));
    expect(report.frames![1].steps[0].start).toBeCloseTo(single.report.steps[0].start, 9);
  });
});

describe("a script is refused for", () => {
  const withStep = (more: object) => script([{ ...step, ...more }]);
  const withHandle = (more: object) => withStep({ handles: [{ ...hand, ...more }] });
  const withOptions = (more: object) => withStep({ options: more });
  const withDrag = (more: object) => withStep({ drag: [{ handles: [{ name: "hand", move: {} }], ...more }] });
  const key = (time: unknown, steps: unknown) => ({ time, steps });
  const keyed = (keyframes: unknown, more: object = { frames: 3 }) => ({
    format: "pliant-edit", version: 1, keyframes, ...more,
  });
  const other = (more: object) => keyed([key(0, [step]), key(1, [{ ...step, ...more }])]);

  const rows: [what: string, value: unknown, ...says: string[]][] = [
    ["being none", null, "script", "null"],
    ["being a list", [], "script", "length 0"],
    ["another format", { ...script([step]), format: "edit" }, "format", '"edit"', "pliant-edit"],
    ["no version", { format: "pliant-edit", steps: [step] }, "version", "undefined"],
    ["a later version", { ...script([step]), version: 2 }, "version", "2"],
    ["an unknown key", script([step], { step: [] }), "script.step", "steps"],
    ["no steps", script(undefined), "steps", "undefined"],
    ["an empty list of steps", script([]), "steps", "empty"],
    ["a step that is none", script([5]), "steps[0]", "5"],
    ["no method", script([{}]), "steps[0].method", "undefined"],
    ["an unknown method", withStep({ method: "clay" }), "steps[0].method", '"clay"'],
    [
      "a method that is not here yet",
      withStep({ method: "volumetric-graph" }), "steps[0].method", "not in this build yet",
    ],
    ["an unknown key of a step", withStep({ pinned: [] }), "steps[0].pinned", "fixed"],
    ["an unknown option", withOptions({ nodeCoutn: 3 }), "steps[0].options.nodeCoutn", "nodeCount"],
    ["a bad option", withOptions({ nodeCount: 122 }), "steps[0].options.nodeCount", "122", "121"],
    ["nodes and nodeCount", withOptions({ nodeCount: 1, nodes: [[0, 0, 0]] }),
      "steps[0].options", "nodes and nodeCount"],
    ["more neighbours than nodes", withOptions({ nodeCount: 5, neighbours: 6 }),
      "steps[0].options.neighbours", "6", "5 nodes"],
    ["more neighbours than the shape has vertices", withOptions({ neighbours: 122 }), "steps[0]", "neighbours", "122"],
    [
      "a cut that selects nothing",
      withOptions({ nodeCount: 5, cuts: [[{ all: true }, { sphere: { center: [9, 9, 9], radius: 1 } }]] }),
      "cuts[0][1]",
      "no vertex",
    ],
    ["asking for nothing", script([{ method: "embedded-graph" }]), "steps[0]", "no handles"],
    ["an empty list of handles", withStep({ handles: [] }), "steps[0].handles", "empty"],
    ["an unknown key of a handle", withStep({ handles: [hand, { select: left, mvoe: {} }] }),
      "steps[0].handles[1].mvoe", "move"],
    ["a handle without vertices", withHandle({ select: undefined }), "steps[0].handles[0].select", "undefined"],
    ["a handle that selects nothing", withHandle({ select: half([1, 0, 0], 5) }),
      "steps[0].handles[0].select", "no vertex"],
    ["an unknown selection", withHandle({ select: { ball: {} } }), "steps[0].handles[0].select.ball", "sphere"],
    ["a vertex twice", withHandle({ select: { vertices: [120, 120] } }),
      "steps[0].handles[0].select.vertices[1]", "120"],
    ["a vertex out of range", withHandle({ select: { vertices: [121] } }),
      "steps[0].handles[0].select.vertices[0]", "121"],
    ["a vertex both fixed and moved", withHandle({ select: { all: true } }),
      "steps[0].handles[0].select", "vertex 0", "steps[0].fixed[0]"],
    ["a vertex in two handles", withStep({ handles: [hand, { select: { vertices: [rightIds[0]] }, move: {} }] }),
      "steps[0].handles[1].select", "steps[0].handles[0].select"],
    ["move and targets", withHandle({ targets: [[0, 0, 0]] }), "steps[0].handles[0]", "move and targets"],
    ["a bad move", withHandle({ move: { rotate: { axis: [0, 0, 0], degrees: 1 } } }),
      "steps[0].handles[0].move.rotate.axis", "zero vector"],
    ["too few targets", withHandle({ move: undefined, targets: [[0, 0, 0]] }),
      "steps[0].handles[0].targets", "1 points", String(rightIds.length)],
    ["a target that is no point", withHandle({ move: undefined, targets: [[0, 0]] }),
      "steps[0].handles[0].targets[0]", "length 2"],
    ["a nameless handle", withHandle({ name: "" }), "steps[0].handles[0].name", '""'],
    ["two handles of one name", withStep({ handles: [hand, { ...hand, select: { vertices: [60] } }] }),
      "steps[0].handles[1].name", '"hand"'],
    ["fixed that is no list", withStep({ fixed: left }), "steps[0].fixed", "object"],
    ["a fixed region that selects nothing", withStep({ fixed: [left, half([1, 0, 0], 5)] }),
      "steps[0].fixed[1]", "no vertex"],
    ["no iterations", withStep({ solve: { iterations: 0 } }), "steps[0].solve.iterations", "0"],
    ["a tolerance of zero", withStep({ solve: { tolerance: 0 } }), "steps[0].solve.tolerance", "0"],
    ["an unknown key of solve", withStep({ solve: { maxIterations: 3 } }),
      "steps[0].solve.maxIterations", "iterations"],
    ["a negative seed", script([step], { seed: -1 }), "seed", "-1"],
    ["a fault in a later step", script([step, { ...step, handles: [{ ...hand, select: half([1, 0, 0], 50) }] }]),
      "steps[1].handles[0].select", "no vertex"],
    ["an unknown key of a drag", withDrag({ count: 2 }), "steps[0].drag[0].count", "iterations"],
    ["a drag of no iterations", withDrag({ iterations: 0 }), "steps[0].drag[0].iterations", "0"],
    ["a drag of an unknown handle", withDrag({ handles: [{ name: "foot", move: {} }] }),
      "steps[0].drag[0].handles[0].name", '"foot"'],
    ["a drag of a handle twice", withDrag({ handles: [{ name: "hand", move: {} }, { name: "hand", move: {} }] }),
      "steps[0].drag[0].handles[1].name", "hand"],
    ["a drag to nowhere", withDrag({ handles: [{ name: "hand" }] }), "steps[0].drag[0].handles[0]", "move nor targets"],
    ["a drag to too few targets", withDrag({ handles: [{ name: "hand", targets: [[0, 0, 0]] }] }),
      "steps[0].drag[0].handles[0].targets", "1 points"],
    ["an option that cannot change in a drag", withDrag({ options: { nodeCount: 3 } }),
      "steps[0].drag[0].options.nodeCount", "during a drag"],
    ["steps and keyframes", script([step], { keyframes: [key(0, [step])] }), "keyframes", "steps"],
    ["frames without keyframes", script([step], { frames: 3 }), "frames", "without keyframes"],
    ["keyframes without frames", keyed([key(0, [step])], {}), "frames", "undefined"],
    ["no keyframes", keyed([]), "keyframes", "empty"],
    ["a keyframe without a time", keyed([key(undefined, [step])]), "keyframes[0].time", "undefined"],
    ["keyframes out of order", keyed([key(1, [step]), key(1, [step])]), "keyframes[1].time", "1"],
    ["a keyframe with another number of steps", keyed([key(0, [step]), key(1, [step, step])]),
      "keyframes[1].steps", "2 steps"],
    ["a keyframe with other options", other({ options: { nodeCount: 21 } }),
      "keyframes[1].steps[0].options", "differs"],
    ["a keyframe with other vertices", other({ handles: [{ ...hand, select: { vertices: rightIds } }] }),
      "keyframes[1].steps[0].handles[0].select", "differs"],
    [
      "a keyframe with another axis",
      keyed(
        [10, 20].map((degrees, i) =>
          key(i, [{ ...step, handles: [{ ...hand, move: { rotate: { axis: [i, 1, 0], degrees } } }] }]),
        ),
      ),
      "keyframes[1].steps[0].handles[0].move.rotate.axis",
      "differs",
    ],
    [
      "a keyframe with targets for a move",
      other({ handles: [{ ...hand, move: undefined, targets: rightIds.map(() => [0, 0, 0]) }] }),
      "keyframes[1].steps[0].handles[0]",
      "targets",
      "a move",
    ],
    ["a keyframe with a drag", other({ drag: [{ handles: [{ name: "hand", move: {} }] }] }),
      "keyframes[1].steps[0].drag"],
  ];

  it.each(rows)("%s", async (_, value, ...says) => {
    const error = await errorOf(() => run(value));
    expect(error.code).toBe("invalid-script");
    for (const words of says) expect(error.message).toContain(words);
    expect(error.message).not.toContain("\n");
  });

  it("options of the call itself that are wrong", async () => {
    expect((await errorOf(() => pliant.edit({} as never, script([step]) as never))).code).toBe("invalid-option");
    expect((await errorOf(() => run(script([step]), shape, { onprogress: () => {} }))).message).toContain(
      "options.onprogress",
    );
    expect((await errorOf(() => run(script([step]), shape, { signal: 1 }))).message).toContain("options.signal");
  });

  it("and the next one runs", async () => {
    for (const [, value] of rows) await errorOf(() => run(value));
    expect((await run(script([step]))).positions).toEqual(await byHand());
  });
});
