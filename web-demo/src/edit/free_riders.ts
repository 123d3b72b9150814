// Which loose parts ride on the others (shapes/riders.ts).
import type { Rider } from "../shapes/riders.ts";
import type { Doc } from "./document.ts";

/** Not where the method carries space, nor those that are held or drawn on themselves. `labels`: of the limb under strokes. */
export function freeRiders(riders: readonly Rider[], { sketch, method, handles, fixed }: Doc, labels: ArrayLike<number> | undefined): Rider[] {
  const carriesSpace = (sketch ? sketch.finish : method) === "embedded-graph";
  if (carriesSpace || riders.length === 0) return [];
  const held = new Set([...fixed, ...handles.flatMap((h) => [...h.vertices])]);
  const taken = (v: number) => (sketch ? (labels?.[v] ?? 0) > 0 : held.has(v));
  return riders.filter((rider) => !rider.vertices.some(taken));
}
