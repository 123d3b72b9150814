// What is packed, its types, starting and stopping, and the entries with the WASM inside.

import { execFileSync, spawnSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import vm from "node:vm";
import { describe, expect, it } from "vitest";
import { consumer, entries, installed, pliant } from "./support/package.js";
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
    expect(readdirSync(installed).sort()).toEqual(
      ["CHANGELOG.md", "LICENSE", "README.md", "dist", "package.json"].filter((name) =>
        readdirSync(installed).includes(name),
      ),
    );
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
    for (const file of files) {
      expect(readFileSync(join(installed, file), "utf8"), file).not.toMatch(/\bnew Function\s*\(|\beval\s*\(/);
    }
  });
});

describe("types", () => {
  it("fit between sources, tests and page", () => {
    const root = join(import.meta.dirname, "../..");
    const { stdout } = spawnSync(process.execPath, [join(root, "node_modules/typescript/bin/tsc"), "-p", root], {
      encoding: "utf8",
    });
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
      const steps: EditScript["steps"] = [{ method: "embedded-graph", handles: [{ select: { all: true } }] }];
      const script: EditScript = { format: "pliant-edit", version: 1, steps };
      const edited = await (await initInline()).edit(shape, script);
      const remote = await initWorker({ inline: true });
      const there = await remote.deformer(await remote.shape({ positions: out }), { method: "embedded-graph" });
      const far: Float32Array = await there.positions();
      export { energy, converged, terms, carried, edited, far, PliantError };
      // @ts-expect-error no such option
      pliant.deformer(shape, { method: "embedded-graph", nodes: 5 });
      // @ts-expect-error no such method
      pliant.deformer(shape, { method: "clay" });
    `;
    writeFileSync(join(consumer, "types.ts"), source);
    const tsc = join(import.meta.dirname, "../../node_modules/typescript/bin/tsc");
    for (const [module, moduleResolution] of [["esnext", "bundler"], ["nodenext", "nodenext"]]) {
      const compilerOptions = {
        noEmit: true, strict: true, skipLibCheck: false, types: [], target: "es2022", module, moduleResolution,
      };
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
    const fresh = (await import(
      /* @vite-ignore */ `${pathToFileURL(join(installed, "dist/inline.js")).href}?${name}`
    )) as typeof entries.pliant;
    const file = join(installed, "dist/pliant.wasm");
    const bytes = readFileSync(file);
    const bad = {
      wasmUrl: `${pathToFileURL(file).href}.gone`,
      wasmBinary: bytes.subarray(0, 100),
      wasmModule: new WebAssembly.Module(Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0)),
    };
    const good = { wasmUrl: pathToFileURL(file), wasmBinary: bytes, wasmModule: new WebAssembly.Module(bytes) };
    const failure = await fresh.init({ [name]: bad[name as keyof typeof bad] }).catch((error: unknown) => error);
    expect(failure).toBeInstanceOf(fresh.PliantError);
    expect(failure).toMatchObject({ code: name === "wasmUrl" ? "load-failed" : "invalid-option" });
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
    expect(
      execFileSync(process.execPath, ["--expose-gc", "--input-type=module", "-e", program], {
        cwd: consumer, encoding: "utf8",
      }),
    ).toBe("done\n");
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
    const out = execFileSync(process.execPath, ["--input-type=module", "-e", program], {
      cwd: consumer, encoding: "utf8",
    });
    expect(out).toBe("too-large true 3000000\n");
  });
});

describe("pliant/inline", () => {
  it("is the same with the WASM inside", async () => {
    expect(await lifted(await entries.inline.init())).toEqual(expected);
  });

  it("is one file, without fetch", () => {
    const text = readFileSync(join(installed, "dist/inline.js"), "utf8");
    expect(text).not.toMatch(/\bimport\s*[("'`{*]|\bexport\s*(\*|\{[^}]*\})\s*from\b/);
  });

  it("is a classic script too", async () => {
    const script = readFileSync(join(installed, "dist/pliant.global.js"), "utf8");
    const page = vm.createContext({
      WebAssembly, Blob, Response, DecompressionStream, MessageChannel, TextDecoder, atob, performance,
      FinalizationRegistry, console,
    });
    vm.runInContext(script, page);
    const shape = "library.shape({ positions: [0, 0, 0, 1, 0, 0], dimension: 3 })";
    const program = `pliant.init().then((library) => ${shape}.report.vertices)`;
    expect(await vm.runInContext(program, page)).toBe(2);
  });
});
