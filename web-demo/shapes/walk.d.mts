export function walk(
  count: number,
  first: () => [number, number, number],
  across: (x: number, y: number, opposite: number, after: number, before: number) => number,
  visit: (a: number, b: number, c: number) => void,
): void;
export const symbols: { fresh: number; after: number; before: number; known: number };
