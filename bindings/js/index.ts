// pliant: the package, with `pliant.wasm` loaded from beside it.

import { makeInit } from "./init.js";
import { fetchBinary } from "./boundary/wasm.js";

export * from "./public.js";

/** Starts the library; every call gives the same one. Options left out: `pliant.wasm` beside this script. */
export const init = makeInit(() => fetchBinary(new URL("./pliant.wasm", import.meta.url)));
