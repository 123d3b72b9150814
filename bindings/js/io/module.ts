// pliant-io.wasm, started when the first file is read or written.

import { PliantError } from "../boundary/errors.js";
import type { RawIoModule, RawObject } from "../boundary/raw.js";
import { type Binary, compile, type InitOptions, instantiate } from "../boundary/wasm.js";

/** Work on a started module. `free` names what is to be deleted when it is done. */
type Work<T> = (module: RawIoModule, free: <R extends RawObject>(object: R) => R) => Promise<T>;

/** The module, and how it comes to be. After a trap, which memory running out ends in, the next call starts it anew. */
export class IoModule {
  #started: Promise<RawIoModule> | undefined;

  /** `beside`: the WASM to take when the options name none. */
  constructor(readonly options: InitOptions, readonly beside: () => Promise<Binary>) {}

  /** Starts the module, if it is not. Errors: invalid-option. */
  async start(): Promise<RawIoModule> {
    const load = async () => {
      const { default: createModule } = await import("#wasm/pliant-io.mjs");
      return instantiate(createModule, await compile(this.options, this.beside));
    };
    this.#started ??= load();
    try {
      return await this.#started;
    } catch (error) {
      this.#started = undefined;
      throw error;
    }
  }

  async use<T>(work: Work<T>): Promise<T> {
    const module = await this.start();
    const objects: RawObject[] = [];
    const free = <R extends RawObject>(object: R): R => {
      objects.push(object);
      return object;
    };
    try {
      const result = await work(module, free);
      for (const object of objects) object.delete();
      return result;
    } catch (error) {
      if (error instanceof WebAssembly.RuntimeError) {
        this.#started = undefined;
        throw stopped(error);
      }
      for (const object of objects) object.delete();
      throw error;
    }
  }
}

/** The module calls abort where memory has run out; anything else is a fault of its own. */
function stopped(error: Error): PliantError {
  const reason = `the WASM module stopped (${error.message})`;
  if (/unreachable|abort/i.test(error.message)) {
    return new PliantError("too-large", `${reason}, most likely out of memory; expected a smaller file`, {
      cause: error,
    });
  }
  return new PliantError("crashed", reason, { cause: error });
}
