// Saved deformations repeat the graph, the weights, the influences: what has not changed is kept once.

const isTable = (x: unknown): x is ArrayLike<unknown> =>
  Array.isArray(x) || (ArrayBuffer.isView(x) && !(x instanceof DataView));

/** `next`, with every part that equals the same part of `previous` replaced by that part. */
export function shared<T>(previous: unknown, next: T): T {
  if (Object.is(previous, next)) return next;
  if (typeof previous !== "object" || typeof next !== "object" || !previous || !next) return next;
  if (isTable(previous) && isTable(next)) return sharedTable(previous, next);
  const [before, after] = [previous as Record<string, unknown>, next as Record<string, unknown>];
  const keys = Object.keys(after);
  let same = keys.length === Object.keys(before).length;
  for (const key of keys) {
    after[key] = shared(before[key], after[key]);
    same &&= Object.is(after[key], before[key]);
  }
  return same ? (previous as T) : next;
}

function sharedTable<T>(previous: ArrayLike<unknown>, next: ArrayLike<unknown>): T {
  let same = previous.length === next.length;
  for (let i = 0; i < next.length; i++) {
    if (typeof next[i] === "object") (next as unknown[])[i] = shared(previous[i], next[i]);
    same &&= Object.is(next[i], previous[i]);
  }
  return (same ? previous : next) as T;
}
