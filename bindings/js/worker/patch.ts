// Immutable values that change little from one to the next: what differs travels, what is the same object does not.

/** `kept`: the part of the value before; `head`: so many items of a list are kept, `tail` follows. */
export type Patch =
  { kept: true } | { value: unknown } | { head: number; tail: Patch[] } | { fields: Record<string, Patch> };

type Fields = Readonly<Record<string, unknown>>;

export function patchOf(before: unknown, next: unknown): Patch {
  if (typeof next !== "object" || next === null) return { value: next };
  if (next === before) return { kept: true };
  if (Array.isArray(next) && Array.isArray(before) && next.every(isPlain)) {
    const differs = next.findIndex((item, i) => item !== before[i]);
    const head = differs < 0 ? next.length : differs;
    return { head, tail: next.slice(head).map((item, i) => patchOf(before[head + i], item)) };
  }
  if (!isPlain(next) || !isPlain(before)) return { value: next };
  return { fields: Object.fromEntries(Object.entries(next).map(([key, value]) => [key, patchOf(before[key], value)])) };
}

export function patched(before: unknown, patch: Patch): unknown {
  if ("kept" in patch) return before;
  if ("value" in patch) return patch.value;
  if ("fields" in patch) {
    const parts = Object.entries(patch.fields).map(([key, part]) => [key, patched((before as Fields)[key], part)]);
    return Object.fromEntries(parts);
  }
  const { head, tail } = patch;
  const items = before as readonly unknown[];
  return [...items.slice(0, head), ...tail.map((part, i) => patched(items[head + i], part))];
}

function isPlain(value: unknown): value is Fields {
  return typeof value === "object" && value !== null && Object.getPrototypeOf(value) === Object.prototype;
}
