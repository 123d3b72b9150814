// pliant/inline: the same package with the WASM inside the script, for pages opened from a file.

import packed from "#wasm/inline";
import { makeInit } from "./init.js";

export * from "./public.js";

/** No fetch, not even of a data: URL: a strict content-security policy refuses it. */
async function unpack(): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

export const init = makeInit(unpack);
