// The living edit: what it promises, over every method and sketches.

import { Worker } from "node:worker_threads";
import { describe, expect, it, vi } from "vitest";
import { editCases, methodNames } from "./support/edits.js";
import { half, script } from "./support/edit_script.js";
import { limb } from "./support/limb.js";
import { entries, errorOf, pliant } from "./support/package.js";
import { sheet, where } from "./support/shapes.js";

type Edit = ReturnType<typeof pliant.open>;
type Document = Parameters<Edit["apply"]>[0];

const document = (steps: object[], more: object = {}) => script(steps, more) as Document;
const doubles = (edit: Edit) => edit.positions(new Float64Array(edit.shape.dimension * edit.vertices));
const distance = (a: ArrayLike<number>, b: ArrayLike<number>) => {
  expect(a.length).toBe(b.length);
  return a.length === 0 ? 0 : Math.max(...Array.from(a, (x, i) => Math.abs(x - b[i])));
};
const costs = (edit: Edit) =>
  edit
    .report()
    .steps.reduce((sum, { factorizations, finish }) => sum + factorizations + (finish?.factorizations ?? 0), 0);
const analyses = (edit: Edit) => edit.report().steps.reduce((sum, step) => sum + step.analyses, 0);
/** Without what a clock says. */
const timeless = (of: object) =>
  JSON.parse(JSON.stringify(of, (key, value) => (/^(ms|setupMs)$/.test(key) ? 0 : value)));
/** Opens, applies and runs to the end. */
const carriedOut = (shape: Edit["shape"], ...documents: Document[]) => {
  const edit = pliant.open(shape);
  for (const one of documents) {
    edit.apply(one);
    edit.run();
  }
  return edit;
};

