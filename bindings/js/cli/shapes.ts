// Shape files of every format, by their extension.

import { readFile } from "node:fs/promises";
import { extname } from "node:path";
import { Failure, onFile } from "./failure.js";
import { Glb, glbOf } from "../io/glb.js";
import type { Refinement } from "../deform/sketch.js";
import { type Mesh, ShapeDocument } from "../io/files.js";
import { refinedMesh } from "../io/refined.js";

/** Formats that pliant-io knows, and that can be passed through in pieces. */
export const streamable = ["obj", "ply", "off", "stl", "xyz"];
const formats = [...streamable, "glb"];

/** The format of a file by its extension. */
export function formatOf(path: string, among: readonly string[] = formats): string {
  const format = extname(path).slice(1).toLowerCase();
  if (among.includes(format)) return format;
  throw new Failure(`${path}: the extension is ${format ? `.${format}` : "missing"}; expected ${among.map((name) => `.${name}`).join(" ")}`);
}

/** A shape that was read, to be written with its vertices elsewhere. */
export interface ShapeFile {
  path: string;
  format: string;
  mesh: Mesh;
  /** The same file with other positions, in any format; with a refinement, what a mesh has: positions, faces and texture coordinates. */
  write(format: string, positions: Float64Array, refinement?: Refinement): Promise<Uint8Array>;
  /** One .glb that shows positions one after the other, at times in seconds. */
  animate(frames: Float64Array[], times: number[]): Promise<Uint8Array>;
}

/** Errors: a Failure that names the file. */
export function readShape(path: string): Promise<ShapeFile> {
  const format = formatOf(path);
  return onFile(path, async () => {
    const bytes = await readFile(path);
    return format === "glb" ? fromGlb(path, bytes) : fromDocument(path, format, bytes);
  });
}

async function fromDocument(path: string, format: string, bytes: Uint8Array): Promise<ShapeFile> {
  const document = await ShapeDocument.read(format, bytes);
  const { mesh } = document;
  return {
    path, format, mesh,
    write: async (to, positions, refinement) => {
      if (refinement) return writeMesh(to, refinedMesh(mesh, refinement), positions);
      return to === "glb" ? writeMesh(to, mesh, positions) : document.write(to, positions);
    },
    animate: (frames, times) => {
      const { glb, expand } = glbOf(mesh);
      glb.animate(frames.map(expand), times);
      return glb.write(expand(mesh.positions));
    },
  };
}

async function writeMesh(format: string, mesh: Mesh, positions: Float64Array): Promise<Uint8Array> {
  if (format !== "glb") return (await ShapeDocument.from(mesh)).write(format, positions);
  const { glb, expand } = glbOf(mesh);
  return glb.write(expand(positions));
}

async function fromGlb(path: string, bytes: Uint8Array): Promise<ShapeFile> {
  const { mesh } = await Glb.read(bytes);
  return {
    path, format: "glb", mesh,
    write: async (to, positions, refinement) => {
      if (refinement) return writeMesh(to, refinedMesh(mesh, refinement), positions);
      return to === "glb" ? (await Glb.read(bytes)).write(positions) : writeMesh(to, mesh, positions);
    },
    animate: async (frames, times) => {
      const glb = await Glb.read(bytes);
      glb.animate(frames, times);
      return glb.write(mesh.positions);
    },
  };
}
