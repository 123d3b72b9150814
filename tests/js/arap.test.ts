// arap against its paper: weights, energy, and what it promises of handles.

import { describe, expect, it } from "vitest";
import { half, script } from "./support/edit_script.js";
import { pliant } from "./support/package.js";
import { picture } from "./support/shapes.js";
import { edit, heldVertices, left, mesh, right, ring, ringEdit, sheetEdit } from "./support/surface_edits.js";
import { type ArapState, cotangentWeights, evaluateArap } from "./support/surface_oracle.js";

const largest = (rows: number[][], except: Set<number>) =>
  Math.max(...rows.flatMap((row, v) => (except.has(v) ? [0] : row.map(Math.abs))));

describe.each([
  { name: "a sheet, spokes", of: mesh, energy: "spokes", held: sheetEdit },
  { name: "a sheet, spokes and rims", of: mesh, energy: "spokes-and-rims", held: sheetEdit },
  { name: "a torus, spokes", of: ring, energy: "spokes", held: ringEdit },
  { name: "a torus, spokes and rims", of: ring, energy: "spokes-and-rims", held: ringEdit },
])("arap: $name", ({ of, energy, held }) => {
  const edited = edit<ArapState>(of, { method: "arap", options: { energy }, ...held });
  const rims = energy === "spokes-and-rims";

  it("has the cotangent weights", async () => {
    const { state } = await edited;
    const expected = cotangentWeights(of);
    expect(state.edges).toHaveLength(expected.size);
    for (const { i, j, weight } of state.edges) {
      const cotangents = expected.get(`${Math.min(i, j)} ${Math.max(i, j)}`)!;
      expect(Math.abs(weight - (rims ? cotangents : Math.max(0, cotangents)))).toBeLessThan(1e-9);
    }
  });

  it("reports the energy of its state, and rests where no rotation and no free vertex lowers it", async () => {
    const { state, report, positions } = await edited;
    const { energy: expected, gradient, turning } = evaluateArap(state, of, rims);
    expect(expected).toBeGreaterThan(0);
    expect(report.energy.total / expected).toBeCloseTo(1, 6);
    expect(report.energy.rigidity / expected).toBeCloseTo(1, 6);
    expect(report.converged).toBe(true);
    expect(turning).toBeLessThan(1e-9);
    expect(largest(gradient, heldVertices(of, held))).toBeLessThan(1e-5);
    expect(state.result.flat()).toEqual(Array.from(positions));
  });

  it("meets its targets exactly", async () => {
    const { state, quality } = await edited;
    expect(quality.constraintError).toBe(0);
    for (const { vertices, targets } of state.handles) expect(vertices.map((v) => state.result[v])).toEqual(targets);
  });
});

describe("arap", () => {
  it("leaves a gap with soft handles, whose energy is reported", async () => {
    const step = { method: "arap", options: { constraintWeight: 0.5 }, ...sheetEdit };
    const { state, report, quality } = await edit<ArapState>(mesh, step);
    const [{ vertices, targets }] = state.handles;
    const apart = vertices.reduce(
      (sum, v, i) => sum + targets[i].reduce((s, x, a) => s + (x - state.result[v][a]) ** 2, 0), 0,
    );
    expect(quality.constraintError).toBeGreaterThan(1e-3);
    expect(report.energy.constraint / apart).toBeCloseTo(1, 6);
    expect(report.energy.total / (evaluateArap(state, mesh, false).energy + 0.5 * apart)).toBeCloseTo(1, 6);
  });

  it("grows no spike under a single vertex where it is smooth", async () => {
    const middle = 10 * 21 + 10;
    const peak = async (smoothness: number) => {
      const handles = [{ select: { vertices: [middle] }, move: { translate: [0, 0, 0.3] } }];
      const { state, report } = await edit<ArapState>(mesh, {
        method: "arap", options: { smoothness }, fixed: [left, right], handles,
      });
      expect("smoothness" in report.energy).toBe(smoothness > 0);
      return state.result[middle][2] - state.result[middle + 1][2];
    };
    expect(await peak(0.1)).toBeLessThan(0.7 * (await peak(0)));
  });

  it("works in the plane", async () => {
    const plane = pliant.shape({ ...picture(11), dimension: 2 });
    const bend = {
      method: "arap",
      fixed: [half([-1, 0], -0.15)],
      handles: [{ select: half([1, 0], 0.9), move: { rotate: { degrees: 30 }, translate: [0, 0.2] } }],
    };
    const { positions, report } = await pliant.edit(plane, script([bend]) as never);
    expect(positions).toHaveLength(242);
    expect(positions[241]).toBeGreaterThan(1.1);
    expect(report.quality.constraintError).toBe(0);
  });
});