describe.each(Object.entries(editCases))("a living edit: %s", (name, { mesh, step, moved, held }) => {
  const shape = pliant.shape(mesh);
  const [first, second, third] = [document([step]), document([moved]), document([held])];
  const solves = !["sketch", "place"].includes(name);
  const tolerance = (solves ? 2e-4 : 1e-12) * shape.diagonal;

  it("is at rest until it runs", () => {
    const edit = pliant.open(shape);
    expect(doubles(edit)).toEqual(Float64Array.from(mesh.positions));
    expect(edit.run()).toMatchObject({ iterations: 0, converged: true });
    edit.apply(first);
    expect(doubles(edit)).toEqual(Float64Array.from(mesh.positions));
    expect(edit.report().steps).toEqual([]);
    expect(edit.normals()).toHaveLength(mesh.positions.length);
  });

  it("comes to what pliant.edit gives", async () => {
    const edit = carriedOut(shape, first);
    const { positions, report, state } = await pliant.edit(shape, first as never);
    expect(distance(doubles(edit), positions)).toBeLessThanOrEqual(1e-9 * shape.diagonal);
    expect(distance(positions, mesh.positions)).toBeGreaterThan(0.01 * shape.diagonal);
    expect(edit.state()).toEqual(state);
    expect(timeless(edit.report())).toEqual(timeless(report));
  });

  it("does the same in small pieces", () => {
    const [whole, pieces] = [carriedOut(shape, first), pliant.open(shape)];
    pieces.apply(first);
    for (let run = pieces.run({ milliseconds: 0 }); !run.converged; run = pieces.run({ milliseconds: 0 })) {
      expect(run.iterations).toBeLessThanOrEqual(1);
    }
    expect(doubles(pieces)).toEqual(doubles(whole));
  });

  it("is given the same document twice and does nothing", () => {
    const edit = carriedOut(shape, first);
    const [before, cost] = [doubles(edit), costs(edit)];
    for (const again of [first, structuredClone(first)]) {
      edit.apply(again);
      expect(edit.run()).toMatchObject({ iterations: 0, converged: true });
    }
    expect(doubles(edit)).toEqual(before);
    expect(costs(edit)).toBe(cost);
  });

  it("moves targets without a factorisation, and ends where the document alone does", () => {
    const edit = carriedOut(shape, first);
    const cost = costs(edit);
    edit.apply(second);
    edit.run();
    expect(costs(edit)).toBe(cost);
    expect(distance(doubles(edit), doubles(carriedOut(shape, second)))).toBeLessThan(tolerance);
    expect(distance(doubles(edit), doubles(carriedOut(shape, first)))).toBeGreaterThan(0.01 * shape.diagonal);
  });

  it("takes other constraints, also half way", () => {
    const edit = carriedOut(shape, first);
    edit.apply(second);
    edit.run({ iterations: 1 });
    edit.apply(third);
    edit.run();
    expect(distance(doubles(edit), doubles(carriedOut(shape, third)))).toBeLessThan(tolerance);
  });

  it("undoes by the document before", () => {
    const edit = carriedOut(shape, first, second, first);
    expect(distance(doubles(edit), doubles(carriedOut(shape, first)))).toBeLessThan(tolerance);
  });

  it("carries out the newest document alone", () => {
    const edit = pliant.open(shape);
    for (const one of [first, third, second]) edit.apply(one);
    edit.run();
    expect(doubles(edit)).toEqual(doubles(carriedOut(shape, second)));
  });

  it("comes back to a moment exactly, at once, with nothing left to do; also after JSON, in another edit", () => {
    const edit = carriedOut(shape, first);
    const [then, moment] = [doubles(edit), edit.moment()];
    const written = JSON.stringify(moment);
    edit.apply(third);
    edit.run();
    const other = carriedOut(shape, second);
    for (const [one, value] of [[edit, moment], [other, JSON.parse(written)]] as [Edit, Document][]) {
      one.apply(value);
      expect(distance(doubles(one), then)).toBeLessThan(1e-13 * shape.diagonal);
      expect(one.run()).toMatchObject({ iterations: 0, converged: true });
      expect(one.report().steps[0].iterations).toHaveLength(edit.report().steps[0].iterations.length);
    }
    expect(JSON.stringify(moment)).toBe(written);
  });

  it("comes back to a moment that was under way, and goes on from there", () => {
    const edit = pliant.open(shape);
    const rest = edit.moment();
    edit.apply(second);
    edit.run({ iterations: 2 });
    const [then, moment] = [doubles(edit), edit.moment()];
    edit.apply(first);
    edit.run();
    edit.apply(moment);
    expect(distance(doubles(edit), then)).toBeLessThan(1e-13 * shape.diagonal);
    edit.run();
    expect(distance(doubles(edit), doubles(carriedOut(shape, second)))).toBeLessThan(tolerance);
    edit.apply(rest);
    expect(doubles(edit)).toEqual(Float64Array.from(mesh.positions));
    expect(edit.run()).toMatchObject({ iterations: 0 });
  });

  it("stays as it is under a document that is none", async () => {
    const edit = carriedOut(shape, first);
    const [before, cost] = [doubles(edit), costs(edit)];
    const bad: [unknown, string][] = [
      [{ ...first, version: 2 }, "version"],
      [document([{ ...step, hndles: [] }]), "steps[0].hndles"],
      [document([step, { method: "clay" }]), "steps[1].method"],
      [
        document([step, { method: "arap", handles: [{ select: { vertices: [-1] }, move: {} }] }]),
        "steps[1].handles[0].select.vertices[0]",
      ],
      [
        document([{ method: "arap", handles: [{ select: half([1, 0, 0], 99), move: {} }] }]),
        "steps[0].handles[0].select",
      ],
      [document([{ method: "place", parts: [{ select: { all: true } }] }]), "steps[0].parts[0]"],
      [{ format: "pliant-edit", version: 1, frames: 2, keyframes: [{ time: 0, steps: [step] }] }, "keyframes"],
      [{ format: "pliant-moment", version: 1, document: first, stages: 3 }, "moment.stages"],
      [null, "script"],
    ];
    for (const [value, place] of bad) {
      const { code, message } = await errorOf(() => edit.apply(value as Document));
      expect([code, message]).toEqual(["invalid-script", expect.stringContaining(place)]);
    }
    expect(edit.run()).toMatchObject({ iterations: 0, converged: true });
    expect([doubles(edit), costs(edit)]).toEqual([before, cost]);
  });

  it("frees itself alone", async () => {
    const edit = carriedOut(shape, first);
    edit.dispose();
    edit.dispose();
    for (const call of [
      () => edit.apply(first),
      () => edit.run(),
      () => edit.positions(),
      () => edit.moment(),
      () => edit.report(),
      () => edit.settle(),
    ]) {
      expect((await errorOf(call)).code).toBe("disposed");
    }
    expect(carriedOut(shape, first).run()).toMatchObject({ converged: true });
  });
});

