// Builds the package: dist/ from the TypeScript here and the WASM modules of bindings/wasm.
//   node bindings/js/build.mjs [--wasm DIR] [--out DIR]
// Fails when the package outgrows its size budget.

import { execFile } from "node:child_process";
import { chmod, copyFile, mkdir, readdir, readFile, rm } from "node:fs/promises";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { parseArgs, promisify } from "node:util";
import { gzipSync } from "node:zlib";
import { rolldown } from "rolldown";

const root = fileURLToPath(new URL("../..", import.meta.url));
const source = join(root, "bindings/js");

/** Entries of the package: the file in dist/ and where it begins. */
const entries = {
  pliant: "index.ts",
  io: "io.ts",
  picture: "picture.ts",
  worker: "worker.ts",
  "worker-host": "worker/host.ts",
  three: "three.ts",
};

/** Bytes. `file`: with all it imports; `raw`: as it is; `gzip`: on the wire. */
const budget = [
  { file: "pliant.wasm", raw: 800e3, gzip: 323e3 },
  { file: "pliant.js", gzip: 41e3 },
  { file: "inline.js", gzip: 372e3 },
  { file: "pliant-io.wasm", raw: 152e3, gzip: 66e3 },
  { file: "io.js", gzip: 10e3 },
  { file: "picture.js", gzip: 6e3 },
];

/** Writes the package. `wasm`: the folder of the linked modules; `out`: where the package goes. */
export async function buildPackage({ wasm = join(root, "build/wasm/bindings/wasm"), out = join(root, "dist") } = {}) {
  await clear(out);
  const { version } = JSON.parse(await readFile(join(root, "package.json"), "utf8"));
  const [solvers, readers] = await Promise.all(["pliant.wasm", "pliant-io.wasm"].map(async (name) =>
    exported((await zopfli(join(wasm, name))).toString("base64"))));
  const modules = {
    "#wasm/inline": () => solvers,
    "#wasm/io-inline": () => readers,
    "#worker-script": async () => exported(await script("worker/host.ts", wasm)),
    "#version": () => exported(version),
    "#draco": dracoModule,
  };
  const inputs = Object.fromEntries(Object.entries(entries).map(([name, file]) => [name, join(source, file)]));
  await bundle({ input: inputs, plugins: [provide(modules, wasm)] }, { dir: out });
  // Without imports: a page opened from a file cannot load any. Also as a classic script.
  const inline = (name) => ({ input: { [name]: join(source, "inline.ts") }, plugins: [provide(modules, wasm)] });
  await bundle(inline("inline"), { dir: out, codeSplitting: false });
  await bundle(inline("pliant.global"), { dir: out, codeSplitting: false, format: "iife", name: "pliant" });
  await bundle({ input: { cli: join(source, "cli/main.ts") }, plugins: [provide(modules, wasm)], platform: "node" },
    { dir: out, codeSplitting: false, banner: "#!/usr/bin/env node" });
  await chmod(join(out, "cli.js"), 0o755);
  for (const name of ["pliant.wasm", "pliant-io.wasm"]) await copyFile(join(wasm, name), join(out, name));
  await writeTypes(join(out, "types"));
  await checkSizes(out);
}

/** A file as small as gzip can have it: a twentieth below what zlib comes to, in a second or two. */
async function zopfli(path) {
  const { stdout } = await promisify(execFile)("zopfli", ["-c", "--i5", path], { encoding: "buffer", maxBuffer: 1e8 });
  return stdout;
}

/** Everything of an earlier build but the demo page, which another step makes. */
async function clear(out) {
  await mkdir(out, { recursive: true });
  for (const name of await readdir(out)) {
    if (name !== "demo") await rm(join(out, name), { recursive: true });
  }
}

const output = { format: "es", minify: true, entryFileNames: "[name].js", chunkFileNames: "chunks/[name].js" };

async function bundle(input, options) {
  const build = await rolldown({ resolve: { extensionAlias: { ".js": [".ts", ".js"] } }, ...input });
  const result = await build.write({ ...output, ...options });
  await build.close();
  return result;
}

