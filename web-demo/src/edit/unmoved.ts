// What does not move: vertices fixed at rest, and parts held where they were taken hold of.
import { makeHandle, type Doc, type HandleDoc } from "./document.ts";

export const freshId = (doc: Doc): number => 1 + Math.max(0, ...doc.handles.map((h) => h.id));

/** Ascending. */
export function unmovedIn({ fixed, handles }: Doc): Uint32Array {
  const held = handles.filter((h) => h.held).flatMap((h) => [...h.vertices]);
  return held.length === 0 ? fixed : Uint32Array.from([...fixed, ...held]).sort();
}

/** The handles, without some vertices of those that hold a part in place. */
export function withoutHeld(handles: readonly HandleDoc[], vertices: ReadonlySet<number>): HandleDoc[] {
  return handles.flatMap((h) => {
    if (!h.held || !h.vertices.some((v) => vertices.has(v))) return [h];
    const kept = [...h.vertices.keys()].filter((i) => !vertices.has(h.vertices[i]!));
    if (kept.length === 0) return [];
    const held = Float32Array.from(kept.flatMap((i) => [...h.held!.subarray(3 * i, 3 * i + 3)]));
    return [{ ...h, vertices: Uint32Array.from(kept, (i) => h.vertices[i]!), held }];
  });
}

/**
 * The constraints when these vertices are not to move: what is new and farther from rest than `tolerance` is held where
 * it is.
 */
export function heldUnmoved(
  doc: Doc, vertices: Iterable<number>, positions: Float32Array, tolerance: number,
): Pick<Doc, "fixed" | "handles"> {
  const wanted = new Set(vertices);
  for (const h of doc.handles) if (!h.held) for (const v of h.vertices) wanted.delete(v);
  const before = new Set(unmovedIn(doc));
  const gone = new Set([...before].filter((v) => !wanted.has(v)));
  const added = [...wanted].filter((v) => !before.has(v)).sort((a, b) => a - b);
  const rest = doc.shape.positions;
  const away = (v: number) => Math.hypot(...[0, 1, 2].map((k) => positions[3 * v + k]! - rest[3 * v + k]!)) > tolerance;
  const held = added.filter(away);
  const moved = new Set(held);
  const fixed = Uint32Array.from([...doc.fixed, ...added].filter((v) => !gone.has(v) && !moved.has(v))).sort();
  const handles = withoutHeld(doc.handles, gone);
  if (held.length > 0) {
    const id = freshId(doc);
    const at = Float32Array.from(held.flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)]));
    handles.push({ ...makeHandle(doc.shape, id, `held-${id}`, Uint32Array.from(held)), held: at });
  }
  return { fixed, handles };
}
