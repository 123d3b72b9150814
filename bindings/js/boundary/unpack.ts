// The WASM inside the script.

import packed from "#wasm/inline";
import { gunzip } from "./gunzip.js";

export const unpack = (): Promise<ArrayBuffer> => gunzip(packed);
