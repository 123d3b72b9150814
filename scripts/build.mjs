// `npm run build`: the WASM modules, the package (dist/) and the demo page (dist/demo/).
// Each step runs only when something it reads has changed since it last succeeded.

import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { availableParallelism } from "node:os";
import { dirname, join } from "node:path";
import { Failure, heading, isProgram, main, root, run } from "./run.mjs";
import { setup } from "./setup.mjs";

const modules = ["pliant", "pliant-io"].flatMap((name) =>
  [".mjs", ".wasm"].map((extension) => `build/wasm/bindings/wasm/${name}${extension}`));
const packageInputs = ["bindings/js", ...modules, "package.json", "package-lock.json"];

/** Sets up and builds everything `npm start` serves and `npm pack` packs. */
export async function build() {
  await setup("build");
  await buildTargets("wasm", ["pliant_wasm", "pliant_io_wasm"]);
  await step("package", {
    inputs: packageInputs,
    outputs: [
      "pliant.js", "inline.js", "pliant.global.js", "worker.js", "io.js", "picture.js", "three.js", "cli.js",
      "pliant.wasm", "pliant-io.wasm", "types/index.d.ts",
    ].map((name) => `dist/${name}`),
    action: async () => (await import("../bindings/js/build.mjs")).buildPackage(),
  });
  await step("demo page", {
    inputs: ["web-demo", ...packageInputs],
    outputs: ["dist/demo/index.html"],
    action: async () => (await import("../web-demo/build.mjs")).buildDemo(),
  });
}

/** Builds CMake targets under a preset of CMakePresets.json, in build/<preset>. */
export async function buildTargets(preset, targets) {
  // Debian's acorn, which the linker of Emscripten loads.
  const env = preset === "wasm" ? { NODE_PATH: "/usr/share/nodejs" } : {};
  // Ninja configures again by itself when a CMakeLists.txt changes, but does not know the presets.
  await step(`${preset} configuration`, {
    inputs: ["CMakePresets.json"],
    outputs: [`build/${preset}/build.ninja`],
    action: () => run("cmake", ["--preset", preset], { env, show: false }),
  });
  heading(`Compiling ${targets.join(", ")} (${preset})`);
  const jobs = String(availableParallelism());
  await run("cmake", ["--build", "--preset", preset, "-j", jobs, "--target", ...targets], { env });
}

/** Runs `action` unless it last succeeded on the same inputs and its outputs are still there. */
async function step(name, { inputs, outputs, action }) {
  const stamp = join(root, "build/stamps", name.replaceAll(" ", "-"));
  const missing = () => outputs.filter((path) => !existsSync(join(root, path)));
  const digest = digestOf(inputs);
  if (missing().length === 0 && existsSync(stamp) && readFileSync(stamp, "utf8") === digest) return;
  heading(`Building the ${name}`);
  rmSync(stamp, { force: true });
  await action();
  if (missing().length > 0) throw new Failure(`building the ${name} left no ${missing().join(", ")}`);
  mkdirSync(dirname(stamp), { recursive: true });
  writeFileSync(stamp, digest);
}

/** One digest over the names and contents of files and folders, given relative to the checkout. */
function digestOf(paths) {
  const hash = createHash("sha256");
  for (const path of paths.flatMap(filesUnder).sort()) {
    hash.update(`${path}\0`).update(readFileSync(join(root, path))).update("\0");
  }
  return hash.digest("hex");
}

function filesUnder(path) {
  const found = statSync(join(root, path), { throwIfNoEntry: false });
  if (!found) throw new Failure(`${path}: expected a file or folder of the checkout or of an earlier step`);
  if (!found.isDirectory()) return [path];
  return readdirSync(join(root, path)).flatMap((name) => filesUnder(join(path, name)));
}

if (isProgram(import.meta.url)) {
  await main(async (args) => {
    if (args.length > 0) throw new Failure(`build: unexpected "${args[0]}": it takes no arguments`);
    await build();
  });
}
