// Finds, compiles and starts the WASM module.

import { fields, Place } from "./check.js";
import { PliantError } from "./errors.js";

/** Where the WASM comes from; at most one. Left out: `pliant.wasm` beside the script. */
export interface InitOptions {
  /** Relative to the page, or in Node to the working directory. */
  wasmUrl?: string | URL;
  wasmBinary?: ArrayBuffer | ArrayBufferView<ArrayBuffer>;
  wasmModule?: WebAssembly.Module;
}

/** What emscripten's glue exports. */
export type ModuleFactory<T> = (options: {
  instantiateWasm(imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void): object;
}) => Promise<T>;

export type Binary = NonNullable<InitOptions["wasmBinary"]>;

export function readInitOptions(value: unknown): InitOptions {
  const place = new Place("invalid-option", "options");
  const options = fields(place, value ?? {}, ["wasmUrl", "wasmBinary", "wasmModule"], "option of init") as InitOptions;
  const given = Object.entries(options).filter(([, source]) => source !== undefined);
  if (given.length > 1) place.reject(`has ${given[0][0]} and ${given[1][0]}; expected one source of the WASM`);
  const { wasmUrl, wasmBinary, wasmModule } = options;
  if (wasmUrl !== undefined && typeof wasmUrl !== "string" && !(wasmUrl instanceof URL)) {
    place.at("wasmUrl").fail(wasmUrl, "a string or a URL");
  }
  if (wasmBinary !== undefined && !(wasmBinary instanceof ArrayBuffer) && !ArrayBuffer.isView(wasmBinary)) {
    place.at("wasmBinary").fail(wasmBinary, "an ArrayBuffer or a typed array");
  }
  if (wasmModule !== undefined && !(wasmModule instanceof WebAssembly.Module)) {
    place.at("wasmModule").fail(wasmModule, "a WebAssembly.Module");
  }
  return options;
}

/**
 * The module the options name, or the one `beside` finds. Errors: load-failed, or invalid-option for bytes that are
 * none.
 */
export async function compile(options: InitOptions, beside: () => Promise<Binary>): Promise<WebAssembly.Module> {
  const { wasmUrl, wasmBinary, wasmModule } = options;
  if (wasmModule) return wasmModule;
  const source = wasmUrl
    ? `the WASM at ${absolute(wasmUrl).href}`
    : wasmBinary
      ? "wasmBinary"
      : "the WASM of the package";
  let binary: Binary | undefined;
  try {
    binary = wasmBinary ?? (await (wasmUrl ? fetchBinary(absolute(wasmUrl)) : beside()));
    return await WebAssembly.compile(binary);
  } catch (error) {
    // A policy against compiling refuses what is valid, too.
    const wrong = wasmBinary && !WebAssembly.validate(wasmBinary);
    if (wrong) throw notOurs(source, error);
    throw new PliantError("load-failed", `${source} cannot be loaded: ${reasonOf(error)}`, { cause: error });
  }
}

/**
 * Starts emscripten's glue on a compiled module: it loads nothing by itself. Errors: invalid-option for a module of
 * another origin.
 */
export async function instantiate<T extends { Scratch?: unknown }>(
  factory: ModuleFactory<T>, module: WebAssembly.Module,
): Promise<T> {
  try {
    return await new Promise((resolve, reject) => {
      const instantiateWasm = (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) => {
        WebAssembly.instantiate(module, imports).then(done).catch(reject);
        return {};
      };
      factory({ instantiateWasm }).then(
        (raw) => (raw.Scratch ? resolve(raw) : reject(new Error("it lacks what is needed"))), reject,
      );
    });
  } catch (error) {
    throw notOurs("the WASM module", error);
  }
}

function notOurs(source: string, error: unknown): PliantError {
  const message = `${source} cannot be used: ${reasonOf(error)}; expected the pliant.wasm of this version`;
  return new PliantError("invalid-option", message, { cause: error });
}

function reasonOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

export function absolute(url: string | URL): URL {
  return new URL(url, globalThis.location?.href ?? `file://${process.cwd()}/`);
}

export async function fetchBinary(url: URL): Promise<Binary> {
  if (url.protocol === "file:" && nodeModule("node:fs")) {
    return new Uint8Array(await nodeModule("node:fs")!.promises.readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url.href} answers ${response.status}`);
  return response.arrayBuffer();
}

/** A built-in of Node, or undefined elsewhere: no import that a bundler for the browser would follow. @internal */
export function nodeModule<Name extends keyof NodeModules>(name: Name): NodeModules[Name] | undefined {
  return globalThis.process?.getBuiltinModule?.(name) as NodeModules[Name] | undefined;
}

/** @internal */
interface NodeModules {
  "node:fs": typeof import("node:fs");
  "node:worker_threads": typeof import("node:worker_threads");
}
