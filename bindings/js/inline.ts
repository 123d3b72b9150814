// pliant/inline: the same package with the WASM inside the script, for pages opened from a file.

import { makeInit } from "./init.js";
import { unpack } from "./boundary/unpack.js";

export * from "./public.js";

/** Starts the library; every call gives the same one. Options left out: the WASM inside. */
export const init = makeInit(unpack);
