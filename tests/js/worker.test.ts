// pliant/worker: the same calls as promises, from files of the package and from inside the script.

import { execFileSync } from "node:child_process";
import { Worker } from "node:worker_threads";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { consumer, entries, errorOf, pliant } from "./support/package.js";
import { sheet, where } from "./support/shapes.js";

const mesh = sheet(15);
const left = where(mesh.positions, (x) => x < 0.15);
const right = where(mesh.positions, (x) => x > 0.9);
const options = { method: "embedded-graph", nodeCount: 30 } as const;

let expected: Float32Array;
beforeAll(async () => {
  const deformer = pliant.deformer(pliant.shape(mesh), options);
  deformer.setFixed(left);
  deformer.addHandle(right).move({ translate: [0, 0, 0.3] });
  await deformer.solve();
  expected = deformer.positions();
});

describe.each([{ inline: false }, { inline: true }])("pliant/worker $inline", ({ inline }) => {
  const start = () => entries.worker.init({ inline });
  afterAll(async () => (await start()).dispose());

  it("gives the same results by promises", async () => {
    const library = await start();
    expect(await start()).toBe(library);
    const shape = await library.shape(mesh);
    expect(shape.report).toEqual(pliant.shape(mesh).report);
    expect(await shape.select({ vertices: [3, 1] })).toEqual(Uint32Array.of(1, 3));
    const deformer = await library.deformer(shape, options);
    await deformer.setFixed(new Set(left));
    const hand = await deformer.addHandle(right.values());
    expect(Array.from(hand.vertices)).toEqual(right);
    await hand.move({ translate: [0, 0, 0.3] });
    const seen: number[] = [];
    const solution = await deformer.solve({ onProgress: ({ energy }) => seen.push(energy) });
    expect(solution.converged).toBe(true);
    expect(seen.length).toBeGreaterThanOrEqual(solution.iterations);
    expect(await deformer.positions()).toEqual(expected);
    const doubles = new Float64Array(mesh.positions.length);
    expect(await deformer.positions(doubles)).toBe(doubles);
    expect(Float32Array.from(doubles)).toEqual(expected);
    expect(doubles).not.toEqual(Float64Array.from(expected));
    expect(await deformer.transformPoints(mesh.positions)).toBeInstanceOf(Float64Array);
    expect(await deformer.normals()).toHaveLength(mesh.positions.length);
    const state = await deformer.state();
    await deformer.reset();
    expect(await deformer.positions()).toEqual(Float32Array.from(mesh.positions));
    await deformer.restore(state);
    expect((await deformer.energy()).total).toBeCloseTo(solution.energy, 6);
    expect((await deformer.counters()).factorizations).toBeGreaterThan(0);
    expect((await deformer.step()).energy).toBeLessThanOrEqual(solution.energy * (1 + 1e-6));
    expect((await library.measure(shape, mesh.positions)).area).toBe(1);
    await hand.moveTo(right.flatMap(() => [0, 0, 0]));
    await hand.remove();
    await deformer.dispose();
    expect((await errorOf(() => deformer.step())).code).toBe("disposed");
  });

  it("leaves the caller's arrays alone", async () => {
    const positions = Float32Array.from(mesh.positions);
    await (await start()).shape({ positions });
    expect(positions).toHaveLength(mesh.positions.length);
  });

  it("takes arguments as they were at the call, and no object that was not made there", async () => {
    const library = await start();
    const shape = await library.shape(mesh);
    const deformer = await library.deformer(shape, options);
    const hand = await deformer.addHandle([0]);
    const target = Float64Array.of(0, 0, 0.25);
    const moved = hand.moveTo(target);
    target[2] = 9;
    await moved;
    expect(target).toHaveLength(3);
    expect((await deformer.state()).handles[0].targets[0][2]).toBeCloseTo(0.25, 12);
    expect((await errorOf(() => library.deformer({ object: 1 } as never, options))).code).toBe("invalid-option");
  });

  it("knows its handles", async () => {
    const deformer = await (await start()).deformer(await (await start()).shape(mesh), options);
    expect(deformer.handles).toEqual([]);
    const [a, b] = await Promise.all([deformer.addHandle(left), deformer.addHandle(right)]);
    expect(deformer.handles).toEqual([a, b]);
    await a.remove();
    expect(deformer.handles).toEqual([b]);
    expect((await errorOf(() => deformer.addHandle([right[0]]))).code).toBe("invalid-handle");
    expect(deformer.handles).toEqual([b]);
  });

  it("takes one message each way for a frame, and moves its arrays", async () => {
    const library = await start();
    const deformer = await library.deformer(await library.shape(mesh), options);
    await (await deformer.addHandle(right)).move({ translate: [0, 0, 0.3] });
    const [hand] = deformer.handles;
    const target = Float64Array.from(right.flatMap(() => [0, 0, 1]));
    const { messages, value } = await overheard(() =>
      Promise.all([hand.moveTo(target), deformer.step(), deformer.positions(), deformer.normals()]));
    expect(messages).toEqual(["to the worker", "to the page"]);
    const [, step, positions, normals] = value;
    expect(step.accepted).toBe(true);
    expect([positions.length, normals.length]).toEqual([mesh.positions.length, mesh.positions.length]);
    expect(target).toHaveLength(3 * right.length);
  });

  it("runs edit scripts, with progress and abort", async () => {
    const library = await start();
    const shape = await library.shape(mesh);
    const script = {
      format: "pliant-edit",
      version: 1,
      steps: [
        {
          method: "embedded-graph",
          options: { nodeCount: 30 },
          fixed: [{ vertices: left }],
          handles: [{ select: { vertices: right }, move: { translate: [0, 0, 0.3] } }],
        },
      ],
    } as const;
    let progress = 0;
    const { positions, report } = await library.edit(shape, script, { onProgress: () => ++progress });
    expect(Float32Array.from(positions)).toEqual(expected);
    expect(progress).toBeGreaterThanOrEqual(report.steps[0].iterations.length);
    expect((await errorOf(() => library.edit(shape, script, { signal: AbortSignal.abort() }))).code).toBe("aborted");
  });

  it("aborts what is under way", async () => {
    const library = await start();
    const big = await library.shape(sheet(101));
    const deformer = await library.deformer(big, { method: "embedded-graph", nodeCount: 400, solver: "gauss-newton" });
    await deformer.addHandle([0]);
    const hand = await deformer.addHandle([10200]);
    await hand.move({ translate: [0, 0, 0.5] });
    const controller = new AbortController();
    const solving = errorOf(() =>
      deformer.solve({ signal: controller.signal, tolerance: 1e-14, maxIterations: 1_000_000 }),
    );
    await deformer.counters();
    controller.abort(new RangeError("changed my mind"));
    expect(await solving).toMatchObject({ code: "aborted", cause: new RangeError("changed my mind") });
    expect((await deformer.step()).energy).toBeGreaterThan(0);
    const handles = [
      { select: { vertices: [0] } }, { select: { vertices: [10200] }, move: { translate: [0, 0, 0.5] } },
    ];
    const script = {
      format: "pliant-edit",
      version: 1,
      steps: [
        {
          method: "embedded-graph",
          options: { nodeCount: 400, solver: "gauss-newton" },
          handles,
          solve: { tolerance: 1e-14 },
        },
      ],
    };
    const stop = new AbortController();
    const editing = errorOf(() =>
      library.edit(big, script as never, { signal: stop.signal, onProgress: () => stop.abort() }),
    );
    expect((await editing).code).toBe("aborted");
  });

  it("passes errors on with their code, and what callbacks throw", async () => {
    const library = await start();
    const shape = await library.shape(mesh);
    const deformer = await library.deformer(shape, options);
    const calls: [string, () => unknown][] = [
      ["invalid-shape", () => library.shape({ positions: [1, NaN, 2] })],
      ["invalid-option", () => library.deformer(shape, { method: "clay" } as never)],
      ["invalid-option", () => library.deformer({} as never, options)],
      ["invalid-handle", () => deformer.addHandle([])],
      ["invalid-handle", () => deformer.setFixed([99999])],
      ["invalid-option", () => deformer.positions(new Float32Array(2))],
      ["invalid-option", () => deformer.normals(new Float64Array(2))],
      ["invalid-option", () => deformer.transformPoints([1, 2, 3], new Float64Array(6))],
      ["invalid-option", () => deformer.transformPoints([1, 2, 3], [0, 0, 0] as never)],
      ["invalid-option", () => deformer.transformPoints([1, 2])],
      ["invalid-option", () => deformer.solve({ maxIterations: 0 })],
      ["invalid-option", () => deformer.solve({ signal: 5 } as never)],
      ["invalid-option", () => library.shape({ positions: [0, 0, 0], triangles: [() => {}] } as never)],
      ["invalid-script", () => library.edit(shape, {} as never)],
    ];
    for (const [code, call] of calls) expect((await errorOf(call)).code, String(call)).toBe(code);
    await (await deformer.addHandle(right)).move({ translate: [0, 0, 0.3] });
    await expect(deformer.solve({ onProgress: () => { throw new RangeError("mine"); } })).rejects.toThrow(RangeError);
    expect((await deformer.solve()).energy).toBeGreaterThanOrEqual(0);
  });

  it("ends with dispose, and starts again", async () => {
    const library = await start();
    const shape = await library.shape(mesh);
    const waiting = errorOf(() => library.deformer(shape, options));
    library.dispose();
    expect((await waiting).code).toBe("disposed");
    expect((await errorOf(() => shape.select({ all: true }))).code).toBe("disposed");
    const next = await start();
    expect(next).not.toBe(library);
    expect((await next.shape(mesh)).report.vertices).toBe(225);
  });
});

