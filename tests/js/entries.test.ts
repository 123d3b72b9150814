// The entries of the package: inside the script, in a worker, as a classic script, for three.js.

import { execFileSync, spawnSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import vm from "node:vm";
import * as THREE from "three";
import { afterAll, describe, expect, it } from "vitest";
import { consumer, entries, errorOf, installed, pliant } from "./support/package.js";
import { sheet, where } from "./support/shapes.js";

const mesh = sheet(15);
const left = where(mesh.positions, (x) => x < 0.15);
const right = where(mesh.positions, (x) => x > 0.9);
const options = { method: "embedded-graph", nodeCount: 30 } as const;

type Library = Awaited<ReturnType<typeof entries.pliant.init>>;

/** What every entry must give: the same as `pliant`. */
async function lifted(library: Library): Promise<Float32Array> {
  const deformer = library.deformer(library.shape(mesh), options);
  deformer.setFixed(left);
  deformer.addHandle(right).move({ translate: [0, 0, 0.3] });
  await deformer.solve();
  return deformer.positions();
}

const expected = await lifted(pliant);

describe("what is packed", () => {
  const files = readdirSync(installed, { recursive: true, encoding: "utf8" }).filter((file) => file.endsWith(".js"));

  it("depends on nothing", () => {
    const { dependencies, peerDependenciesMeta } = JSON.parse(readFileSync(join(installed, "package.json"), "utf8"));
    expect(dependencies).toBeUndefined();
    expect(peerDependenciesMeta).toEqual({ three: { optional: true } });
    expect(readdirSync(join(consumer, "node_modules")).filter((name) => !name.startsWith("."))).toEqual(["pliant"]);
  });

  it("holds no demo page, no sources and no tests", () => {
    expect(readdirSync(installed).sort()).toEqual(["CHANGELOG.md", "LICENSE", "README.md", "dist", "package.json"].filter((name) => readdirSync(installed).includes(name)));
    expect(readdirSync(join(installed, "dist"))).not.toContain("demo");
  });

  it("imports no built-in of Node in what browsers load", () => {
    const browser = files.filter((file) => !file.endsWith("cli.js"));
    expect(browser.length).toBeGreaterThan(5);
    for (const file of browser) {
      const text = readFileSync(join(installed, file), "utf8");
      expect(text, file).not.toMatch(/(?:from|import|require)\s*\(?\s*["'`](?:node:|fs|path|worker_threads)/);
    }
  });

  it("needs no eval, as a strict content-security policy asks", () => {
    for (const file of files) expect(readFileSync(join(installed, file), "utf8"), file).not.toMatch(/\bnew Function\s*\(|\beval\s*\(/);
  });
});

describe("types", () => {
  it("fit between sources, tests and page", () => {
    const root = join(import.meta.dirname, "../..");
    const { stdout } = spawnSync(process.execPath, [join(root, "node_modules/typescript/bin/tsc"), "-p", root], { encoding: "utf8" });
    expect(stdout).toBe("");
  });

  it("are complete for an application that checks its libraries too", () => {
    const source = `
      import { init, type EditScript, PliantError } from "pliant";
      import { init as initInline } from "pliant/inline";
      import { init as initWorker } from "pliant/worker";
      const pliant = await init();
      const shape = pliant.shape({ positions: new Float32Array(9), triangles: new Uint32Array([0, 1, 2]) });
      const deformer = pliant.deformer(shape, { method: "embedded-graph", nodeCount: 3 });
      const hand = deformer.addHandle(new Set([1, 2]));
      hand.move({ translate: [0, 1, 0], rotate: { axis: [0, 0, 1], degrees: 90, about: [0, 0, 0] } });
      hand.moveTo(new Float32Array(6));
      const { energy, converged, terms } = deformer.step();
      const carried: Float64Array = deformer.transformPoints([1, 2, 3]);
      const out: Float64Array = deformer.positions(new Float64Array(9));
      const script: EditScript = { format: "pliant-edit", version: 1, steps: [{ method: "embedded-graph", handles: [{ select: { all: true } }] }] };
      const edited = await (await initInline()).edit(shape, script);
      const remote = await initWorker({ inline: true });
      const far: Float32Array = await (await remote.deformer(await remote.shape({ positions: out }), { method: "embedded-graph" })).positions();
      export { energy, converged, terms, carried, edited, far, PliantError };
      // @ts-expect-error no such option
      pliant.deformer(shape, { method: "embedded-graph", nodes: 5 });
      // @ts-expect-error no such method
      pliant.deformer(shape, { method: "clay" });
    `;
    writeFileSync(join(consumer, "types.ts"), source);
    const tsc = join(import.meta.dirname, "../../node_modules/typescript/bin/tsc");
    for (const [module, moduleResolution] of [["esnext", "bundler"], ["nodenext", "nodenext"]]) {
      const compilerOptions = { noEmit: true, strict: true, skipLibCheck: false, types: [], target: "es2022", module, moduleResolution };
      writeFileSync(join(consumer, "tsconfig.json"), JSON.stringify({ compilerOptions, files: ["types.ts"] }));
      const { stdout } = spawnSync(process.execPath, [tsc, "-p", consumer], { encoding: "utf8" });
      expect(stdout).toBe("");
    }
  });
});

describe("init", () => {
  it("gives one library to all who ask", async () => {
    const all = await Promise.all([entries.pliant.init(), entries.pliant.init(), entries.pliant.init({})]);
    expect(new Set([...all, pliant]).size).toBe(1);
  });

  it.each(["wasmUrl", "wasmBinary", "wasmModule"])("takes %s, and starts anew after a failure", async (name) => {
    // A module of its own, not started yet.
    const fresh = (await import(/* @vite-ignore */ `${pathToFileURL(join(installed, "dist/inline.js")).href}?${name}`)) as typeof entries.pliant;
    const file = join(installed, "dist/pliant.wasm");
    const bytes = readFileSync(file);
    const bad = { wasmUrl: `${pathToFileURL(file).href}.gone`, wasmBinary: bytes.subarray(0, 100), wasmModule: new WebAssembly.Module(Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0)) };
    const good = { wasmUrl: pathToFileURL(file), wasmBinary: bytes, wasmModule: new WebAssembly.Module(bytes) };
    const failure = await fresh.init({ [name]: bad[name as keyof typeof bad] }).catch((error: unknown) => error);
    expect(failure).toBeInstanceOf(fresh.PliantError);
    expect(failure).toMatchObject({ code: "invalid-option" });
    expect(await lifted(await fresh.init({ [name]: good[name as keyof typeof good] }))).toEqual(expected);
  });
});

describe("memory", () => {
  it("that is dropped without dispose comes back", () => {
    // A hundred megabytes each: what is not given back would not fit in the two gigabytes there are.
    const program = `
      import { init } from "pliant";
      const pliant = await init();
      const positions = Float64Array.from({ length: 9_000_000 }, (_, i) => i);
      for (let i = 0; i < 24; ++i) {
        pliant.shape({ positions });
        gc();
        await new Promise((resolve) => setImmediate(resolve));
      }
      console.log("done");`;
    expect(execFileSync(process.execPath, ["--expose-gc", "--input-type=module", "-e", program], { cwd: consumer, encoding: "utf8" })).toBe("done\n");
  });

  it("that does not suffice for a shape is an error, and the library goes on", () => {
    const program = `
      import { init } from "pliant";
      const pliant = await init();
      const held = [];
      const positions = Float64Array.from({ length: 9_000_000 }, (_, i) => i);
      const codeOf = (action) => { try { action(); return "none"; } catch (error) { return error.code; } };
      let code;
      do code = codeOf(() => held.push(pliant.shape({ positions }))); while (code === "none");
      for (const shape of held) shape.dispose();
      console.log(code, held.length > 5, (await init()).shape({ positions }).report.vertices);`;
    const out = execFileSync(process.execPath, ["--input-type=module", "-e", program], { cwd: consumer, encoding: "utf8" });
    expect(out).toBe("too-large true 3000000\n");
  });

  it("that runs out under way ends the library, and init starts another", async () => {
    const fresh = (await import(/* @vite-ignore */ `${pathToFileURL(join(installed, "dist/inline.js")).href}?trap`)) as typeof entries.pliant;
    const { instantiate } = WebAssembly;
    let out = false;
    const failing = (call: (...args: unknown[]) => unknown) => (...args: unknown[]) => {
      if (out) throw new WebAssembly.RuntimeError("unreachable");
      return call(...args);
    };
    // Every call from the glue into the module fails once memory is "out".
    WebAssembly.instantiate = (async (module: WebAssembly.Module, imports: WebAssembly.Imports) => {
      const { exports } = await instantiate(module, imports);
      return { exports: Object.fromEntries(Object.entries(exports).map(([name, value]) => [name, typeof value === "function" ? failing(value as never) : value])) };
    }) as never;
    const first = await fresh.init();
    WebAssembly.instantiate = instantiate;
    const shape = first.shape(mesh);
    const deformer = first.deformer(shape, options);
    const state = deformer.state();
    out = true;
    const codeOf = (action: () => unknown) => { try { return action(); } catch (error) { return (error as { code: string }).code; } };
    expect(codeOf(() => deformer.restore(state))).toBe("too-large");
    out = false;
    expect(codeOf(() => deformer.step())).toBe("too-large");
    const second = await fresh.init();
    expect(second).not.toBe(first);
    expect(codeOf(() => second.deformer(shape, options))).toBe("disposed");
    expect(await lifted(second)).toEqual(expected);
  });
});

describe("pliant/inline", () => {
  it("is the same with the WASM inside", async () => {
    expect(await lifted(await entries.inline.init())).toEqual(expected);
  });

  it("is one file, without fetch", () => {
    const text = readFileSync(join(installed, "dist/inline.js"), "utf8");
    expect(text).not.toMatch(/\bimport\s*[("'`{]|\bfrom\s*["'`]/);
  });

  it("is a classic script too", async () => {
    const script = readFileSync(join(installed, "dist/pliant.global.js"), "utf8");
    const page = vm.createContext({
      WebAssembly, Blob, Response, DecompressionStream, MessageChannel, TextDecoder, atob, performance, FinalizationRegistry, console,
    });
    vm.runInContext(script, page);
    const program = `pliant.init().then((library) => library.shape({ positions: [0, 0, 0, 1, 0, 0], dimension: 3 }).report.vertices)`;
    expect(await vm.runInContext(program, page)).toBe(2);
  });
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

  it("runs edit scripts, with progress and abort", async () => {
    const library = await start();
    const shape = await library.shape(mesh);
    const script = {
      format: "pliant-edit", version: 1,
      steps: [{ method: "embedded-graph", options: { nodeCount: 30 }, fixed: [{ vertices: left }], handles: [{ select: { vertices: right }, move: { translate: [0, 0, 0.3] } }] }],
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
    const solving = errorOf(() => deformer.solve({ signal: controller.signal, tolerance: 1e-14, maxIterations: 1_000_000 }));
    await deformer.counters();
    controller.abort();
    expect((await solving).code).toBe("aborted");
    expect((await deformer.step()).energy).toBeGreaterThan(0);
    const handles = [{ select: { vertices: [0] } }, { select: { vertices: [10200] }, move: { translate: [0, 0, 0.5] } }];
    const script = { format: "pliant-edit", version: 1, steps: [{ method: "embedded-graph", options: { nodeCount: 400, solver: "gauss-newton" }, handles, solve: { tolerance: 1e-14 } }] };
    const stop = new AbortController();
    const editing = errorOf(() => library.edit(big, script as never, { signal: stop.signal, onProgress: () => stop.abort() }));
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

describe("pliant/worker", () => {
  it("does not keep Node alive when idle", () => {
    const program = `
      import { init } from "pliant/worker";
      const shape = await (await init()).shape({ positions: [0, 0, 0, 1, 1, 1] });
      console.log(shape.report.vertices);`;
    expect(execFileSync(process.execPath, ["--input-type=module", "-e", program], { cwd: consumer, encoding: "utf8" })).toBe("2\n");
  });

  it("refuses options it does not know", async () => {
    expect((await errorOf(() => entries.worker.init({ wasm: 1 } as never))).message).toContain("options.wasm");
    expect((await errorOf(() => entries.worker.init({ inline: 1 } as never))).message).toContain("options.inline");
  });
});

describe("pliant/three", () => {
  const { GeometryBinding, shapeOf } = entries.three;

  async function bent(geometry: THREE.BufferGeometry) {
    const binding = new GeometryBinding(geometry as never);
    const input = shapeOf(geometry as never);
    const shape = pliant.shape(input);
    const deformer = pliant.deformer(shape, { method: "embedded-graph", nodeCount: 20 });
    deformer.setFixed(shape.select({ halfSpace: { normal: [0, -1, 0], offset: 0.9 } }));
    deformer.addHandle(shape.select({ halfSpace: { normal: [0, 1, 0], offset: 0.9 } })).move({ translate: [1, 0, 0] });
    await deformer.solve();
    binding.update(deformer);
    return { shape, deformer, binding };
  }

  it("welds UV seams and scatters results back over them", async () => {
    const geometry = new THREE.CylinderGeometry(0.3, 0.3, 2, 16, 12);
    const rest = geometry.getAttribute("position").clone();
    const { shape, deformer } = await bent(geometry);
    expect(shape.report.weldedVertices).toBeGreaterThan(0);
    expect(shape.report.boundaryEdges).toBe(0);
    const moved = geometry.getAttribute("position");
    expect(Float32Array.from(moved.array)).toEqual(deformer.positions());
    for (let i = 0; i < rest.count; ++i) {
      for (let j = 0; j < i; ++j) {
        const same = rest.getX(i) === rest.getX(j) && rest.getY(i) === rest.getY(j) && rest.getZ(i) === rest.getZ(j);
        if (same) expect([moved.getX(i), moved.getY(i), moved.getZ(i)]).toEqual([moved.getX(j), moved.getY(j), moved.getZ(j)]);
      }
    }
  });

  it("keeps hard edges hard and smooth ones smooth", async () => {
    const geometry = new THREE.BoxGeometry(0.5, 2, 0.5, 2, 8, 2);
    const rest = geometry.getAttribute("normal").clone();
    await bent(geometry);
    const [normal, position, index] = [geometry.getAttribute("normal"), geometry.getAttribute("position"), geometry.index!];
    const v = (attribute: { getX(i: number): number; getY(i: number): number; getZ(i: number): number }, i: number) => new THREE.Vector3(attribute.getX(i), attribute.getY(i), attribute.getZ(i));
    let turned = 0;
    for (let t = 0; t < index.count; t += 3) {
      const [a, b, c] = [0, 1, 2].map((corner) => v(position, index.getX(t + corner)));
      const face = new THREE.Vector3().crossVectors(b.clone().sub(a), c.clone().sub(a)).normalize();
      // Every vertex of the box belongs to one side: its normal is close to that of its triangles.
      for (let corner = 0; corner < 3; ++corner) {
        const i = index.getX(t + corner);
        expect(v(normal, i).length()).toBeCloseTo(1, 5);
        expect(v(normal, i).dot(face)).toBeGreaterThan(0.8);
        turned = Math.max(turned, v(normal, i).distanceTo(v(rest, i)));
      }
    }
    expect(turned).toBeGreaterThan(0.2);
  });

  it("updates versions and bounds, and leaves groups and texture coordinates alone", async () => {
    const geometry = new THREE.BoxGeometry(0.5, 2, 0.5, 2, 8, 2);
    geometry.computeBoundingSphere();
    const [groups, uv] = [structuredClone(geometry.groups), Array.from(geometry.getAttribute("uv").array)];
    const before = geometry.getAttribute("position") as THREE.BufferAttribute;
    const { version } = before;
    await bent(geometry);
    expect(geometry.getAttribute("position")).toBe(before);
    expect(before.version).toBeGreaterThan(version);
    expect(geometry.groups).toEqual(groups);
    expect(Array.from(geometry.getAttribute("uv").array)).toEqual(uv);
    expect(geometry.boundingBox!.max.x).toBeGreaterThan(1);
    expect(geometry.boundingSphere!.center.x).toBeGreaterThan(0.3);
  });

  it("takes geometries without an index, and interleaved ones", async () => {
    const indexed = new THREE.TorusGeometry(0.8, 0.2, 8, 24).rotateX(0.3);
    const soup = indexed.toNonIndexed();
    const { shape } = await bent(soup);
    expect(shape.report).toMatchObject({ triangles: indexed.index!.count / 3, components: 1, boundaryEdges: 0 });
    const data = new THREE.InterleavedBuffer(new Float32Array(indexed.getAttribute("position").count * 6), 6);
    const interleaved = new THREE.BufferGeometry().setIndex(indexed.index);
    interleaved.setAttribute("position", new THREE.InterleavedBufferAttribute(data, 3, 0));
    const source = indexed.getAttribute("position");
    for (let i = 0; i < source.count; ++i) interleaved.getAttribute("position").setXYZ(i, source.getX(i), source.getY(i), source.getZ(i));
    await bent(interleaved);
    await bent(indexed);
    const [a, b] = [interleaved.getAttribute("position"), indexed.getAttribute("position")];
    for (let i = 0; i < a.count; ++i) expect(a.getX(i)).toBe(b.getX(i));
    expect(data.version).toBeGreaterThan(0);
  });

  it("takes positions from elsewhere", () => {
    const geometry = new THREE.PlaneGeometry(1, 1);
    const binding = new GeometryBinding(geometry as never);
    binding.write(Float32Array.from({ length: 12 }, (_, i) => i % 5));
    expect(geometry.getAttribute("position").getX(1)).toBe(3);
  });

  it("refuses what does not fit", async () => {
    const geometry = new THREE.PlaneGeometry(1, 1);
    expect((await errorOf(() => shapeOf(new THREE.BufferGeometry() as never))).code).toBe("invalid-shape");
    expect((await errorOf(() => shapeOf(undefined as never))).code).toBe("invalid-shape");
    expect((await errorOf(() => new GeometryBinding(geometry as never).write(new Float32Array(3)))).code).toBe("invalid-option");
  });
});
