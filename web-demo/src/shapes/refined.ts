// A shape with the vertices that refinement added, each in the middle of its parents.
import type { ShapeData } from "./shape.ts";

interface Refinement {
  parents: ArrayLike<number>;
  triangles: Uint32Array;
}

function carried<T extends Uint8Array | Float32Array>(values: T, width: number, parents: ArrayLike<number>): T {
  const out = new (values.constructor as new (length: number) => T)(values.length + (width * parents.length) / 2);
  out.set(values);
  for (let i = 0, at = values.length; i < parents.length; i += 2) {
    for (let k = 0; k < width; k++, at++) {
      out[at] = (out[parents[i]! * width + k]! + out[parents[i + 1]! * width + k]!) / 2;
    }
  }
  return out;
}

let last: { shape: ShapeData; refinement: Refinement; result: ShapeData } | undefined;

/** Positions are those at rest. The same result for the same refinement. */
export function refinedShape(shape: ShapeData, refinement: Refinement | undefined): ShapeData {
  if (!refinement || refinement.parents.length === 0) return shape;
  if (last?.shape === shape && last.refinement === refinement) return last.result;
  const { parents, triangles } = refinement;
  const { file: _, exact: __, ...rest } = shape; // the file names the old faces only
  const result: ShapeData = {
    ...rest, triangles, positions: carried(shape.positions, 3, parents),
    ...(shape.colors ? { colors: carried(shape.colors, 3, parents) } : {}),
    ...(shape.picture ? { picture: { ...shape.picture, uv: carried(shape.picture.uv, 2, parents) } } : {}),
  };
  last = { shape, refinement, result };
  return result;
}
