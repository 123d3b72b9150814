// Tangents that follow a deformation: they lie in the triangles around their vertex and move with their edges, as the
// gradients of texture coordinates do.

/**
 * Tangents at rest, four numbers a vertex (the last is their handedness), in the edges of the triangles around them.
 */
export class TangentFrames {
  readonly #triangles: Uint32Array;
  /** Of each corner of a triangle: its vertex's tangent = a (q - p) + b (r - p) over the triangle's p, q, r. */
  readonly #coefficients: Float32Array;

  /** positions: three numbers a vertex. */
  constructor(positions: Float32Array, tangents: Float32Array, triangles: Uint32Array) {
    this.#triangles = triangles;
    this.#coefficients = new Float32Array(2 * triangles.length);
    for (let corner = 0; corner < triangles.length; ++corner) {
      const [u, v] = edges(positions, triangles, corner - (corner % 3));
      const t = tangents.subarray(4 * triangles[corner], 4 * triangles[corner] + 3);
      const [uu, uv, vv, ut, vt] = [dot(u, u), dot(u, v), dot(v, v), dot(u, t), dot(v, t)];
      const determinant = uu * vv - uv * uv;
      if (!(determinant > 0)) continue;
      this.#coefficients[2 * corner] = (vv * ut - uv * vt) / determinant;
      this.#coefficients[2 * corner + 1] = (uu * vt - uv * ut) / determinant;
    }
  }

  /** Unit tangents at right angles to the normals; vertices without one keep what `out` holds. */
  compute(positions: Float32Array, normals: Float32Array, out: Float32Array): void {
    const sums = new Float64Array(positions.length);
    for (let corner = 0; corner < this.#triangles.length; ++corner) {
      const [u, v] = edges(positions, this.#triangles, corner - (corner % 3));
      const [a, b] = [this.#coefficients[2 * corner], this.#coefficients[2 * corner + 1]];
      const at = 3 * this.#triangles[corner];
      for (let axis = 0; axis < 3; ++axis) sums[at + axis] += a * u[axis] + b * v[axis];
    }
    for (let vertex = 0; vertex < positions.length / 3; ++vertex) {
      const t = sums.subarray(3 * vertex, 3 * vertex + 3);
      const n = normals.subarray(3 * vertex, 3 * vertex + 3);
      const along = dot(t, n);
      for (let axis = 0; axis < 3; ++axis) t[axis] -= along * n[axis];
      const length = Math.hypot(t[0], t[1], t[2]);
      if (length > 0) for (let axis = 0; axis < 3; ++axis) out[4 * vertex + axis] = t[axis] / length;
    }
  }
}

type Vector = ArrayLike<number>;

function edges(p: Float32Array, triangles: Uint32Array, first: number): [Vector, Vector] {
  const [a, b, c] = [3 * triangles[first], 3 * triangles[first + 1], 3 * triangles[first + 2]];
  const edge = (to: number) => [p[to] - p[a], p[to + 1] - p[a + 1], p[to + 2] - p[a + 2]];
  return [edge(b), edge(c)];
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
