// An outline with fewer points: no farther from the traced one than allowed, evenly sampled, and still crossing
// nothing.

import { orient2d } from "robust-predicates";
import type { Loop } from "./outline.js";

/**
 * Distances that are tried, each half the one before, until nothing crosses; then the traced points themselves, which
 * do not.
 */
const attempts = 4;

/** Loops with points at most `spacing` apart and at most `tolerance` from what was traced. */
export function simplified(traced: readonly Loop[], tolerance: number, spacing: number): Loop[] {
  const loops = traced.map((loop) => sampled(thinned(loop, tolerance), spacing));
  const tried = loops.map(() => 1);
  const tighten = (i: number) => {
    loops[i] = sampled(tried[i] < attempts ? thinned(traced[i], tolerance / 2 ** tried[i]) : traced[i], spacing);
    return tried[i]++ <= attempts;
  };
  while ([...crossingLoops(loops, spacing)].map(tighten).some(Boolean));
  return loops;
}

/** Douglas and Peucker's points, from the two that are far apart. */
function thinned(loop: Loop, tolerance: number): Loop {
  const count = loop.length / 2;
  const start = farthest(loop, loop[0], loop[1]);
  const middle = farthest(loop, loop[2 * start], loop[2 * start + 1]);
  const keep = new Uint8Array(count);
  keep[start] = keep[middle] = 1;
  const open: [from: number, to: number][] = [
    [start, middle],
    [middle, start],
  ];
  for (let span = open.pop(); span; span = open.pop()) {
    const [from, to] = span;
    const [most, at] = farthestFromChord(loop, from, to);
    if (at < 0 || most <= tolerance) continue;
    keep[at] = 1;
    open.push([from, at], [at, to]);
  }
  const kept = [...keep.keys()].filter((i) => keep[i]);
  return kept.length < 3 ? loop : Float64Array.from(kept.flatMap((i) => [loop[2 * i], loop[2 * i + 1]]));
}

function farthest(loop: Loop, x: number, y: number): number {
  let [most, found] = [-1, 0];
  for (let i = 0; i < loop.length; i += 2) {
    const apart = (loop[i] - x) ** 2 + (loop[i + 1] - y) ** 2;
    if (apart > most) [most, found] = [apart, i / 2];
  }
  return found;
}

/**
 * Between two points along the loop: how far the farthest is from the straight line, and which it is; -1: there is
 * none.
 */
function farthestFromChord(loop: Loop, from: number, to: number): [distance: number, at: number] {
  const count = loop.length / 2;
  let [most, found] = [-1, -1];
  for (let i = (from + 1) % count; i !== to; i = (i + 1) % count) {
    const apart = distanceToSegment(
      loop[2 * i],
      loop[2 * i + 1],
      loop[2 * from],
      loop[2 * from + 1],
      loop[2 * to],
      loop[2 * to + 1],
    );
    if (apart > most) [most, found] = [apart, i];
  }
  return [most, found];
}

export function distanceToSegment(x: number, y: number, ax: number, ay: number, bx: number, by: number): number {
  const [dx, dy] = [bx - ax, by - ay];
  const share = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1);
  const t = Math.min(1, Math.max(0, share));
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

/**
 * In pixels: points are moved by as much at most, so that no three are in line, which triangulations do not take well.
 */
const unevenness = 1 / 256;

/** Long sides in equal parts. */
function sampled(loop: Loop, spacing: number): Loop {
  const points: number[] = [];
  for (let i = 0; i < loop.length; i += 2) {
    const after = (i + 2) % loop.length;
    const [dx, dy] = [loop[after] - loop[i], loop[after + 1] - loop[i + 1]];
    const parts = Math.max(1, Math.ceil(Math.hypot(dx, dy) / spacing));
    for (let part = 0; part < parts; ++part)
      points.push(loop[i] + (dx * part) / parts, loop[i + 1] + (dy * part) / parts);
  }
  return Float64Array.from(points, (x, i) => x + unevenness * noise(i, x));
}

/** From -1 to 1, the same for the same place. */
function noise(i: number, x: number): number {
  let hash = Math.imul(Math.round(x * 64) ^ Math.imul(i, 0x9e3779b1), 0x85ebca6b);
  hash = Math.imul(hash ^ (hash >>> 13), 0xc2b2ae35);
  return (hash ^ (hash >>> 16)) / 2 ** 31;
}

/** A side of a loop: where it begins and ends. */
type Side = [loop: number, at: number, ax: number, ay: number, bx: number, by: number];

/** Loops of which a side touches another side that is not its neighbour; sides are sought in squares of `size`. */
function crossingLoops(loops: readonly Loop[], size: number): Set<number> {
  const cells = new Map<string, Side[]>();
  const crossing = new Set<number>();
  loops.forEach((loop, l) => {
    for (let i = 0; i < loop.length; i += 2) {
      const after = (i + 2) % loop.length;
      const side: Side = [l, i, loop[i], loop[i + 1], loop[after], loop[after + 1]];
      for (const key of cellsOf(side, size)) {
        const others = cells.get(key);
        if (!others) cells.set(key, [side]);
        else {
          for (const other of others)
            if (!neighbours(side, other, loop.length) && touch(side, other)) crossing.add(l).add(other[0]);
          others.push(side);
        }
      }
    }
  });
  return crossing;
}

function* cellsOf([, , ax, ay, bx, by]: Side, size: number): Generator<string> {
  const cell = (x: number) => Math.floor(x / size);
  for (let x = cell(Math.min(ax, bx)); x <= cell(Math.max(ax, bx)); ++x) {
    for (let y = cell(Math.min(ay, by)); y <= cell(Math.max(ay, by)); ++y) yield `${x} ${y}`;
  }
}

function neighbours([loop, at]: Side, [otherLoop, otherAt]: Side, length: number): boolean {
  const apart = Math.abs(at - otherAt);
  return loop === otherLoop && (apart <= 2 || apart === length - 2);
}

function touch([, , ax, ay, bx, by]: Side, [, , cx, cy, dx, dy]: Side): boolean {
  const [c, d] = [orient2d(ax, ay, bx, by, cx, cy), orient2d(ax, ay, bx, by, dx, dy)];
  const [a, b] = [orient2d(cx, cy, dx, dy, ax, ay), orient2d(cx, cy, dx, dy, bx, by)];
  if (c === 0 && d === 0)
    return (
      Math.min(ax, bx) <= Math.max(cx, dx) &&
      Math.min(cx, dx) <= Math.max(ax, bx) &&
      Math.min(ay, by) <= Math.max(cy, dy) &&
      Math.min(cy, dy) <= Math.max(ay, by)
    );
  return c * d <= 0 && a * b <= 0;
}
