// Reads an edit script: every key and value is checked, and an error names its place in the script.

import { choice, fields, type Fields, filled, finite, integer, list, Place, points } from "../boundary/check.js";
import { type Method, type Options, readLive, readMethod, readSeed } from "../methods/index.js";
import { type Extent, readSelection } from "../shape/selection.js";
import { readTransform, type Transform } from "../shape/transform.js";
import { readFollow } from "./follow.js";
import { sameExceptGoals } from "./keyframes.js";
import type {
  DragPlan, Goal, HandlePlan, Keyframe, PlacePlan, RegionPlan, ScriptPlan, SolverPlan, StepPlan,
} from "./plan.js";
import { defaultMaxAdded } from "../deform/sketch.js";
import { readSketchStep } from "./sketch_read.js";
import { maxCount, readDeformer, readSolve } from "./solve.js";

const format = "pliant-edit";

/** What the steps of a document ask for; `seed`: where they have none of their own. */
export interface Plans {
  plans: readonly StepPlan[];
  seed: number | undefined;
}

/** Errors: invalid-script. */
export function readScript(value: unknown, extent: Extent): ScriptPlan {
  const { script, context } = open(value, extent);
  const place = new Place("invalid-script", "");
  if (script.keyframes === undefined) {
    if (script.frames !== undefined) place.at("frames").reject("is given without keyframes; expected both or neither");
    return { keyframes: [{ time: 0, steps: readSteps(place.at("steps"), script.steps, context) }], frames: undefined };
  }
  if (script.steps !== undefined) place.at("keyframes").reject("is given beside steps; expected one or the other");
  return {
    keyframes: readKeyframes(place.at("keyframes"), script.keyframes, context),
    frames: integer(place.at("frames"), script.frames, 1, maxCount),
  };
}

/**
 * The steps of a document of a living edit. `before`: the document before it; steps that are the same objects keep
 * their plans. Errors: invalid-script.
 */
export function readDocument(value: unknown, extent: Extent, before: Plans): Plans {
  const { script, context } = open(value, extent);
  const place = new Place("invalid-script", "");
  for (const key of ["keyframes", "frames"]) {
    if (script[key] !== undefined) {
      place.at(key).reject("is given to a living edit; expected steps, a document for each frame");
    }
  }
  const known = context.seed === before.seed ? before.plans : [];
  return { plans: readSteps(place.at("steps"), script.steps, context, known), seed: context.seed };
}

function open(value: unknown, extent: Extent): { script: Fields; context: Context } {
  const place = new Place("invalid-script", "");
  const known = ["format", "version", "steps", "keyframes", "frames", "seed"];
  const script = fields(new Place("invalid-script", "script"), value, known);
  choice(place.at("format"), script.format, [format]);
  if (script.version !== 1) place.at("version").fail(script.version, "1");
  const seed = script.seed === undefined ? undefined : readSeed(place.at("seed"), script.seed);
  return { script, context: { extent, seed } };
}

/** What a step is checked against. */
interface Context {
  extent: Extent;
  seed: number | undefined;
}

function readKeyframes(place: Place, value: unknown, context: Context): Keyframe[] {
  const items = filled(place, value, "keyframes");
  return Array.from(items, (item, i) => {
    const here = place.item(i);
    const keyframe = fields(here, item, ["time", "steps"]);
    const time = finite(here.at("time"), keyframe.time);
    const steps = readSteps(here.at("steps"), keyframe.steps, context);
    if (i > 0) {
      const first = items[0] as Fields;
      const before = (items[i - 1] as Fields).time as number;
      if (!(time > before)) here.at("time").fail(time, `a time after ${before}, that of the keyframe before`);
      sameExceptGoals(here.at("steps"), first.steps, keyframe.steps);
    }
    return { time, steps };
  });
}

function readSteps(
  place: Place, value: unknown, { extent, seed }: Context, before: readonly StepPlan[] = [],
): StepPlan[] {
  let { count } = extent; // grows with what steps may add; whether it is there is seen at the selection
  return Array.from(filled(place, value, "steps"), (step, i) => {
    const old = before[i];
    const plan =
      old && old.source === step ? old : readStep(place.item(i), step, { extent: { ...extent, count }, seed }, old);
    if (plan.kind === "sketch" && plan.refine) {
      count = Math.min(maxCount, count + (plan.refine.maxAdded ?? defaultMaxAdded));
    }
    return plan;
  });
}

function readStep(place: Place, value: unknown, { extent, seed }: Context, old: StepPlan | undefined): StepPlan {
  if (typeof value !== "object" || value === null) place.fail(value, "a step");
  const { method } = value as Fields;
  if (method === "sketch") return readSketchStep(place, value, extent, seed);
  if (method === "place") return readPlaceStep(place, value, extent);
  return readSolverStep(place, value, { extent, seed }, old?.kind === "solver" ? old : undefined);
}

