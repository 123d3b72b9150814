// A picture as a shape in the plane.

import type { Core } from "../boundary/core.js";
import { Shape } from "../shape/shape.js";
import type { Image } from "./image.js";
import type { PictureMesh } from "./mesh.js";

/**
 * Made by `pliant.picture`: the visible part of a picture as a mesh in the plane, which every method works on.
 * Coordinates
 * are pixels from the bottom left corner, y up. The arrays are copies.
 */
export class Picture extends Shape {
  readonly #mesh: PictureMesh;

  /** @internal */
  constructor(core: Core, mesh: PictureMesh) {
    super(core, { positions: mesh.positions, triangles: mesh.triangles, dimension: 2 });
    this.#mesh = mesh;
  }

  /** Two numbers a vertex. */
  get positions(): Float64Array {
    return this.#mesh.positions.slice();
  }

  /** Three vertex ids each, counterclockwise; where the shape overlaps itself, a triangle lies over those before it. */
  get triangles(): Uint32Array {
    return this.#mesh.triangles.slice();
  }

  /** Two numbers a vertex, from 0 to 1 over the picture, v up. */
  get texcoords(): Float32Array {
    return this.#mesh.texcoords.slice();
  }

  /** What is to be seen on the shape: the picture, with what is background made transparent. */
  get image(): Image {
    const { width, height, data } = this.#mesh.image;
    return { width, height, data: data.slice() };
  }
}
