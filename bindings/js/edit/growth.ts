// Numbers of vertices: of some of them, and of those that the refinements of a script have added, one after the other.

import type { FloatArray } from "../boundary/check.js";
import type { Refinement } from "../deform/sketch.js";

/** A refinement of what `growth` made of the input, as one of the input. */
export function grown(growth: Refinement | undefined, next: Refinement): Refinement {
  if (!growth) return next;
  const parents = new Uint32Array(growth.parents.length + next.parents.length);
  parents.set(growth.parents);
  parents.set(next.parents, growth.parents.length);
  return {
    parents, triangles: next.triangles, triangleParents: next.triangleParents.map((t) => growth.triangleParents[t]),
  };
}

/** Values of the input's vertices, `width` numbers each, and those of the vertices added between them. */
export function extended(values: Float64Array, width: number, parents: ArrayLike<number>): Float64Array {
  const result = new Float64Array(values.length + (width * parents.length) / 2);
  result.set(values);
  for (let i = 0, at = values.length; i < parents.length; i += 2) {
    const [a, b] = [parents[i] * width, parents[i + 1] * width];
    for (let k = 0; k < width; ++k) result[at++] = (result[a + k] + result[b + k]) / 2;
  }
  return result;
}

/** Labels of the input's vertices, and of those added: between two parts lies the region. */
export function extendedLabels(labels: Uint32Array, parents: ArrayLike<number>): Uint32Array {
  const result = new Uint32Array(labels.length + parents.length / 2);
  result.set(labels);
  for (let i = 0, at = labels.length; i < parents.length; i += 2, ++at) {
    const [a, b] = [result[parents[i]], result[parents[i + 1]]];
    result[at] = a === b ? a : 1;
  }
  return result;
}

/** Of some vertices, `width` numbers each. */
export function gathered(values: FloatArray, ids: Int32Array, width: number): Float64Array {
  const own = new Float64Array(width * ids.length);
  ids.forEach((id, i) => own.set(values.subarray(width * id, width * (id + 1)), width * i));
  return own;
}

/** Numbers in rows. */
export function rows(values: ArrayLike<number>, width: number): number[][] {
  return Array.from({ length: values.length / width }, (_, row) =>
    Array.from({ length: width }, (__, k) => values[row * width + k]));
}
