// One lift of a sheet and one of a torus, for the methods that move a surface.

import { half, script } from "./edit_script.js";
import { pliant } from "./package.js";
import { sheet, torus } from "./shapes.js";

export const left = half([-1, 0, 0], -0.1);
export const right = half([1, 0, 0], 0.93);
export const lift = {
  name: "hand", select: right, move: { translate: [-0.1, 0, 0.3], rotate: { axis: [0, 1, 0], degrees: -30 } },
};
const exactly = { iterations: 1000, tolerance: 1e-12 };

/** 21 x 21 vertices. */
export const mesh = sheet(21);
export const shape = pliant.shape(mesh);
export const sheetEdit = { fixed: [left], handles: [lift] };
export const ring = torus(30, 12);
export const ringEdit = {
  fixed: [half([-1, 0, 0], 1)],
  handles: [
    { select: half([1, 0, 0], 1.2), move: { translate: [0, 0.2, 0.4], rotate: { axis: [0, 1, 0], degrees: 50 } } },
  ],
};

/** Runs one step; the state as a reader of `--state` has it. */
export async function edit<T>(of: typeof mesh, step: object) {
  const { positions, report, state } = await pliant.edit(
    pliant.shape(of), script([{ solve: exactly, ...step }]) as never,
  );
  return { positions, report: report.steps[0], quality: report.quality, state: JSON.parse(JSON.stringify(state)) as T };
}

export const heldVertices = (of: typeof mesh, { fixed, handles }: { fixed: object[]; handles: { select: object }[] }) =>
  new Set(
    [...fixed, ...handles.map(({ select }) => select)].flatMap((selection) =>
      Array.from(pliant.shape(of).select(selection as never)),
    ),
  );
