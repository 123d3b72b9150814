// What every result has, whether a solver found it or a stroke.

import { type FloatArray, output, Place, toSpace } from "../boundary/check.js";
import { accept, type Core, disposeSymbol, Owned } from "../boundary/core.js";
import type { RawDeformation, RawState } from "../boundary/raw.js";
import { readTables, type State, type StateHatch, toState, writeTables } from "../boundary/state.js";
import type { Shape } from "../shape/shape.js";
import { readNormals, readPoints } from "./carried.js";

const pointsPerCall = 1 << 16;

/** A shape and where it is now. Vertex ids are the input's; results are copies, in the input's order. */
export abstract class Deformation<S extends object = State, R extends RawDeformation = RawDeformation> {
  readonly shape: Shape;
  /** @internal */
  protected readonly owned: Owned<R>;

  /** `raw`: what is built; it belongs to this object, called `name` in messages. @internal */
  constructor(core: Core, shape: Shape, raw: R, name: string) {
    this.shape = shape;
    this.owned = new Owned(core, raw, this, name);
  }

  /** Vertices of the input, and those that were added. */
  get vertices(): number {
    return this.shape.report.vertices;
  }

  /** Deformed positions, `shape.dimension` numbers a vertex; a Float64Array for `out` gets them in double. */
  positions(): Float32Array;
  positions<T extends FloatArray>(out: T): T;
  positions(out?: FloatArray): FloatArray {
    const { dimension } = this.shape;
    return this.into(out, dimension, (raw, result) =>
      copyPoints(result instanceof Float64Array ? raw.positions64() : raw.positions(), result, 0, dimension));
  }

  /** Unit normals, three numbers a vertex. */
  normals(): Float32Array;
  normals<T extends FloatArray>(out: T): T;
  normals(out?: FloatArray): FloatArray {
    return this.into(out, 3, (raw, result) => result.set(raw.normals()));
  }

  /**
   * Other points, in rest coordinates, carried by the same deformation; single precision in, single out. `out` may be
   * `points`. Errors: not-solvable where the method does not deform space.
   */
  transformPoints(points: Float32Array): Float32Array;
  transformPoints(points: ArrayLike<number>): Float64Array;
  transformPoints<T extends FloatArray>(points: ArrayLike<number>, out: T): T;
  transformPoints(points: ArrayLike<number>, out?: FloatArray): FloatArray {
    const { dimension } = this.shape;
    const { given, result } = readPoints(points, out, dimension);
    const size = pointsPerCall * dimension;
    for (let at = 0; at < given.length; at += size) {
      this.owned.accept((raw) => {
        const carried = raw.transformPoints(this.owned.core.stage(toSpace(given.subarray(at, at + size), dimension)));
        if (carried.status.code === "ok") copyPoints(carried.points, result, at, dimension);
        return carried.status;
      });
    }
    return result;
  }

  /**
   * Normals of a surface at points in rest coordinates, three numbers a point, turned as the deformation turns the
   * surface there (by the cofactors of its differential); each keeps its length. In space alone.
   * `out` may be `normals`.
   * Errors: not-solvable where the method does not deform space, and in the plane.
   */
  transformNormals(points: ArrayLike<number>, normals: Float32Array): Float32Array;
  transformNormals(points: ArrayLike<number>, normals: ArrayLike<number>): Float64Array;
  transformNormals<T extends FloatArray>(points: ArrayLike<number>, normals: ArrayLike<number>, out: T): T;
  transformNormals(points: ArrayLike<number>, normals: ArrayLike<number>, out?: FloatArray): FloatArray {
    const { at, given, result } = readNormals(points, normals, out, this.shape.dimension);
    for (let begin = 0; begin < at.length; begin += 3 * pointsPerCall) {
      const [some, theirs] = [at, given].map((values) => values.subarray(begin, begin + 3 * pointsPerCall));
      const both = new Float64Array(2 * some.length);
      both.set(some);
      both.set(theirs, some.length);
      this.owned.accept((raw) => {
        const turned = raw.transformNormals(this.owned.core.stage(both));
        if (turned.status.code === "ok") result.set(turned.points, begin);
        return turned.status;
      });
    }
    return result;
  }

  /** All that is needed to recompute the result without Pliant. */
  state(): S {
    return this.#withState((raw, state) => {
      raw.save(state);
      return toState(readTables(state), this.stateHatch) as object as S;
    });
  }

  /**
   * Takes a state saved by the same method over the same shape; what it brings back beside positions is said there.
   * Errors: invalid-option.
   */
  restore(state: S): void {
    const place = new Place("invalid-option", "state");
    this.#withState((raw, saved) => {
      raw.save(saved);
      const like = readTables(saved);
      return this.#withState((_, given) => {
        writeTables(this.owned.core, given, place, state, like, this.optionalFields, this.stateHatch);
        accept(raw.restore(given));
      });
    });
  }

  /** Fields that a state may have or not: those of an edit's. @internal */
  protected get optionalFields(): readonly string[] {
    return ["follow"];
  }

  /** What its state has beside numbers. @internal */
  protected get stateHatch(): StateHatch | undefined {
    return undefined;
  }

  /** Back to rest, bit for bit; what was chosen to be held or moved stays so. */
  reset(): void {
    this.owned.call((raw) => raw.reset());
  }

  /** Frees its memory. Every later call is a `disposed` error. */
  dispose(): void {
    this.owned.dispose();
  }

  [disposeSymbol](): void {
    this.dispose();
  }

  /** Fills the caller's array, or a new one, with `width` numbers a vertex. @internal */
  protected into(out: FloatArray | undefined, width: number, fill: (raw: R, result: FloatArray) => void): FloatArray {
    const length = width * this.vertices;
    const result = output(new Place("invalid-option", "out"), out, length, () => new Float32Array(length));
    this.owned.call((raw) => fill(raw, result));
    return result;
  }

  #withState<T>(use: (raw: R, state: RawState) => T): T {
    const { core } = this.owned;
    return this.owned.call((raw) => core.using(() => new core.raw.State(), (state) => use(raw, state)));
  }
}

/** Carries points, and turns their normals, in place. Errors: not-solvable. */
export function carryThrough(deformation: Deformation, points: Float64Array, normals: Float64Array | undefined): void {
  if (normals) deformation.transformNormals(points, normals, normals);
  deformation.transformPoints(points, points);
}

/** Copies points out of WASM memory; the plane drops z. */
function copyPoints(from: FloatArray, to: FloatArray, at: number, dimension: number): void {
  if (dimension === 3) {
    to.set(from, at);
    return;
  }
  for (let i = 0; i < from.length; i += 3, at += 2) {
    to[at] = from[i];
    to[at + 1] = from[i + 1];
  }
}
