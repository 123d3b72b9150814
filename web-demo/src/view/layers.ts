// What lies over what, where a picture overlaps itself: the order its triangles are drawn in.
import { backToFront, spreadDepths } from "pliant/picture";
import type { Doc } from "../edit/document.ts";

/** Remembers the order as long as neither the pins nor their depths change. */
export class Layers {
  private known: { shape: unknown; key: readonly unknown[]; triangles: Uint32Array } | undefined;

  /** Triangles of the document's shape from back to front. */
  of(doc: Doc): Uint32Array {
    const { shape, handles, fixed } = doc;
    const key = [fixed, ...handles.flatMap(({ vertices, depth }) => [vertices, depth])];
    const { known } = this;
    if (known?.shape === shape && key.length === known.key.length && key.every((part, i) => part === known.key[i]))
      return known.triangles;
    const depths = depthsOf(doc);
    const triangles = depths ? backToFront(shape.triangles, depths) : shape.triangles;
    this.known = { shape, key, triangles };
    return triangles;
  }
}

/** How far in front each vertex lies; undefined where no pin says. */
export function depthsOf({ shape: { positions, triangles }, fixed, handles }: Doc): Float64Array | undefined {
  if (handles.every(({ depth }) => depth === undefined)) return undefined;
  return spreadDepths(positions, 3, triangles, [
    { vertices: fixed },
    ...handles.map(({ vertices, depth = 0 }) => ({ vertices, depth })),
  ]);
}
