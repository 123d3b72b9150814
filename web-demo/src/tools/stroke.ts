// Lines on the screen, in pixels.
import type { Pixel } from "../edit/sketch_doc.ts";

interface Place {
  readonly x: number;
  readonly y: number;
}

export const distance = (a: Place, b: Place): number => Math.hypot(b.x - a.x, b.y - a.y);

export const lengthOf = (line: readonly Place[]): number =>
  line.slice(1).reduce((sum, p, i) => sum + distance(line[i]!, p), 0);

const step = (a: Pixel, b: Pixel): number => Math.hypot(b[0] - a[0], b[1] - a[1]);

/** A line cut in two at a length along it; both parts hold the point there. */
function cutAt(line: readonly Pixel[], length: number): [Pixel[], Pixel[]] {
  let left = length;
  for (let i = 1; i < line.length; i++) {
    const [a, b] = [line[i - 1]!, line[i]!];
    const d = step(a, b);
    if (d > left) {
      const at: Pixel = [a[0] + (left / d) * (b[0] - a[0]), a[1] + (left / d) * (b[1] - a[1])];
      return [[...line.slice(0, i), at], [at, ...line.slice(i)]];
    }
    left -= d;
  }
  return [[...line], []];
}

/** A limb whose end is pulled somewhere: the more, the nearer to the end; where it is held it keeps its direction. */
export const pulled = (limb: readonly Pixel[], [dx, dy]: Pixel): Pixel[] =>
  limb.map(([x, y], i): Pixel => {
    const weight = (i / (limb.length - 1)) ** 2;
    return [x + weight * dx, y + weight * dy];
  });

/** The direction in which the last (or first) pixels of a line run. */
function heading(line: readonly Pixel[], atEnd: boolean): number {
  const way = atEnd ? line.toReversed() : line;
  const far = way.find((p) => step(way[0]!, p) >= 14) ?? way.at(-1)!;
  return Math.atan2(far[1] - way[0]![1], far[0] - way[0]![0]) + (atEnd ? Math.PI : 0);
}

/**
 * A target of the reference's length: cut where it is longer; where it is shorter, continued by
 * what is left of the reference, turned to go on from its end.
 */
export function fitted(target: readonly Pixel[], reference: readonly Pixel[]): Pixel[] {
  const length = (line: readonly Pixel[]) => line.slice(1).reduce((sum, p, i) => sum + step(line[i]!, p), 0);
  const [drawn, wanted] = [length(target), length(reference)];
  if (drawn >= wanted) return cutAt(target, wanted)[0];
  const rest = cutAt(reference, drawn)[1];
  if (rest.length < 2) return [...target];
  const turn = heading(target, true) - heading(rest, false);
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const end = target.at(-1)!;
  return [...target, ...rest.slice(1).map(([x, y]): Pixel => {
    const [dx, dy] = [x - rest[0]![0], y - rest[0]![1]];
    return [end[0] + cos * dx - sin * dy, end[1] + sin * dx + cos * dy];
  })];
}
