// A shape with the vertices that refinement added: the library says what becomes of its faces, colours and picture.
import { refined, type Mesh, type WritableShape } from "pliant/worker";
import type { Refinement } from "../solver/pliant.ts";
import type { ShapeData } from "./shape.ts";

/** Texture coordinates of vertices, from those of corners: a shape with a picture has one pair a vertex. */
export function ofVertices(
  { positions, faceVertices, texcoords }: Pick<Mesh, "positions" | "faceVertices" | "texcoords">,
): Float32Array {
  const uv = new Float32Array((2 * positions.length) / 3);
  for (let corner = 0; corner < faceVertices.length; corner++) {
    uv[2 * faceVertices[corner]!] = texcoords[2 * corner]!;
    uv[2 * faceVertices[corner]! + 1] = texcoords[2 * corner + 1]!;
  }
  return uv;
}

const ofCorners = (uv: Float32Array, triangles: Uint32Array): Float64Array =>
  Float64Array.from({ length: 2 * triangles.length }, (_, i) => uv[2 * triangles[i >> 1]! + (i & 1)]!);

/** What a file of the shape holds. */
export function asFile({ file, exact, positions, triangles, colors, picture }: ShapeData): WritableShape {
  if (file) return file;
  return {
    positions: exact ?? positions, triangles,
    ...(colors ? { colors } : {}), ...(picture ? { texcoords: ofCorners(picture.uv, triangles) } : {}),
  };
}

/** With its faces spelled out, and at rest where the shape is. */
function meshOf(shape: ShapeData): Mesh {
  const { triangles, faceVertices, faceOffsets, texcoords, colors } = asFile(shape);
  const none = new Float64Array(0);
  return {
    positions: shape.exact ?? Float64Array.from(shape.positions), triangles: triangles!,
    faceVertices: faceVertices ?? triangles!,
    faceOffsets: faceOffsets ?? Uint32Array.from({ length: triangles!.length / 3 + 1 }, (_, i) => 3 * i),
    texcoords: texcoords ?? none, colors: colors ?? new Uint8Array(0),
  };
}

let last: { shape: ShapeData; refinement: Refinement; result: ShapeData } | undefined;

/** Positions are those at rest. The same result for the same refinement. */
export function refinedShape(shape: ShapeData, refinement: Refinement | undefined): ShapeData {
  if (!refinement || refinement.parents.length === 0) return shape;
  if (last?.shape === shape && last.refinement === refinement) return last.result;
  const mesh = refined(meshOf(shape), refinement);
  const { exact: _, ...rest } = shape;
  const result: ShapeData = {
    ...rest, positions: Float32Array.from(mesh.positions), triangles: mesh.triangles,
    ...(shape.file ? { file: { ...mesh, ...(shape.file.texture ? { texture: shape.file.texture } : {}) } } : {}),
    ...(shape.colors ? { colors: mesh.colors } : {}),
    ...(shape.picture ? { picture: { ...shape.picture, uv: ofVertices(mesh) } } : {}),
  };
  last = { shape, refinement, result };
  return result;
}