/** A program as the text of one classic script. */
async function script(file, wasm) {
  const build = await rolldown({
    input: join(source, file),
    plugins: [provide({ "#draco": noDraco }, wasm)],
    resolve: { extensionAlias: { ".js": [".ts", ".js"] } },
  });
  const { output: [chunk] } = await build.generate({ ...output, format: "iife", codeSplitting: false });
  await build.close();
  return chunk.code;
}

/** Draco's decoder as a module of its own: it shall look for no file, in Node as little as elsewhere. */
async function dracoModule() {
  const [glue, wasm] = await Promise.all(["draco_decoder_gltf_nodejs.js", "draco_decoder_gltf.wasm"].map((name) =>
    readFile(join(root, "node_modules/draco3dgltf", name))));
  const hidden = ["process", "require", "__dirname", "window", "document", "importScripts", "exports", "module"];
  return `const ${hidden.map((name) => `${name} = undefined`).join(", ")};
    ${glue}
    export const wasm = ${JSON.stringify(gzipSync(wasm, { level: 9 }).toString("base64"))};
    export default DracoDecoderModule;`;
}

/** In its place where everything is in one script: it weighs more than all other readers, and few files need it. */
const noDraco = () => `export const wasm = ${JSON.stringify(gzipSync("").toString("base64"))};
  export default () => {
  throw new Error("it is compressed with Draco, whose decoder is not part of this script; expected a file without");
};`;

const exported = (value) => `export default ${JSON.stringify(value)};`;

/** Resolves the modules of virtual.d.ts: the glue beside the WASM, and those that `modules` makes. */
function provide(modules, wasm) {
  return {
    name: "provide",
    resolveId: (id) => (id in modules ? `\0${id}` : id.startsWith("#wasm/") ? join(wasm, id.slice(6)) : null),
    load: (id) => modules[id.slice(1)]?.() ?? null,
  };
}

async function writeTypes(out) {
  const tsc = join(root, "node_modules/typescript/bin/tsc");
  const args = ["-p", join(source, "tsconfig.types.json"), "--outDir", out];
  await promisify(execFile)(process.execPath, [tsc, ...args]).catch((error) => {
    throw new Error(`types: ${error.stdout || error.message}`);
  });
  // The compiler does not copy declarations.
  await copyFile(join(source, "virtual.d.ts"), join(out, "virtual.d.ts"));
}

/** Prints what every file weighs, and throws where the budget is exceeded. */
async function checkSizes(out) {
  const excess = [];
  for (const { file, ...limits } of budget) {
    const parts = await Promise.all((await withImports(out, file)).map((name) => readFile(join(out, name))));
    const sizes = {
      raw: sum(parts.map((part) => part.length)), gzip: sum(parts.map((part) => gzipSync(part, { level: 9 }).length)),
    };
    const columns = ["raw", "gzip"].map(
      (kind) => `${kilobytes(sizes[kind])} ${kind}${limits[kind] ? ` of ${kilobytes(limits[kind])}` : ""}`,
    );
    console.log(`${file.padEnd(16)}${columns.map((column) => column.padStart(26)).join("")}`);
    for (const kind of Object.keys(limits)) {
      if (sizes[kind] > limits[kind]) {
        excess.push(`${file}: ${kilobytes(sizes[kind])} ${kind}, expected at most ${kilobytes(limits[kind])}`);
      }
    }
  }
  if (excess.length > 0) throw new Error(`size budget exceeded: ${excess.join("; ")}`);
}

const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(1)} kB`;

/** A file and what it imports at once, each once. */
async function withImports(out, file, found = new Set()) {
  if (found.has(file)) return found;
  found.add(file);
  if (!file.endsWith(".js")) return [...found];
  const text = await readFile(join(out, file), "utf8");
  for (const [, path] of text.matchAll(/(?:\bfrom|\bimport)\s*["'`](\.[^"'`]+)["'`]/g)) {
    await withImports(out, join(dirname(file), path), found);
  }
  return [...found];
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const { values } = parseArgs({ options: { wasm: { type: "string" }, out: { type: "string" } } });
  const paths = Object.fromEntries(Object.entries(values).map(([name, path]) => [name, resolve(path)]));
  try {
    await buildPackage(paths);
  } catch (error) {
    console.error(`pliant: ${error.message}`);
    process.exitCode = 1;
  }
}