const mesh = sheet(13);
const shape = pliant.shape(mesh);
const graph = editCases["embedded-graph"].step as Record<string, never> & { handles: object[] };
const material = { ...editCases["edge-material"].step } as Record<string, unknown>;

const left = { vertices: where(mesh.positions, (x) => x < 0.1) };
const hand = where(mesh.positions, (x) => x > 0.9);

describe("what a change costs", () => {
  const cost = (steps: object, next: object) => {
    const edit = carriedOut(shape, document([steps]));
    const before = [costs(edit), analyses(edit)];
    edit.apply(document([next]));
    edit.run();
    return [costs(edit) - before[0], analyses(edit) - before[1]];
  };

  it.each(methodNames)("follows the table: %s", (method) => {
    const { step, moved, held } = editCases[method] as unknown as Record<string, Record<string, unknown>>;
    expect(cost(step, moved)).toEqual([0, 0]);
    expect(cost(step, { ...step, solve: { iterations: 500, tolerance: 1e-10 } })).toEqual([0, 0]);
    expect(cost(step, held)[0]).toBe(1);
    expect(
      cost(step, { ...step, drag: [{ handles: [{ name: "hand", move: { translate: [0, 0, 0.3] } }], iterations: 3 }] }),
    ).toEqual([0, 0]);
  });

  it("of live options: none where the matrix stays, else one", () => {
    const changed = (more: object) => ({ ...material, options: { ...(material.options as object), ...more } });
    expect(cost(changed({ pStretch: 1 }), changed({ pStretch: 0.5 }))).toEqual([0, 0]);
    expect(cost(changed({ gravity: [0, 0, 0] }), changed({ gravity: [0, 0, -1] }))).toEqual([0, 0]);
    expect(cost(material, changed({ stretch: 5 }))).toEqual([1, 0]);
    expect(cost(material, changed({ field: { axis: [1, 0, 0] } }))).toEqual([1, 0]);
  });

  it("is a new model where an option builds, or one that was given is left out", () => {
    const builds = { ...graph, options: { nodeCount: 40 } };
    const edit = carriedOut(shape, document([graph]), document([builds]));
    expect(doubles(edit)).toEqual(doubles(carriedOut(shape, document([builds]))));
    const plain = { ...material, options: {} };
    const live = carriedOut(shape, document([material]), document([plain]));
    expect(doubles(live)).toEqual(doubles(carriedOut(shape, document([plain]))));
  });

  it("is nothing for a model that a later document, too, does without", () => {
    const edit = carriedOut(shape, document([graph]));
    const before = costs(edit);
    edit.apply(document([{ ...graph, options: { nodeCount: 40 } }]));
    edit.apply(document([graph]));
    expect(edit.run()).toMatchObject({ iterations: 0, converged: true });
    expect(costs(edit)).toBe(before);
  });
});

describe("a drag", () => {
  const to = (z: number, iterations: number, more = {}) => ({
    handles: [{ name: "hand", move: { translate: [0, 0, z] } }], iterations, ...more,
  });
  const drag = (...entries: object[]) => document([{ ...graph, drag: entries }]);

  it("grows entry by entry, and only the new one is carried out", async () => {
    const edit = pliant.open(shape);
    edit.apply(drag());
    edit.run();
    const done = edit.report().steps[0].iterations.length;
    for (const entries of [[to(0.3, 2)], [to(0.3, 2), to(0.35, 3)]]) {
      edit.apply(drag(...entries));
      const { iterations } = edit.run();
      expect(iterations).toBe(entries.at(-1)!.iterations);
    }
    const [step] = edit.report().steps;
    expect(step.iterations).toHaveLength(done);
    expect(step.drag!.map(({ iterations }) => iterations.length)).toEqual([2, 3]);
    const { positions, report } = await pliant.edit(shape, drag(to(0.3, 2), to(0.35, 3)) as never);
    expect(doubles(edit)).toEqual(positions);
    expect(report.steps[0].drag!.map(({ iterations }) => iterations.length)).toEqual([2, 3]);
  });

  it("is written down as it happens: what has been done so far is the entry's iterations", async () => {
    const edit = pliant.open(shape);
    edit.apply(drag(to(0.3, 300)));
    edit.run({ iterations: 4 });
    const done = edit.report().steps[0];
    expect(done.drag).toBeUndefined();
    const solve = { iterations: done.iterations.length, tolerance: 1e-9 };
    const session = (...entries: object[]) => document([{ ...graph, solve, drag: entries }]);
    edit.apply(session(to(0.28, 300)));
    edit.run({ iterations: 3 });
    edit.apply(session(to(0.28, 3), to(0.33, 300)));
    edit.run({ iterations: 2 });
    const { positions } = await pliant.edit(shape, session(to(0.28, 3), to(0.33, 2)) as never);
    expect(doubles(edit)).toEqual(positions);
  });

  it("begins anew where an earlier entry is another", () => {
    const edit = carriedOut(shape, drag(to(0.3, 50), to(0.35, 50)), drag(to(0.2, 50), to(0.35, 50)));
    expect(distance(doubles(edit), doubles(carriedOut(shape, drag(to(0.2, 50), to(0.35, 50)))))).toBeLessThan(2e-4);
  });

  it("comes back at a moment with its options and targets", () => {
    const step = { ...material, drag: [to(0.3, 2, { options: { stretch: 9 } })] };
    const edit = carriedOut(shape, document([step]));
    const [moment, then, { energy }] = [edit.moment(), doubles(edit), edit.report().steps[0]];
    edit.apply(document([material]));
    edit.run();
    edit.apply(moment);
    expect(distance(doubles(edit), then)).toBeLessThan(1e-13);
    expect(edit.report().steps[0].energy.total).toBeCloseTo(energy.total, 9);
    const longer = document([{ ...step, drag: [...step.drag, to(0.4, 60)] }]);
    edit.apply(longer);
    edit.run();
    expect(distance(doubles(edit), doubles(carriedOut(shape, longer)))).toBeLessThan(1e-3);
  });
});

