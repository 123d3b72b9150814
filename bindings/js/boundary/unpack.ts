// The WASM inside the script.

import packed from "#wasm/inline";

/** No fetch, not even of a data: URL: a strict content-security policy refuses it. */
export async function unpack(): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}
