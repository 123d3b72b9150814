// The package beside the page: what it makes of the scripts the page exports.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { dist } from "./browser.ts";
import { ask, rest } from "./visit.ts";

type Package = typeof import("../../../bindings/js/index.ts");

export async function library() {
  const { init } = (await import(join(dist, "pliant.js"))) as Package;
  return init({ wasmBinary: readFileSync(join(dist, "pliant.wasm")) });
}

/** An edit script, run over a shape at rest. */
export async function replay(script: unknown, positions: number[], triangles: number[]) {
  const pliant = await library();
  return pliant.edit(pliant.shape({ positions: Float32Array.from(positions), triangles }), script as never);
}

/** The script of the page as it is, run over the shape as it was opened. */
export const replayed = async () =>
  replay(await ask((hook) => hook.script()), await rest(), await ask((hook) => hook.triangles()));