describe("several steps", () => {
  const place = { method: "place", parts: [{ select: half([1, 0, 0], 0.9), move: { translate: [0, 0.1, 0] } }] };
  const second = {
    ...material,
    fixed: [half([0, -1, 0], -0.1)],
    handles: [{ select: half([0, 1, 0], 1.05), move: { translate: [0, 0, 0.1] } }],
  };
  const steps = [graph, place, second];

  it("are carried out one after another, as by pliant.edit", async () => {
    const edit = pliant.open(shape);
    edit.apply(document(steps));
    const seen = new Set<number>();
    for (let run = edit.run({ iterations: 1 }); !run.converged; run = edit.run({ iterations: 1 })) seen.add(run.step);
    expect([...seen]).toEqual([0, 1, 2]);
    const { positions, report } = await pliant.edit(shape, document(steps) as never);
    expect(distance(doubles(edit), positions)).toBeLessThanOrEqual(1e-9 * shape.diagonal);
    expect(report.steps.map(({ method }) => method)).toEqual(["embedded-graph", "place", "edge-material"]);
    expect(edit.report().quality).toEqual(report.quality);
    const moment = edit.moment();
    edit.apply(document([graph]));
    edit.run();
    expect(edit.report().steps).toHaveLength(1);
    edit.apply(moment);
    expect(distance(doubles(edit), positions)).toBeLessThan(1e-12);
    expect(edit.run()).toMatchObject({ iterations: 0, converged: true });
  });

  it("keep those before one that changes, and build those after it anew", () => {
    const edit = carriedOut(shape, document(steps));
    const [before] = [edit.report().steps];
    edit.apply(
      document([graph, place, { ...second, handles: [{ ...second.handles[0], move: { translate: [0, 0, 0.2] } }] }]),
    );
    edit.run();
    expect(edit.report().steps.map(({ factorizations }) => factorizations)).toEqual(
      before.map(({ factorizations }) => factorizations),
    );
    const moved = [editCases["embedded-graph"].moved, place, second];
    edit.apply(document(moved));
    edit.run();
    const after = edit.report().steps.map(({ factorizations }) => factorizations);
    expect([after[0] - before[0].factorizations, after[2] - before[2].factorizations]).toEqual([0, 1]);
    expect(distance(doubles(edit), doubles(carriedOut(shape, document(moved))))).toBeLessThan(1e-3);
  });

  it("whose selection fails on the result before leave the last good one", async () => {
    const edit = carriedOut(shape, document([graph]));
    const [good, moment] = [doubles(edit), edit.moment()];
    const far = { ...second, handles: [{ select: half([0, 1, 0], 9), move: {} }] };
    edit.apply(document([graph, far]));
    for (let i = 0; i < 2; ++i) {
      const { code, message } = await errorOf(() => edit.run());
      expect([code, message]).toEqual(["invalid-script", expect.stringContaining("steps[1].handles[0].select")]);
    }
    expect(doubles(edit)).toEqual(good);
    const near = { ...far, handles: [{ select: half([0, 1, 0], 0.95), move: { translate: [0, 0, 0.1] } }] };
    edit.apply(document([graph, near]));
    edit.run();
    expect(distance(doubles(edit), doubles(carriedOut(shape, document([graph, near]))))).toBeLessThan(1e-12);
    edit.apply(moment);
    expect(doubles(edit)).toEqual(good);
  });

  it("put models away that are not needed, and make them again where they are", async () => {
    const turn = (z: number) => ({
      ...graph, fixed: [left], handles: [{ name: "hand", select: { vertices: hand }, move: { translate: [0, 0, z] } }],
    });
    const many = [0.1, -0.05, 0.1, -0.05, 0.1, 0.05].map(turn);
    const edit = carriedOut(shape, document(many));
    const { positions, report } = await pliant.edit(shape, document(many) as never);
    expect(doubles(edit)).toEqual(positions);
    expect(edit.report().steps.map(({ method, factorizations }) => [method, factorizations])).toEqual(
      report.steps.map(({ method, factorizations }) => [method, factorizations]),
    );
    const moment = edit.moment();
    for (const count of [5, 2]) {
      edit.apply(document(many.slice(0, count)));
      expect(edit.run()).toMatchObject({ iterations: 0, converged: true });
      expect(distance(doubles(edit), doubles(carriedOut(shape, document(many.slice(0, count)))))).toBeLessThan(1e-12);
    }
    edit.apply(moment);
    expect(distance(doubles(edit), positions)).toBeLessThan(1e-12);
    const changed = many.map((step, i) => (i === 1 ? turn(-0.1) : step));
    edit.apply(document(changed));
    edit.run();
    expect(distance(doubles(edit), doubles(carriedOut(shape, document(changed))))).toBeLessThan(1e-3);
  });

  it("take the region of the sketch before, and what refinement has added", () => {
    const { step, moved } = editCases.sketch;
    const coarse = limb(12, 13);
    const target = pliant.shape(coarse);
    const refined = document([
      { ...moved, refine: true },
      { method: "arap", handles: [{ select: { all: true }, move: { translate: [0, 0, 1] } }] },
      { ...step, region: "previous" },
    ]);
    const edit = carriedOut(target, refined);
    expect(edit.vertices).toBeGreaterThan(coarse.positions.length / 3);
    expect(edit.refinement()!.parents).toHaveLength(2 * (edit.vertices - coarse.positions.length / 3));
    expect(edit.sketch()!.labels).toHaveLength(edit.vertices);
    const [then, moment] = [doubles(edit), edit.moment()];
    edit.apply(document([step]));
    edit.run();
    expect([edit.vertices, edit.refinement()]).toEqual([coarse.positions.length / 3, undefined]);
    edit.apply(moment);
    expect(distance(doubles(edit), then)).toBeLessThan(1e-12);
    const onAdded = document([
      { ...moved, refine: true },
      { method: "arap", handles: [{ select: { vertices: [edit.vertices - 1] }, move: {} }] },
    ]);
    edit.apply(onAdded);
    expect(edit.run()).toMatchObject({ step: 1, converged: true });
  });
});

