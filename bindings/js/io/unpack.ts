// pliant-io.wasm inside the script.

import packed from "#wasm/io-inline";
import { gunzip } from "../boundary/gunzip.js";

export const unpackIo = (): Promise<ArrayBuffer> => gunzip(packed);
