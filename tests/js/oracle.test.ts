// A saved state recomputed from the paper's equations by code of its own.

import { describe, expect, it } from "vitest";
import { half } from "./support/edit_script.js";
import { carried, determinant, edges, evaluate, type GraphState, savedWeights, weights } from "./support/oracle.js";
import { pliant } from "./support/package.js";
import { cloud, type Mesh, sheet, torus, where } from "./support/shapes.js";

interface Case {
  name: string;
  mesh: Mesh;
  options: object;
  fixed: object[];
  handles: object[];
}

const cases: Case[] = [
  {
    name: "a sheet with a fixed side, lifted",
    mesh: sheet(31),
    options: { nodeCount: 60 },
    fixed: [half([-1, 0, 0], -0.1)],
    handles: [{ select: half([1, 0, 0], 0.93), move: { translate: [0, 0, 0.3] } }],
  },
  {
    name: "a closed torus bent by the paper's solver",
    mesh: torus(40, 16),
    options: { nodeCount: 80, solver: "gauss-newton" },
    fixed: [half([-1, 0, 0], 1)],
    handles: [
      { select: half([1, 0, 0], 1.2), move: { translate: [0, 0.2, 0.5], rotate: { axis: [0, 1, 0], degrees: 50 } } },
    ],
  },
  {
    name: "points, six neighbours, other weights, two handles",
    mesh: { positions: cloud(400), triangles: new Uint32Array(0) },
    options: { nodeCount: 50, neighbours: 6, rotationWeight: 2, regularizationWeight: 5, constraintWeight: 300 },
    fixed: [],
    handles: [
      { select: half([-1, 0, 0], -0.2), move: {} },
      { select: half([1, 0, 0], 0.8), move: { rotate: { axis: [1, 0, 0], degrees: 70 } } },
    ],
  },
];

describe.each(cases)("$name", ({ mesh, options, fixed, handles }) => {
  const script = {
    format: "pliant-edit", version: 1,
    steps: [{ method: "embedded-graph", options, fixed, handles, solve: { iterations: 200, tolerance: 1e-10 } }],
  };
  const shape = pliant.shape(mesh);
  const vertices = mesh.positions.length / 3;
  const vertex = (v: number) => Array.from(mesh.positions.subarray(3 * v, 3 * v + 3));
  const weighted = { rotation: 1, regularization: 10, constraint: 100 };
  for (const name of ["rotation", "regularization", "constraint"] as const) {
    weighted[name] = (options as Record<string, number>)[`${name}Weight`] ?? weighted[name];
  }
  const edit = pliant.edit(shape, script as never);
  const solved = async () => {
    const { positions, report, state } = await edit;
    return {
      positions, step: report.steps[0], quality: report.quality, state: JSON.parse(JSON.stringify(state)) as GraphState,
    };
  };

  it("has the weights of eq. 4", async () => {
    const { state } = await solved();
    let worst = 0;
    for (let v = 0; v < vertices; ++v) {
      const [ours, theirs] = [weights(state, vertex(v)), savedWeights(state, v)];
      for (const j of new Set([...ours.keys(), ...theirs.keys()])) {
        worst = Math.max(worst, Math.abs((ours.get(j) ?? 0) - (theirs.get(j) ?? 0)));
      }
    }
    expect(worst).toBeLessThan(1e-9);
  });

  it("has an edge between nodes that influence a common vertex, and no other", async () => {
    const { state } = await solved();
    expect(new Set(state.edges.map(([j, k]) => `${Math.min(j, k)} ${Math.max(j, k)}`))).toEqual(
      edges(state, mesh.positions),
    );
  });

  it("has its energies taken with a mean edge of one", async () => {
    const { state } = await solved();
    const lengths = state.edges.map(([j, k]) => Math.hypot(...state.nodes[j].map((x, i) => x - state.nodes[k][i])));
    const mean = lengths.reduce((sum, length) => sum + length, 0) / lengths.length;
    expect(state.lengthUnit / mean).toBeCloseTo(1, 9);
  });

  it("puts the vertices where eq. 2 does", async () => {
    const { state, positions } = await solved();
    let worst = 0;
    for (let v = 0; v < vertices; ++v) {
      const expected = carried(state, vertex(v), weights(state, vertex(v)));
      worst = Math.max(worst, Math.hypot(...expected.map((x, axis) => x - positions[3 * v + axis])));
    }
    expect(worst / shape.diagonal).toBeLessThan(1e-6);
    expect(worst).toBeGreaterThan(0); // not compared with itself
  });

  it("reports the energies of eq. 5 to 8", async () => {
    const { state, step } = await solved();
    const { terms } = evaluate(state, mesh.positions, weighted);
    for (const name of ["rotation", "regularization", "constraint"] as const) {
      expect(step.energy[name] / terms[name], name).toBeCloseTo(1, 6);
    }
    const total =
      weighted.rotation * terms.rotation +
      weighted.regularization * terms.regularization +
      weighted.constraint * terms.constraint;
    expect(step.energy.total / total).toBeCloseTo(1, 6);
    expect(step.iterations.at(-1)!.energy).toBe(step.energy.total);
  });

  it("stops where the gradient of eq. 9 vanishes for every free node", async () => {
    const { state, step } = await solved();
    expect(step.converged).toBe(true);
    const { gradient } = evaluate(state, mesh.positions, weighted);
    const free = gradient.filter((_, j) => !state.frozen.includes(j));
    const largest = Math.max(...free.flatMap((node) => [...node.rotation, ...node.translation]).map(Math.abs));
    // The second test of eq. 12.
    expect(largest).toBeLessThan(Math.cbrt(1e-10) * (1 + step.energy.total));
    expect(step.unknowns).toBe(12 * free.length);
  });

  it("leaves the nodes of fixed vertices alone, and turns no node inside out", async () => {
    const { state } = await solved();
    const reached = new Set<number>();
    for (const v of fixedVertices(fixed, mesh)) for (const j of savedWeights(state, v).keys()) reached.add(j);
    expect(new Set(state.frozen)).toEqual(reached);
    for (const j of state.frozen) {
      expect(state.rotations[j]).toEqual([1, 0, 0, 0, 1, 0, 0, 0, 1]);
      expect(state.translations[j]).toEqual([0, 0, 0]);
    }
    expect(Math.min(...state.rotations.map(determinant))).toBeGreaterThan(0);
  });

  it("reports how far the handles are from their targets", async () => {
    const { state, positions, quality } = await solved();
    const apart = state.handles.flatMap(({ vertices: ids, targets }) =>
      ids.map((v, i) => Math.hypot(...targets[i].map((x, axis) => x - positions[3 * v + axis]))));
    expect(quality.constraintError).toBeCloseTo(Math.max(...apart) / shape.diagonal, 12);
  });
});

function fixedVertices(fixed: object[], mesh: Mesh): number[] {
  return fixed.flatMap((selection) => {
    const { normal, offset } = (selection as ReturnType<typeof half>).halfSpace;
    return where(mesh.positions, (x, y, z) => normal[0] * x + normal[1] * y + normal[2] * z >= offset);
  });
}