describe("a run", () => {
  it("ends with its time, after at least one iteration", () => {
    const edit = pliant.open(pliant.shape(sheet(41)));
    edit.apply(document([{ ...graph, options: { nodeCount: 200 } }]));
    expect(edit.run({ milliseconds: 0 }).iterations).toBeLessThanOrEqual(1);
    expect(edit.run({ milliseconds: 0 }).iterations).toBe(1);
    expect(edit.run({ iterations: 2 }).iterations).toBe(2);
  });

  it("that is aborted leaves the last good result, and goes on later", async () => {
    const edit = pliant.open(shape);
    edit.apply(document([graph]));
    const controller = new AbortController();
    const outcome = errorOf(() =>
      edit.settle({
        signal: controller.signal,
        onProgress: ({ iteration }) => {
          if (iteration === 2) controller.abort();
        },
      }),
    );
    expect((await outcome).code).toBe("aborted");
    expect(distance(doubles(edit), doubles(pliant.open(shape)))).toBeGreaterThan(0);
    expect(await edit.settle()).toMatchObject({ iterations: 0, converged: true });
    expect(doubles(edit)).toEqual(doubles(carriedOut(shape, document([graph]))));
  });

  it("refuses limits that are none", async () => {
    const edit = pliant.open(shape);
    for (const [options, says] of [
      [{ iterations: 0 }, "options.iterations"],
      [{ milliseconds: -1 }, "options.milliseconds"],
      [{ seconds: 1 }, "options.seconds"],
      [8, "options"],
    ] as const) {
      expect(await errorOf(() => edit.run(options as never))).toEqual({
        code: "invalid-option", message: expect.stringContaining(says),
      });
    }
    expect((await errorOf(() => pliant.open({} as never))).code).toBe("invalid-option");
    expect((await errorOf(() => edit.positions(new Float32Array(3)))).message).toContain("out");
  });
});

