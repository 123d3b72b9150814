// The installed package.

import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { inject } from "vitest";

export const consumer = inject("consumer");
export const installed = join(consumer, "node_modules/pliant");

export interface Entries {
  pliant: typeof import("../../../bindings/js/index.js");
  inline: typeof import("../../../bindings/js/inline.js");
  io: typeof import("../../../bindings/js/io.js");
  worker: typeof import("../../../bindings/js/worker.js");
  three: typeof import("../../../bindings/js/three.js");
  picture: typeof import("../../../bindings/js/picture.js");
}

export const entries = (await import(/* @vite-ignore */ pathToFileURL(join(consumer, "entries.mjs")).href)) as Entries;
export const pliant = await entries.pliant.init();
export const { PliantError } = entries.pliant;

/**
 * What an action throws or rejects with: a PliantError's code, message and cause, anything else as it is. `inline` has
 * a class of its own.
 */
export async function errorOf(
  action: () => unknown, ErrorClass = PliantError,
): Promise<{ code: string; message: string; cause?: unknown }> {
  try {
    await action();
  } catch (error) {
    if (error instanceof ErrorClass) return { code: error.code, message: error.message, cause: error.cause };
    throw error;
  }
  return { code: "none", message: "nothing was thrown" };
}
