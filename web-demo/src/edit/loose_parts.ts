// Keeps loose parts on what they belong to (shapes/riders.ts), and tells the script about it.
import { carriesSpace } from "../methods.ts";
import { carry, ridersOf, type Rider } from "../shapes/riders.ts";
import type { ShapeData } from "../shapes/shape.ts";
import type { Topology } from "../shapes/topology.ts";
import { placeStep, type Doc } from "./document.ts";
import type { DocumentStep } from "../solver/pliant.ts";

export class LooseParts {
  private riders: Rider[] = [];
  private free: Rider[] = [];

  take(shape: ShapeData, topology: Topology | undefined): void {
    this.riders = topology ? ridersOf(shape, topology) : [];
    this.free = [];
  }

  /**
   * Those that ride: not where the method carries space, nor those held or drawn on themselves. `labels`: of the limb
   * under strokes.
   */
  find({ sketch, method, handles, fixed }: Doc, labels: ArrayLike<number> | undefined): void {
    if (carriesSpace(sketch ? sketch.finish : method) || this.riders.length === 0) {
      this.free = [];
      return;
    }
    const held = new Set([...fixed, ...handles.flatMap((h) => [...h.vertices])]);
    const taken = (v: number) => (sketch ? (labels?.[v] ?? 0) > 0 : held.has(v));
    this.free = this.riders.filter((rider) => !rider.vertices.some(taken));
  }

  /** Moves them, in place. */
  carry({ shape }: Doc, positions: Float32Array, normals?: Float32Array): void {
    carry(this.free, shape.positions, positions, normals);
  }

  /** The same, as steps of the script: one, or none where nothing rides. */
  steps({ shape }: Doc, positions: Float32Array | Float64Array): DocumentStep[] {
    const moved = carry(this.free, shape.exact ?? shape.positions, positions);
    return moved.length > 0 ? [placeStep(moved, positions)] : [];
  }
}