describe("a history", () => {
  it("shares what does not change between moments", () => {
    const edit = pliant.open(shape);
    const states = Array.from({ length: 3 }, (_, i) => {
      edit.apply(document([{ ...graph, handles: [{ ...graph.handles[0], move: { translate: [0, 0, 0.1 * i] } }] }]));
      edit.run();
      return edit.moment().stages[0].state!;
    });
    for (const key of ["nodes", "edges", "influences"]) expect(states[2][key]).toBe(states[1][key]);
    expect(states[2].translations).not.toEqual(states[1].translations);
  });
});

describe("a place step", () => {
  const targets = hand.map((v) => [v, 0, 1]);

  it("puts vertices where it says, and the rest stays", async () => {
    const { positions, report, state } = await pliant.edit(
      shape, document([{ method: "place", parts: [{ select: { vertices: hand }, targets }] }]) as never,
    );
    const expected = Float64Array.from(mesh.positions);
    hand.forEach((v, i) => expected.set(targets[i], 3 * v));
    expect(positions).toEqual(expected);
    expect(report.steps[0]).toMatchObject({ method: "place", unknowns: 0, factorizations: 0, converged: true });
    expect(state).toEqual({ handles: [{ vertices: hand, targets }] });
  });

  it("moves as a handle does", () => {
    const move = { scale: 1.5, rotate: { axis: [1, 2, 0.5], degrees: 200 }, translate: [0.3, 0, -1] };
    const edit = carriedOut(shape, document([{ method: "place", parts: [{ select: { vertices: hand }, move }] }]));
    const deformer = pliant.deformer(shape, { method: "arap" });
    deformer.addHandle(hand).move(move);
    const { targets: expected } = deformer.state().handles[0];
    expect(
      distance(hand.flatMap((v) => Array.from(doubles(edit).subarray(3 * v, 3 * v + 3))), expected.flat()),
    ).toBeLessThan(1e-12);
  });

  it("has the normals of its surface", () => {
    const edit = carriedOut(
      shape,
      document([
        { method: "place", parts: [{ select: { all: true }, move: { rotate: { axis: [1, 0, 0], degrees: 180 } } }] },
      ]),
    );
    const [now, before] = [edit.normals(), pliant.open(shape).normals()];
    expect(distance(now.map((x, i) => (i % 3 === 0 ? x : -x)), before)).toBeLessThan(1e-5);
    expect(distance(before, pliant.deformer(shape, { method: "arap" }).normals())).toBeLessThan(1e-5);
  });

  it.each([
    ["too few targets", { select: { vertices: hand }, targets: targets.slice(1) }, "steps[0].parts[0].targets"],
    ["nothing to place", { select: half([1, 0, 0], 5), move: {} }, "steps[0].parts[0].select"],
    ["no goal", { select: { vertices: hand } }, "steps[0].parts[0]"],
    ["an unknown key", { select: { vertices: hand }, mvoe: {} }, "steps[0].parts[0].mvoe"],
  ])("is refused for %s", async (_, part, says) => {
    const { code, message } = await errorOf(() =>
      pliant.open(shape).apply(document([{ method: "place", parts: [part] }])),
    );
    expect([code, message]).toEqual(["invalid-script", expect.stringContaining(says)]);
  });
});

