// Handles: sets of vertices that are moved.

import { coordinates, Place, toSpace } from "../boundary/check.js";
import type { Owned } from "../boundary/core.js";
import { PliantError } from "../boundary/errors.js";
import type { RawDeformer, RawStatus } from "../boundary/raw.js";
import { insideOf, type Shape } from "../shape/shape.js";
import { applyMatrix, centroidOf, packTransform, readTransform, type Transform } from "../shape/transform.js";

/** Made by `deformer.addHandle`. */
export class Handle {
  readonly #deformer: Owned<RawDeformer>;
  readonly #shape: Shape;
  readonly #id: number;
  readonly #vertices: Int32Array;
  readonly #forget: () => void;
  #removed = false;

  /** @internal */
  constructor(deformer: Owned<RawDeformer>, shape: Shape, id: number, vertices: Int32Array, forget: () => void) {
    this.#deformer = deformer;
    this.#shape = shape;
    this.#id = id;
    this.#vertices = vertices;
    this.#forget = forget;
  }

  /** Its vertices, in the order they were given. */
  get vertices(): Uint32Array {
    return Uint32Array.from(this.#vertices);
  }

  /**
   * Moves it from rest: an empty transform takes it back there. Degrees beyond 180 are honoured. Errors:
   * invalid-handle.
   */
  move(transform: Transform): void {
    const { dimension } = this.#shape;
    const checked = readTransform(new Place("invalid-handle", "transform"), transform, dimension);
    const rest = this.#rest();
    if (checked.kind === "matrix") {
      this.#setTargets(applyMatrix(checked.matrix, rest, dimension));
      return;
    }
    const packed = packTransform(checked, centroidOf(rest, dimension));
    this.#call((raw) => raw.moveHandle(this.#id, ...this.#deformer.core.stageValues(packed)));
  }

  /**
   * Moves each vertex to its own target: `shape.dimension` numbers a vertex, in the order of the vertices. Errors:
   * invalid-handle.
   */
  moveTo(targets: ArrayLike<number>): void {
    const place = new Place("invalid-handle", "targets");
    const { dimension } = this.#shape;
    const numbers = coordinates(place, targets, dimension);
    const expected = dimension * this.#vertices.length;
    if (numbers.length !== expected) {
      place.fail(
        targets, `${expected} numbers, ${dimension} for each of the handle's ${this.#vertices.length} vertices`,
      );
    }
    this.#setTargets(numbers);
  }

  /** Takes the handle off the shape. */
  remove(): void {
    this.#call((raw) => raw.removeHandle(this.#id));
    this.#removed = true;
    this.#forget();
  }

  #setTargets(targets: ArrayLike<number>): void {
    const space = toSpace(targets, this.#shape.dimension);
    this.#call((raw) => raw.setTargets(this.#id, this.#deformer.core.stage(space)));
  }

  #call(work: (raw: RawDeformer) => RawStatus): void {
    if (this.#removed) throw new PliantError("disposed", "this handle is removed; expected a live one");
    this.#deformer.accept(work);
  }

  /** Rest positions of its vertices. */
  #rest(): Float64Array {
    const { dimension } = this.#shape;
    const { rest } = insideOf(this.#shape);
    const own = new Float64Array(dimension * this.#vertices.length);
    this.#vertices.forEach((v, i) => own.set(rest.subarray(dimension * v, dimension * (v + 1)), dimension * i));
    return own;
  }
}
