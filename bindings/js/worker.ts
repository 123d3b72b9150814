// pliant/worker: the same calls as promises, run in a Web Worker (in Node: a worker thread).

import { fields, flag, Place } from "./boundary/check.js";
import { PliantError } from "./boundary/errors.js";
import type { InitOptions } from "./boundary/wasm.js";
import { absolute, nodeModule, readInitOptions } from "./boundary/wasm.js";
import { Line } from "./worker/line.js";
import { WorkerPliant } from "./worker/objects.js";
import type { Reference } from "./worker/protocol.js";
import { nodePort, webPort, type WorkerPort } from "./worker/ports.js";

export { WorkerDeformer, WorkerEdit, WorkerHandle, WorkerPliant, WorkerShape, WorkerSketch } from "./worker/objects.js";
export type * from "./public.js";
export { PliantError };

export interface WorkerInitOptions extends InitOptions {
  /**
   * Takes the worker and the WASM from inside the script instead of from files beside it: the default
   * for a page opened from a file. A strict content-security policy must then allow `worker-src blob:`.
   */
  inline?: boolean;
}

let current: Promise<WorkerPliant> | undefined;

/** Starts the worker; every call gives the same one until it is disposed. Errors: invalid-option, load-failed. */
export async function init(options?: WorkerInitOptions): Promise<WorkerPliant> {
  const place = new Place("invalid-option", "options");
  const { inline, ...rest } = fields(place, options ?? {}, ["wasmUrl", "wasmBinary", "wasmModule", "inline"], "option of init");
  const source = readInitOptions(rest);
  const inside = inline === undefined ? globalThis.location?.protocol === "file:" : flag(place.at("inline"), inline);
  current ??= start(inside, source).catch((error) => {
    current = undefined;
    throw error;
  });
  return current;
}

async function start(inline: boolean, source: InitOptions): Promise<WorkerPliant> {
  const wasm = await travelling(source, inline);
  const line = new Line(await launched(inline), () => (current = undefined));
  try {
    const reference = await line.call<Reference>({ target: 0, method: "init", args: [wasm] });
    return new WorkerPliant(line, reference);
  } catch (error) {
    line.close(new PliantError("disposed", "the worker did not start"));
    throw error instanceof PliantError && error.code === "crashed" ? notStarted(error) : error;
  }
}

/** A worker that a policy or the network may refuse. Errors: load-failed. */
async function launched(inline: boolean): Promise<WorkerPort> {
  try {
    return await launch(inline);
  } catch (error) {
    throw notStarted(error as Error);
  }
}

function notStarted(error: Error): PliantError {
  return new PliantError("load-failed", `the worker cannot be started: ${error.message}`, { cause: error });
}

/** The source of the WASM in a form that a worker, which may have no address of its own, can use. */
async function travelling(source: InitOptions, inline: boolean): Promise<InitOptions> {
  if (source.wasmUrl) return { wasmUrl: absolute(source.wasmUrl).href };
  if (source.wasmBinary || source.wasmModule) return source;
  if (!inline) return { wasmUrl: new URL("./pliant.wasm", import.meta.url).href };
  const { unpack } = await import("./boundary/unpack.js");
  return { wasmBinary: await unpack() };
}

async function launch(inline: boolean): Promise<WorkerPort> {
  const threads = nodeModule("node:worker_threads");
  if (inline) {
    const { default: script } = await import("#worker-script");
    if (threads) return nodePort(new threads.Worker(script, { eval: true, execArgv: [] }));
    return webPort(new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" }))));
  }
  // Not written as below, which a bundler for the browser would follow.
  if (threads) return nodePort(new threads.Worker(new URL(import.meta.url.replace(/[^/]*$/, "worker-host.js")), { execArgv: [] }));
  return webPort(new Worker(new URL("./worker-host.js", import.meta.url), { type: "module" }));
}