function readSolverStep(
  place: Place, value: object, { extent, seed }: Context, old: SolverPlan | undefined,
): SolverPlan {
  const method = readMethod(place.at("method"), (value as Fields).method);
  const step = fields(place, value, ["method", "options", "fixed", "handles", "solve", "drag", "follow"]);
  const options = readDeformer(place.at("options"), step.options, method, extent, seed);
  const known = (old?.source ?? {}) as Fields;
  const sameHandles = known.handles !== undefined && known.handles === step.handles;
  const handles = old && sameHandles ? old.handles : readHandles(place.at("handles"), step.handles ?? [], extent);
  const entries = old && sameHandles && known.method === step.method ? old.drag : [];
  const drag = Array.from(list(place.at("drag"), step.drag ?? []), (item, i) =>
    entries[i]?.source === item ? entries[i] : readDrag(place.at("drag").item(i), item, method, handles, extent));
  const loaded = [options, ...drag.map((entry) => entry.options)].some((given) => method.load?.(given as Options));
  if (handles.length === 0 && !loaded) asksForNothing(place, step.handles, method);
  const sameFixed = known.fixed !== undefined && known.fixed === step.fixed;
  const fixed = old && sameFixed ? old.fixed : readFixed(place.at("fixed"), step.fixed ?? [], extent);
  const follow = readFollow(place.at("follow"), step.follow, extent);
  const solve = readSolve(place.at("solve"), step.solve);
  return { kind: "solver", place, source: value, options, fixed, handles, drag, follow, ...solve };
}

function readFixed(place: Place, value: unknown, extent: Extent): RegionPlan[] {
  return Array.from(list(place, value, "selections"), (item, i) =>
    ({ place: place.item(i), select: readSelection(place.item(i), item, extent) }));
}

/** Vertices are put somewhere; nothing is solved. */
function readPlaceStep(place: Place, value: object, extent: Extent): PlacePlan {
  const step = fields(place, value, ["method", "parts"]);
  const parts = Array.from(filled(place.at("parts"), step.parts, "parts"), (item, i) => {
    const here = place.at("parts").item(i);
    const part = fields(here, item, ["name", "select", "move", "targets"]);
    const name = part.name === undefined ? undefined : readName(here.at("name"), part.name);
    const goal = readGoal(here, part, extent) ?? here.reject("has neither move nor targets; expected one of them");
    return { place: here, name, select: readSelection(here.at("select"), part.select, extent), goal };
  });
  return { kind: "place", place, source: value, parts };
}

function asksForNothing(step: Place, handles: unknown, { load }: Method): never {
  const expected = `at least one handle${load ? " or a load" : ""}`;
  return handles === undefined
    ? step.reject(`has no handles and asks for nothing; expected ${expected}`)
    : step.at("handles").reject(`is empty and asks for nothing; expected ${expected}`);
}

function readHandles(place: Place, value: unknown, extent: Extent): HandlePlan[] {
  const names = new Set<string>();
  return Array.from(list(place, value, "handles"), (item, i) => {
    const here = place.item(i);
    const handle = fields(here, item, ["name", "select", "move", "targets", "depth"]);
    const name = handle.name === undefined ? undefined : readName(here.at("name"), handle.name);
    if (name !== undefined && names.has(name)) {
      here.at("name").reject(`is "${name}", the name of an earlier handle; expected another`);
    }
    if (name !== undefined) names.add(name);
    const depth = readDepth(here.at("depth"), handle.depth, extent);
    return {
      place: here,
      name,
      select: readSelection(here.at("select"), handle.select, extent),
      goal: readGoal(here, handle, extent),
      ...depth,
    };
  });
}

function readDepth(place: Place, value: unknown, { dimension }: Extent): { depth?: number } {
  if (value === undefined) return {};
  if (dimension === 2) return { depth: finite(place, value) };
  return place.reject("is given for a shape in space; expected it in the plane only");
}

function readName(place: Place, value: unknown): string {
  return typeof value === "string" && value !== "" ? value : place.fail(value, "a name");
}

function readGoal(place: Place, { move, targets }: Fields, { dimension }: Extent): Goal | undefined {
  if (move !== undefined && targets !== undefined) place.reject("has move and targets; expected one or the other");
  if (targets !== undefined) {
    return { targets: points(place.at("targets"), targets, dimension), place: place.at("targets") };
  }
  if (move === undefined) return undefined;
  readTransform(place.at("move"), move, dimension);
  return { move: move as Transform };
}

function readDrag(place: Place, value: unknown, method: Method, handles: HandlePlan[], extent: Extent): DragPlan {
  const drag = fields(place, value, ["handles", "options", "iterations"]);
  const options = (drag.options ?? {}) as DragPlan["options"];
  readLive(place.at("options"), options, method, extent);
  const seen = new Set<number>();
  const goals = Array.from(list(place.at("handles"), drag.handles ?? []), (item, i) => {
    const here = place.at("handles").item(i);
    const entry = fields(here, item, ["name", "move", "targets"]);
    const name = readName(here.at("name"), entry.name);
    const handle = handles.findIndex((plan) => plan.name === name);
    if (handle < 0) here.at("name").fail(name, "the name of a handle of the step");
    if (seen.has(handle)) {
      here.at("name").reject(`is "${name}", which this entry moves already; expected each handle once`);
    }
    seen.add(handle);
    return {
      handle, goal: readGoal(here, entry, extent) ?? here.reject("has neither move nor targets; expected one of them"),
    };
  });
  const { iterations = 1 } = drag;
  return { source: value, goals, options, iterations: integer(place.at("iterations"), iterations, 1, maxCount) };
}
