// pliant/three: a three.js BufferGeometry joined to a deformer. Vertex ids are those of the
// geometry's attributes: vertices repeated for UV seams or groups are welded inside and scattered back.

import type { BufferAttribute, BufferGeometry, InterleavedBufferAttribute } from "three";
import { Place } from "./boundary/check.js";
import { NormalGroups } from "./shape/normals.js";
import type { ShapeInput } from "./shape/shape.js";
import { snapped } from "./shape/weld.js";

type Attribute = BufferAttribute | InterleavedBufferAttribute;

/** Vertices closer than this part of the size are one: generated geometries close their seams only so well. */
const seam = 1e-6;

/** The shape of a geometry, indexed or not, for `pliant.shape`. `points`: leave out the triangles. Errors: invalid-shape. */
export function shapeOf(geometry: BufferGeometry, { points = false } = {}): ShapeInput & { positions: Float32Array } {
  const positions = restOf(geometry);
  return points ? { positions } : { positions, triangles: trianglesOf(geometry, positions.length / 3) };
}

/** Keeps a geometry up to date with a deformer over its shape. */
export class GeometryBinding {
  readonly geometry: BufferGeometry;
  readonly #positions: Float32Array;
  readonly #normals: Float32Array | undefined;
  readonly #groups: NormalGroups | undefined;

  /** Takes the geometry as it is now for the shape at rest. Normals are updated where it has them. */
  constructor(geometry: BufferGeometry) {
    this.geometry = geometry;
    this.#positions = restOf(geometry);
    const normal = geometry.getAttribute("normal") as Attribute | undefined;
    const triangles = trianglesOf(geometry, this.#positions.length / 3);
    if (!normal || triangles.length === 0) return;
    this.#normals = read(normal);
    this.#groups = new NormalGroups(this.#positions, this.#normals, triangles);
  }

  /** Takes positions from a deformer over `shapeOf(geometry)`. */
  update(deformer: { positions(out: Float32Array): Float32Array }): void {
    this.write(deformer.positions(this.#positions));
  }

  /** Takes positions from elsewhere, for example a worker: three numbers a vertex. Errors: invalid-option. */
  write(positions: Float32Array): void {
    const { length } = this.#positions;
    const fits = positions instanceof Float32Array && positions.length === length;
    if (!fits) new Place("invalid-option", "positions").fail(positions, `a Float32Array of length ${length}`);
    store(positionOf(this.geometry), positions);
    if (this.#groups && this.#normals) {
      this.#groups.compute(positions, this.#normals);
      store(this.geometry.getAttribute("normal"), this.#normals);
    }
    this.geometry.computeBoundingBox();
    this.geometry.computeBoundingSphere();
  }
}

function positionOf(geometry: BufferGeometry): Attribute {
  const place = new Place("invalid-shape", "geometry");
  if (!geometry?.isBufferGeometry) place.fail(geometry, "a BufferGeometry");
  const position = geometry.getAttribute("position") as Attribute | undefined;
  return position?.itemSize === 3 ? position : place.reject("has no position attribute of three numbers a vertex; expected one");
}

function restOf(geometry: BufferGeometry): Float32Array {
  const positions = read(positionOf(geometry));
  const size = [0, 1, 2].map((axis) => {
    const along = positions.filter((_, i) => i % 3 === axis);
    return along.reduce((a, b) => Math.max(a, b), -Infinity) - along.reduce((a, b) => Math.min(a, b), Infinity);
  });
  return snapped(positions, seam * Math.hypot(...size));
}

/** Without an index, every three vertices are a triangle. */
function trianglesOf(geometry: BufferGeometry, vertices: number): Uint32Array {
  if (geometry.index) return Uint32Array.from(geometry.index.array);
  return Uint32Array.from({ length: vertices - (vertices % 3) }, (_, i) => i);
}

function read(attribute: Attribute): Float32Array {
  const values = new Float32Array(3 * attribute.count);
  for (let i = 0; i < attribute.count; ++i) values.set([attribute.getX(i), attribute.getY(i), attribute.getZ(i)], 3 * i);
  return values;
}

function store(attribute: Attribute, values: Float32Array): void {
  const plain = attribute as BufferAttribute;
  if (plain.isBufferAttribute && plain.array instanceof Float32Array) plain.array.set(values);
  else for (let i = 0; i < attribute.count; ++i) attribute.setXYZ(i, values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  (("data" in attribute ? attribute.data : attribute) as BufferAttribute).needsUpdate = true;
}
