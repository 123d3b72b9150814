// Keyframes: the same steps at several times. What lies between is an ordinary edit whose moves are
// interpolated by their numbers: degrees turn, positions shift, sizes scale.

import { list, type Place } from "../boundary/check.js";
import type { Transform } from "../shape/transform.js";
import type { Goal, Keyframe, ScriptPlan, StepPlan } from "./plan.js";
import { poseKeys } from "./sketch_read.js";

type Json = Record<string, unknown>;

/** Refuses a keyframe whose steps differ from the first one's in more than numbers of moves and targets. */
export function sameExceptGoals(place: Place, first: unknown, steps: unknown): void {
  const [a, b] = [list(place, first), list(place, steps)];
  if (a.length !== b.length) place.reject(`has ${b.length} steps; expected ${a.length} as in the first keyframe`);
  for (let i = 0; i < a.length; ++i) sameStep(place.item(i), a[i] as Json, b[i] as Json);
}

function sameStep(place: Place, a: Json, b: Json): void {
  if (b.method === "sketch") return sameSketch(place, a, b);
  same(place.at("method"), a.method, b.method);
  if (b.method === "place") return sameHandles(place.at("parts"), "parts", a.parts as Json[], b.parts as Json[]);
  if (b.drag !== undefined) place.at("drag").reject("is given in a keyframe; expected a drag only in steps");
  for (const key of ["options", "fixed", "solve", "follow"]) same(place.at(key), a[key], b[key]);
  sameHandles(place.at("handles"), "handles", (a.handles ?? []) as Json[], (b.handles ?? []) as Json[]);
}

function sameHandles(place: Place, what: string, mine: Json[], theirs: Json[]): void {
  if (mine.length !== theirs.length) {
    place.reject(`has ${theirs.length} ${what}; expected ${mine.length} as in the first keyframe`);
  }
  theirs.forEach((handle, i) => {
    const here = place.item(i);
    for (const key of ["name", "select"]) same(here.at(key), mine[i][key], handle[key]);
    sameKind(here, mine[i], handle);
  });
}

/** Poses over one region and one reference curve. */
function sameSketch(place: Place, a: Json, b: Json): void {
  if (b.refine !== undefined && b.refine !== false) {
    place.at("refine").reject("is given in a keyframe; expected a refinement only in steps");
  }
  for (const key of new Set([...Object.keys(a), ...Object.keys(b)])) {
    if (!(poseKeys as readonly string[]).includes(key)) same(place.at(key), a[key], b[key]);
  }
}

function sameKind(place: Place, a: Json, b: Json): void {
  const [mine, theirs] = [a.move ?? {}, b.move ?? {}] as Transform[];
  const kind = (handle: Json, move: Transform) => (handle.targets ? "targets" : move.matrix ? "a matrix" : "a move");
  const [expected, found] = [kind(a, mine), kind(b, theirs)];
  if (expected !== found) place.reject(`has ${found}; expected ${expected} as in the first keyframe`);
  if (!mine.rotate || !theirs.rotate) return;
  const turn = place.at("move").at("rotate");
  for (const key of ["axis", "about"] as const) same(turn.at(key), mine.rotate[key], theirs.rotate[key]);
}

function same(place: Place, a: unknown, b: unknown): void {
  if (JSON.stringify(a) !== JSON.stringify(b)) place.reject("differs from the first keyframe; expected the same");
}

/** The edits to make, one a frame, evenly from the first time to the last. */
export function* framesOf({ keyframes, frames = 1 }: ScriptPlan): Generator<Keyframe> {
  const first = keyframes[0].time;
  const last = keyframes[keyframes.length - 1].time;
  for (let frame = 0; frame < frames; ++frame) {
    const time = frames === 1 ? first : first + ((last - first) * frame) / (frames - 1);
    yield { time, steps: stepsAt(keyframes, time) };
  }
}

function stepsAt(keyframes: Keyframe[], time: number): StepPlan[] {
  const next = keyframes.findIndex((keyframe) => keyframe.time >= time);
  const b = keyframes[next < 0 ? keyframes.length - 1 : next];
  const a = keyframes[Math.max(0, next - 1)];
  if (next <= 0 || b.time === time) return b.steps;
  const u = (time - a.time) / (b.time - a.time);
  return a.steps.map((step, i) => stepBetween(step, b.steps[i], u));
}

/** Of two steps that differ in goals or poses only. */
function stepBetween(a: StepPlan, b: StepPlan, u: number): StepPlan {
  if (a.kind === "sketch" && b.kind === "sketch") return { ...a, toward: { pose: b.pose, t: u } };
  if (a.kind === "solver" && b.kind === "solver") {
    return {
      ...a, handles: a.handles.map((handle, h) => ({ ...handle, goal: between(handle.goal, b.handles[h].goal, u) })),
    };
  }
  if (a.kind === "place" && b.kind === "place") {
    return { ...a, parts: a.parts.map((part, p) => ({ ...part, goal: between(part.goal, b.parts[p].goal, u)! })) };
  }
  return b;
}

function between(a: Goal | undefined, b: Goal | undefined, u: number): Goal | undefined {
  if (a && b && "targets" in a && "targets" in b) return { ...b, targets: mix(a.targets, b.targets, u) };
  if ((a && "targets" in a) || (b && "targets" in b)) return b;
  return { move: mixMoves(a?.move ?? {}, b?.move ?? {}, u) };
}

function mixMoves(a: Transform, b: Transform, u: number): Transform {
  if (a.matrix && b.matrix) return { matrix: mix(a.matrix, b.matrix, u) };
  const move: Transform = { scale: lerp(a.scale ?? 1, b.scale ?? 1, u) };
  const rotate = a.rotate ?? b.rotate;
  if (rotate) move.rotate = { ...rotate, degrees: lerp(a.rotate?.degrees ?? 0, b.rotate?.degrees ?? 0, u) };
  const zeros = Array.from(a.translate ?? b.translate ?? [], () => 0);
  if (zeros.length > 0) move.translate = mix(a.translate ?? zeros, b.translate ?? zeros, u);
  return move;
}

function mix(a: ArrayLike<number>, b: ArrayLike<number>, u: number): number[] {
  return Array.from(a, (x, i) => lerp(x, b[i], u));
}

function lerp(a: number, b: number, u: number): number {
  return a + u * (b - a);
}
