// `init`: one started module for all who ask, made when it is first asked for.

import createModule from "#wasm/pliant.mjs";
import { Core } from "./boundary/core.js";
import { Pliant } from "./pliant.js";
import { type Binary, compile, type InitOptions, instantiate, readInitOptions } from "./boundary/wasm.js";

/**
 * Starts the library once and gives it to every caller; a failed start is not kept. Errors: invalid-option,
 * load-failed.
 */
export type Init = (options?: InitOptions) => Promise<Pliant>;

/** `beside`: the WASM to take when the options name none. */
export function makeInit(beside: () => Promise<Binary>): Init {
  let current: Promise<Pliant> | undefined;
  const forget = () => (current = undefined);

  async function start(options: InitOptions): Promise<Pliant> {
    try {
      const module = await compile(options, beside);
      const raw = await instantiate(createModule, module);
      return new Pliant(new Core(raw, forget));
    } catch (error) {
      forget();
      throw error;
    }
  }

  return async (options) => {
    const checked = readInitOptions(options);
    current ??= start(checked);
    return current;
  };
}
