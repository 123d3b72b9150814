// One edit for every method there is and for sketches, as steps of a script: each with another goal of the same kind.

import { half } from "./edit_script.js";
import { arc, camera, limb, longArc, straight } from "./limb.js";
import { pliant } from "./package.js";
import { type Mesh, sheet } from "./shapes.js";

export interface EditCase {
  mesh: Mesh;
  step: object;
  /** The same step with another target and nothing else. */
  moved: object;
  /** And with other constraints, or another limb. */
  held: object;
}

const left = half([-1, 0, 0], -0.1);
const solve = { iterations: 400, tolerance: 1e-9 };
const hand = (z: number, degrees: number) => ({
  name: "hand", select: half([1, 0, 0], 0.9), move: { translate: [-0.05, 0, z], rotate: { axis: [0, 1, 0], degrees } },
});
/** Options of methods that are to be tried with others than the default. */
const tried: Record<string, object> = {
  "embedded-graph": { nodeCount: 30 },
  "edge-material": { stretch: 3, bend: 0.5 },
  arap: { smoothness: 0.05 },
};
const lift = (method: string): EditCase => {
  const options = tried[method] ?? {};
  const step = { method, options, fixed: [left], handles: [hand(0.25, -20)], solve };
  return {
    mesh: sheet(13),
    step,
    moved: { ...step, handles: [hand(0.3, -35)] },
    held: { ...step, fixed: [half([-1, 0, 0], -0.2)] },
  };
};

const drawn = { method: "sketch", camera, reference: straight };
const short = { ...drawn, reference: straight.slice(0, 50) };
const finish = { method: "arap", spacing: 0.1, solve };

export const methodNames = pliant.methods.map(({ name }) => name);

export const editCases: Record<string, EditCase> = {
  ...Object.fromEntries(methodNames.map((name) => [name, lift(name)])),
  sketch: {
    mesh: limb(12, 31),
    step: { ...drawn, bend: { target: arc } },
    moved: { ...drawn, bend: { target: longArc }, twist: { degrees: 40 } },
    held: { ...short, bend: { target: arc } },
  },
  "sketch, finished": {
    mesh: limb(12, 31),
    step: { ...drawn, bend: { target: arc }, finish },
    moved: { ...drawn, bend: { target: arc }, twist: { degrees: 30 }, finish },
    held: { ...short, bend: { target: arc }, finish },
  },
  place: (() => {
    const part = (degrees: number) => ({
      method: "place",
      parts: [
        {
          select: half([1, 0, 0], 0.9),
          move: { scale: 1.5, rotate: { axis: [0, 1, 1], degrees }, translate: [0, 0, 0.2] },
        },
      ],
    });
    return {
      mesh: sheet(13),
      step: part(30),
      moved: part(50),
      held: { ...part(30), parts: [{ ...part(30).parts[0], select: half([1, 0, 0], 0.8) }] },
    };
  })(),
};
