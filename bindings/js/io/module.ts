// pliant-io.wasm, started when the first file is read or written.

import { PliantError } from "../boundary/errors.js";
import type { RawIoModule, RawObject } from "../boundary/raw.js";
import { type Binary, compile, type InitOptions, instantiate } from "../boundary/wasm.js";

/** Names what is to be deleted when work is done. */
type Free = <R extends RawObject>(object: R) => R;

/** Work on a started module. */
type Work<T> = (module: RawIoModule, free: Free) => Promise<T>;

/** Work whose results come one after another. */
type Stream<T> = (module: RawIoModule, free: Free) => AsyncGenerator<T>;

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
    const once = this.stream(async function* (module, free) {
      yield await work(module, free);
    });
    const { value } = await once.next();
    await once.next();
    return value as T;
  }

  /** Whoever stops asking ends the work. */
  async *stream<T>(work: Stream<T>): AsyncGenerator<T> {
    const module = await this.start();
    const objects: RawObject[] = [];
    const free: Free = (object) => {
      objects.push(object);
      return object;
    };
    let lives = true;
    try {
      yield* work(module, free);
    } catch (error) {
      lives = !(error instanceof WebAssembly.RuntimeError);
      if (lives) throw error;
      this.#started = undefined;
      throw stopped(error as Error);
    } finally {
      if (lives) for (const object of objects) object.delete();
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
