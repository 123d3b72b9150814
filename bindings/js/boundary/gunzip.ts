// What build.mjs packs into a script, unpacked.

/** Gzipped bytes in base64. No fetch, not even of a data: URL: a strict content-security policy refuses it. */
export function gunzip(base64: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}
