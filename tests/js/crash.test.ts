// A call that traps ends the module: one error says so, nothing else breaks, and init() starts another.

import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { describe, expect, it } from "vitest";
import { consumer, entries, errorOf, installed } from "./support/package.js";
import { crampedWasm, scramble, withMemory } from "./support/crash.js";
import { sheet } from "./support/shapes.js";

const mesh = sheet(60);
const big = { method: "embedded-graph", nodeCount: 3000, solver: "gauss-newton" } as const;
const small = { method: "arap" } as const;
/** 20 MB: enough for the shape and the graph, not for a factorisation. */
const cramped = () => crampedWasm(320);

/** An entry that has not been started yet. */
async function fresh(name: string, mark: string) {
  const url = `${pathToFileURL(join(installed, `dist/${name}.js`)).href}?${mark}`;
  const { init, PliantError } = (await import(/* @vite-ignore */ url)) as typeof entries.pliant;
  return { init, errorOf: (action: () => unknown) => errorOf(action, PliantError) };
}

describe.each(["pliant", "inline"])("%s", (name) => {
  it("says so where memory runs out, and starts again", async () => {
    const { init, errorOf } = await fresh(name, "memory");
    const first = await init({ wasmBinary: cramped() });
    const shape = first.shape(mesh);
    const deformer = first.deformer(shape, big);
    const hand = deformer.addHandle([0]);
    const failure = await errorOf(() => deformer.step());
    expect(failure).toMatchObject({ code: "crashed", message: expect.stringContaining("ran out of memory") });
    for (const call of [() => deformer.step(), () => hand.move({}), () => deformer.state(), () => first.shape(mesh)]) {
      expect(await errorOf(call)).toEqual(failure);
    }
    deformer.dispose();
    deformer.dispose();
    shape.dispose();
    expect((await errorOf(() => deformer.step())).code).toBe("disposed");
    const second = await init();
    expect(second).not.toBe(first);
    expect((await errorOf(() => second.deformer(shape, small))).code).toBe("disposed");
    expect(second.deformer(second.shape(mesh), small).step().energy).toBe(0);
  });

  it("does not blame memory for other traps, and frees what is left without a word", async () => {
    const { init, errorOf } = await fresh(name, "trap");
    const [first, memory] = await withMemory(init);
    const shape = first.shape(mesh);
    const deformer = first.deformer(shape, small);
    const other = first.deformer(shape, big);
    scramble(memory);
    const failure = await errorOf(() => deformer.state());
    expect(failure.code).toBe("crashed");
    expect(failure.message).toContain("defect of Pliant");
    expect(failure.message).not.toContain("ran out");
    expect(failure.cause).toBeInstanceOf(WebAssembly.RuntimeError);
    for (const object of [deformer, other, shape]) object.dispose();
    expect((await init()).shape(mesh).report.vertices).toBe(3600);
  });

  it("is noticed by a dispose, too", async () => {
    const { init, errorOf } = await fresh(name, "dispose");
    const [first, memory] = await withMemory(init);
    const shape = first.shape(mesh);
    const deformer = first.deformer(shape, small);
    scramble(memory);
    deformer.dispose();
    shape.dispose();
    expect((await errorOf(() => first.shape(mesh))).code).toBe("crashed");
    expect(await init()).not.toBe(first);
  });
});

describe("worker", () => {
  it.each([{ inline: false }, { inline: true }])(
    "says so where memory runs out, and starts again %o",
    async ({ inline }) => {
      const { init } = entries.worker;
      const first = await init({ inline, wasmBinary: cramped() });
      const shape = await first.shape(mesh);
      const deformer = await first.deformer(shape, big);
      await deformer.addHandle([0]);
      const [step, waiting] = await Promise.all([errorOf(() => deformer.step()), errorOf(() => deformer.solve())]);
      expect(step).toMatchObject({ code: "crashed", message: expect.stringContaining("ran out of memory") });
      expect(waiting.code).toBe("crashed");
      expect((await errorOf(() => shape.select({ all: true }))).code).toBe("crashed");
      await deformer.dispose();
      await shape.dispose();
      const second = await init({ inline });
      expect(second).not.toBe(first);
      const next = await second.deformer(await second.shape(mesh), small);
      expect((await next.step()).energy).toBe(0);
      first.dispose();
      expect((await next.step()).energy).toBe(0);
      second.dispose();
    },
  );
});

describe("objects that are forgotten", () => {
  it("after a crash leave Node alone", () => {
    const program = `
      import { init } from "pliant";
      const { instantiate } = WebAssembly;
      let memory;
      WebAssembly.instantiate = async (...args) => {
        const instance = await instantiate(...args);
        memory = Object.values(instance.exports).find((value) => value instanceof WebAssembly.Memory);
        return instance;
      };
      const pliant = await init();
      const shape = () => pliant.shape({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0] });
      const make = () => pliant.deformer(shape(), { method: "embedded-graph", nodeCount: 2 });
      const kept = make();
      for (let i = 0; i < 20; ++i) make();
      new Uint8Array(memory.buffer).fill(0xff);
      for (let i = 0; i < 5; ++i) {
        gc();
        await new Promise((resolve) => setTimeout(resolve, 10));
      }
      try { kept.state(); } catch (error) { console.log(error.code); }`;
    const args = ["--expose-gc", "--input-type=module", "-e", program];
    expect(execFileSync(process.execPath, args, { cwd: consumer, encoding: "utf8" })).toBe("crashed\n");
  });
});
