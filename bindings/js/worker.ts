// pliant/worker: the same calls as promises, run in a Web Worker (in Node: a worker thread).

import { fields, flag, Place } from "./boundary/check.js";
import { PliantError } from "./boundary/errors.js";
import type { InitOptions } from "./boundary/wasm.js";
import { absolute, nodeModule, readInitOptions } from "./boundary/wasm.js";
import { Line } from "./worker/line.js";
import { WorkerPliant } from "./worker/objects.js";
import type { Reference } from "./worker/protocol.js";
import { nodePort, webPort, type WorkerPort } from "./worker/ports.js";

export {
  WorkerDeformer, WorkerEdit, WorkerHandle, WorkerPicture, WorkerPliant, WorkerShape, WorkerSketch,
} from "./worker/objects.js";
export type { FileSource } from "./io/files.js";
export type { FileFormat, WrittenFormat } from "./io/format.js";
export { refined } from "./io/refined.js";
export type {
  Frame, Mesh, PictureOptions, ReadOptions, ReadProgress, ShapeFile, WritableShape,
} from "./io/shape_file.js";
export type * from "./public.js";
export { PliantError };

export interface WorkerInitOptions extends InitOptions {
  /**
   * Takes the worker and the WASM from inside the script instead of from files beside it: the default
   * for a page opened from a file. A strict content-security policy must then allow `worker-src blob:`.
   */
  inline?: boolean;
  /**
   * Where pliant-io.wasm comes from, which `read` and `write` load. Left out: from beside this script, or from inside
   * it.
   */
  io?: InitOptions;
}

let current: Promise<WorkerPliant> | undefined;

/** Starts the worker; every call gives the same one until it is disposed. Errors: invalid-option, load-failed. */
export async function init(options?: WorkerInitOptions): Promise<WorkerPliant> {
  const place = new Place("invalid-option", "options");
  const { inline, io, ...rest } = fields(
    place, options ?? {}, ["wasmUrl", "wasmBinary", "wasmModule", "inline", "io"], "option of init",
  );
  const [source, ioSource] = [readInitOptions(rest), readInitOptions(io)];
  const inside = inline === undefined ? globalThis.location?.protocol === "file:" : flag(place.at("inline"), inline);
  current ??= start(inside, source, ioSource).catch((error) => {
    current = undefined;
    throw error;
  });
  return current;
}

async function start(inline: boolean, source: InitOptions, io: InitOptions): Promise<WorkerPliant> {
  const wasm = await travelling(source, inline, beside.pliant);
  const line = new Line(await launched(inline), () => (current = undefined));
  try {
    const reference = await line.call<Reference>({ target: 0, method: "init", args: [wasm] });
    return new WorkerPliant(line, reference, () => travelling(io, inline, beside.io));
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
async function travelling(
  source: InitOptions, inline: boolean, { url, unpack }: (typeof beside)["io"],
): Promise<InitOptions> {
  if (source.wasmUrl) return { wasmUrl: absolute(source.wasmUrl).href };
  if (source.wasmBinary || source.wasmModule) return source;
  return inline ? { wasmBinary: await unpack() } : { wasmUrl: url().href };
}

/** The modules beside this script, and inside it. */
const beside = {
  pliant: {
    url: () => new URL("./pliant.wasm", import.meta.url),
    unpack: async () => (await import("./boundary/unpack.js")).unpack(),
  },
  io: {
    url: () => new URL("./pliant-io.wasm", import.meta.url),
    unpack: async () => (await import("./io/unpack.js")).unpackIo(),
  },
};

async function launch(inline: boolean): Promise<WorkerPort> {
  const threads = nodeModule("node:worker_threads");
  if (inline) {
    const { default: script } = await import("#worker-script");
    if (threads) return nodePort(new threads.Worker(script, { eval: true, execArgv: [] }));
    return webPort(new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" }))));
  }
  // Not written as below, which a bundler for the browser would follow.
  if (threads) {
    return nodePort(new threads.Worker(new URL(import.meta.url.replace(/[^/]*$/, "worker-host.js")), { execArgv: [] }));
  }
  return webPort(new Worker(new URL("./worker-host.js", import.meta.url), { type: "module" }));
}
