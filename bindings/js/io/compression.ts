// Compressed binary glTF: decoders come with the package and are loaded when a file asks for one.

import type { Document } from "@gltf-transform/core";
import { gunzip } from "../boundary/gunzip.js";

const draco = "KHR_draco_mesh_compression";
const meshopt = "EXT_meshopt_compression";

/** What gltf-transform needs to read these bytes, by the names it has for it. */
export async function decodersFor(bytes: Uint8Array): Promise<Record<string, unknown>> {
  const text = description(bytes);
  const decoders: Record<string, unknown> = {};
  if (text.includes(draco)) decoders["draco3d.decoder"] = await dracoDecoder();
  if (text.includes(meshopt)) decoders["meshopt.decoder"] = await meshoptDecoder();
  return decoders;
}

/** Takes compression off a document that has been read: what is written from it is plain, which every reader takes. */
export function withoutCompression(document: Document): Document {
  for (const extension of document.getRoot().listExtensionsUsed()) {
    if ([draco, meshopt].includes(extension.extensionName)) extension.dispose();
  }
  return document;
}

/** The JSON of a .glb; empty where there is none, as the reader will say. */
function description(bytes: Uint8Array): string {
  const header = 20;
  if (bytes.length < header) return "";
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true);
  return new TextDecoder().decode(bytes.subarray(header, header + length));
}

async function dracoDecoder(): Promise<unknown> {
  const { default: createDecoder, wasm } = await import("#draco");
  return createDecoder({ wasmBinary: await gunzip(wasm) });
}

async function meshoptDecoder(): Promise<unknown> {
  const { MeshoptDecoder } = await import("meshoptimizer/decoder");
  await MeshoptDecoder.ready;
  return MeshoptDecoder;
}
