// The polygons of a file after refinement: those that were split become triangles, the others stay.

import { extended } from "../edit/growth.js";
import type { Refinement } from "../deform/sketch.js";
import type { Mesh } from "./shape_file.js";

/**
 * A shape that was read, at rest, with the vertices of a refinement. Faces that were split become triangles. Colours of
 * a new vertex are those between its parents, texture coordinates of a new corner those between its parents in the same
 * triangle.
 */
export function refined(mesh: Mesh, refinement: Refinement): Mesh {
  const { faceVertices, faceOffsets } = mesh;
  const out = new Corners();
  const parts = new TriangleParts(mesh, refinement);
  for (let face = 0, first = 0; face + 1 < faceOffsets.length; ++face) {
    const [begin, end] = [faceOffsets[face], faceOffsets[face + 1]];
    const last = first + Math.max(0, end - begin - 2);
    if (parts.count(first, last) === last - first) {
      out.face(mesh.triangles.subarray(3 * first, 3 * last), (add) => {
        for (let corner = begin; corner < end; ++corner) {
          add(faceVertices[corner], mesh.texcoords.subarray(2 * corner, 2 * corner + 2));
        }
      });
    } else {
      for (let triangle = first; triangle < last; ++triangle) parts.each(triangle, out);
    }
    first = last;
  }
  const colors = Uint8Array.from(
    extended(Float64Array.from(mesh.colors), mesh.colors.length > 0 ? 3 : 0, refinement.parents), Math.round,
  );
  return out.mesh(extended(mesh.positions, 3, refinement.parents), colors);
}

/** Corners in `faceVertices` of the triangles: a polygon of k corners has k - 2 of them, in order. */
export function triangleCorners({ faceVertices, faceOffsets, triangles }: Mesh): Uint32Array {
  const corners = new Uint32Array(triangles.length);
  let at = 0;
  for (let face = 0; face + 1 < faceOffsets.length; ++face) {
    const [begin, end] = [faceOffsets[face], faceOffsets[face + 1]];
    for (const last = at + 3 * (end - begin - 2); at < last; ++at) {
      corners[at] = faceVertices.indexOf(triangles[at], begin);
    }
  }
  return corners;
}

/** What each triangle of a mesh was split into. */
class TriangleParts {
  /** Where the parts of a triangle begin: they follow the order of the triangles. */
  readonly #begins: Uint32Array;
  readonly #corners: Uint32Array;

  constructor(readonly from: Mesh, readonly refinement: Refinement) {
    const { triangleParents } = refinement;
    this.#begins = new Uint32Array(from.triangles.length / 3 + 1);
    for (const parent of triangleParents) ++this.#begins[parent + 1];
    for (let t = 1; t < this.#begins.length; ++t) this.#begins[t] += this.#begins[t - 1];
    this.#corners = from.texcoords.length > 0 ? triangleCorners(from) : new Uint32Array(0);
  }

  /** How many parts the triangles from `first` to before `last` have. */
  count(first: number, last: number): number {
    return this.#begins[last] - this.#begins[first];
  }

  each(triangle: number, out: Corners): void {
    const uv = this.#texcoordsIn(triangle);
    for (let part = this.#begins[triangle]; part < this.#begins[triangle + 1]; ++part) {
      const ids = this.refinement.triangles.subarray(3 * part, 3 * part + 3);
      out.face(ids, (add) => ids.forEach((v) => add(v, uv(v))));
    }
  }

  /** Texture coordinates of the vertices on one triangle. */
  #texcoordsIn(triangle: number): (vertex: number) => ArrayLike<number> {
    const { triangles, texcoords, positions } = this.from;
    const known = new Map<number, ArrayLike<number>>();
    for (let k = 3 * triangle; k < 3 * triangle + 3; ++k) {
      known.set(triangles[k], texcoords.subarray(2 * this.#corners[k], 2 * this.#corners[k] + 2));
    }
    const find = (vertex: number): ArrayLike<number> => {
      const found = known.get(vertex);
      if (found) return found;
      const at = 2 * (vertex - positions.length / 3);
      const [a, b] = [find(this.refinement.parents[at]), find(this.refinement.parents[at + 1])];
      const middle = Array.from(a, (x, i) => (x + b[i]) / 2);
      known.set(vertex, middle);
      return middle;
    };
    return find;
  }
}

/** A mesh in the making, face by face. */
class Corners {
  readonly #faceVertices: number[] = [];
  readonly #faceOffsets: number[] = [0];
  readonly #triangles: number[] = [];
  readonly #texcoords: number[] = [];

  /** `triangles`: the face cut into triangles. */
  face(triangles: Uint32Array, corners: (add: (vertex: number, uv: ArrayLike<number>) => void) => void): void {
    corners((vertex, uv) => {
      this.#faceVertices.push(vertex);
      for (let i = 0; i < uv.length; ++i) this.#texcoords.push(uv[i]);
    });
    this.#faceOffsets.push(this.#faceVertices.length);
    for (const vertex of triangles) this.#triangles.push(vertex);
  }

  mesh(positions: Float64Array, colors: Uint8Array): Mesh {
    return {
      positions,
      colors,
      triangles: Uint32Array.from(this.#triangles),
      faceVertices: Uint32Array.from(this.#faceVertices),
      faceOffsets: Uint32Array.from(this.#faceOffsets),
      texcoords: Float64Array.from(this.#texcoords),
    };
  }
}