describe("key frames", () => {
  const frames = (method: string) => {
    const { step } = editCases[method] as unknown as { step: { handles: { move: { translate: number[] } }[] } };
    const at = (z: number) => [{ ...step, handles: [{ ...step.handles[0], move: { translate: [0, 0, z] } }] }];
    return {
      at,
      script: {
        format: "pliant-edit",
        version: 1,
        frames: 4,
        keyframes: [{ time: 0, steps: at(0) }, { time: 3, steps: at(0.3) }],
      },
    };
  };

  it.each(methodNames)(
    "are documents in turn over one edit, each as if it were alone: %s",
    async (method) => {
      const { at, script: animation } = frames(method);
      const result = await pliant.edit(shape, animation as never);
      // Rounded as between key frames, and then the same to the last bit.
      for (const [frame, z] of [[3, 0.3], [1, 0.3 / 3]]) {
        const { positions } = await pliant.edit(shape, document(at(z)) as never);
        expect(distance(result.frames![frame], positions)).toBe(0);
      }
      expect(result.report.frames!.map(({ steps }) => steps[0].factorizations)).toEqual([1, 0, 0, 0]);
    },
  );
});

describe.each([{ inline: false }, { inline: true }])("in the worker $inline", ({ inline }) => {
  it.each(Object.entries(editCases))(
    "gives the same numbers by promises: %s",
    async (_, { mesh: rest, step, moved, held }) => {
      const library = await entries.worker.init({ inline });
      const [there, here] = [await library.open(await library.shape(rest)), pliant.open(pliant.shape(rest))];
      const entry = (z: number) => ({ handles: [{ name: "hand", move: { translate: [0, 0, z] } }], iterations: 2 });
      const dragged =
        "handles" in step ? [[entry(0.3)], [entry(0.3), entry(0.4)]].map((drag) => document([{ ...moved, drag }])) : [];
      for (const one of [document([step]), document([moved]), ...dragged, document([step, held]), document([held])]) {
        here.apply(one);
        here.run({ iterations: 3 });
        here.run();
        const [, , run, positions, normals] = await Promise.all([
          there.apply(one), there.run({ iterations: 3 }), there.run(), there.positions(), there.normals(),
        ]);
        expect(run.converged).toBe(true);
        expect(positions).toEqual(here.positions());
        expect(normals).toEqual(here.normals());
        const out = new Float64Array(rest.positions.length);
        expect(await there.positions(out)).toBe(out);
        expect(out).toEqual(doubles(here));
      }
      expect(await there.state()).toEqual(here.state());
      const moment = await there.moment();
      expect(timeless(moment)).toEqual(timeless(here.moment()));
      await there.apply(document([moved]));
      await there.settle({ onProgress: ({ steps }) => expect(steps).toBe(1) });
      await there.apply(moment);
      expect(distance(await there.positions(), here.positions())).toBeLessThan(1e-7);
      expect((await there.report()).quality).toBeDefined();
      expect(await there.sketch()).toEqual(here.sketch());
      await there.reset();
      const { code, message } = await errorOf(() => there.apply(document([step, { method: "clay" }])));
      expect([code, message]).toEqual(["invalid-script", expect.stringContaining("steps[1].method")]);
      await there.apply(document([step]));
      expect((await there.run()).converged).toBe(true);
      await there.dispose();
      expect((await errorOf(() => there.run())).code).toBe("disposed");
    },
  );
});

describe("a frame in the worker", () => {
  it("costs one message each way, and of a document what is new", async () => {
    const library = await entries.worker.init({ inline: false });
    const big = sheet(61);
    const there = await library.open(await library.shape(big));
    const [fixed, select] = [
      [{ vertices: where(big.positions, (x) => x < 0.4) }], { vertices: where(big.positions, (x) => x > 0.6) },
    ];
    const at = (z: number) =>
      document([{ method: "arap", fixed, handles: [{ name: "hand", select, move: { translate: [0, 0, z] } }] }]);
    await there.apply(at(0.1));
    const [sent, received] = [vi.spyOn(Worker.prototype, "postMessage"), vi.spyOn(Worker.prototype, "emit")];
    try {
      const frame = await Promise.all([
        there.apply(at(0.2)), there.run({ iterations: 2 }), there.positions(), there.normals(),
      ]);
      expect(frame[1].iterations).toBe(2);
      expect(sent).toHaveBeenCalledTimes(1);
      expect(received.mock.calls.filter(([event]) => event === "message")).toHaveLength(1);
      expect(JSON.stringify(sent.mock.calls[0][0]).length).toBeLessThan(2000);
    } finally {
      sent.mockRestore();
      received.mockRestore();
    }
    const here = carriedOut(pliant.shape(big), at(0.2));
    await there.run();
    expect(distance(await there.positions(), here.positions())).toBeLessThan(1e-4);
  });
});