/** What an action sends to workers and gets from them. */
async function overheard<T>(action: () => Promise<T>): Promise<{ messages: string[]; value: T }> {
  const messages: string[] = [];
  const { postMessage, emit } = Worker.prototype;
  Worker.prototype.postMessage = function (...args) {
    messages.push("to the worker");
    return postMessage.apply(this, args);
  };
  Worker.prototype.emit = function (this: Worker, ...args: unknown[]) {
    if (args[0] === "message") messages.push("to the page");
    return emit.apply(this, args as never);
  } as never;
  try {
    return { messages, value: await action() };
  } finally {
    Worker.prototype.postMessage = postMessage;
    Worker.prototype.emit = emit;
  }
}

describe("pliant/worker", () => {
  it("does not keep Node alive when idle", () => {
    const program = `
      import { init } from "pliant/worker";
      const shape = await (await init()).shape({ positions: [0, 0, 0, 1, 1, 1] });
      console.log(shape.report.vertices);`;
    expect(
      execFileSync(process.execPath, ["--input-type=module", "-e", program], { cwd: consumer, encoding: "utf8" }),
    ).toBe("2\n");
  });

  it("refuses options it does not know", async () => {
    expect((await errorOf(() => entries.worker.init({ wasm: 1 } as never))).message).toContain("options.wasm");
    expect((await errorOf(() => entries.worker.init({ inline: 1 } as never))).message).toContain("options.inline");
  });
});
