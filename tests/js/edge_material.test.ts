// edge-material against its paper: lengths, energies, gravity, folds, and the field of its grain.

import { describe, expect, it } from "vitest";
import { errorOf, pliant } from "./support/package.js";
import { picture } from "./support/shapes.js";
import { edit, heldVertices, left, mesh, ring, ringEdit, shape, sheetEdit } from "./support/surface_edits.js";
import {
  cotangentWeights, type EdgeMaterialState, evaluateEdgeMaterial, meanEdge, restErrors,
} from "./support/surface_oracle.js";

describe.each([
  { name: "a sheet", of: mesh, options: {}, held: sheetEdit },
  {
    name: "a sheet that stretches easily along y, under gravity",
    of: mesh,
    options: { stretch: 3, bend: 0.5, pStretch: 0.7, pBend: 0.4, gravity: [0, 0, -2], field: { axis: [1, 0, 0] } },
    held: sheetEdit,
  },
  { name: "a torus with the paper's lambda", of: ring, options: { lambda: 1e-3 }, held: ringEdit },
])("edge-material: $name", ({ of, options, held }) => {
  const edited = edit<EdgeMaterialState>(of, { method: "edge-material", options, ...held });
  const given = options as { stretch?: number; lambda?: number; bend?: number };

  it("has the lengths of eq. 5, with sigma along the normal", async () => {
    const { state } = await edited;
    const { rho, sigma } = restErrors(state, of);
    expect(rho).toBeLessThan(1e-12);
    expect(sigma).toBeLessThan(1e-9);
    expect(state.edges).toHaveLength(cotangentWeights(of).size);
    const kappas = state.edges.map(({ kappa }) => kappa);
    expect(Math.max(...kappas)).toBeLessThanOrEqual(1);
    expect(Math.min(...kappas)).toBeGreaterThan(0);
    expect(new Set(kappas).size > 1).toBe("field" in options);
  });

  it("has lambda of the resolution, or the one that is given", async () => {
    const { state: { weights } } = await edited;
    expect(weights.lambda / (given.lambda ?? (given.stretch ?? 1) * meanEdge(of) ** 2)).toBeCloseTo(1, 9);
    expect(weights.mu).toBe(given.bend ?? 1);
  });

  it("reports the energies of eq. 6 to 9", async () => {
    const { state, report, positions } = await edited;
    const expected: Record<string, number> = evaluateEdgeMaterial(state, of);
    expect(Object.keys(report.energy).sort()).toEqual(Object.keys(expected).sort());
    for (const [name, value] of Object.entries(expected)) {
      expect(Math.abs(report.energy[name] - value), name).toBeLessThanOrEqual(1e-6 * Math.abs(value));
    }
    expect(report.energy.bend).toBeGreaterThan(0);
    expect(report.iterations.at(-1)!.energy).toBe(report.energy.total);
    expect(state.result.flat()).toEqual(Array.from(positions));
  });

  it("rests in a minimum", async () => {
    const { state, report } = await edited;
    expect(report.converged).toBe(true);
    // Central differences at a few free vertices.
    const fixed = heldVertices(of, held);
    const step = 1e-5;
    for (let v = 0; v < state.result.length; v += 37) {
      if (fixed.has(v)) continue;
      for (let axis = 0; axis < 3; ++axis) {
        const [plus, minus] = [step, -step].map((by) => {
          const result = state.result.map((p) => [...p]);
          result[v][axis] += by;
          return evaluateEdgeMaterial({ ...state, result }, of).total;
        });
        expect(Math.abs(plus - minus) / (2 * step)).toBeLessThan(
          1e-4 * Math.max(1e-3, report.energy.stretch + report.energy.bend),
        );
      }
    }
  });
});

describe("edge-material", () => {
  const centre = 10 * 21 + 10;
  const cloth = {
    method: "edge-material", options: { gravity: [0, 0, -1], bend: 0.01 }, fixed: [{ vertices: [centre] }],
  };

  it("falls under gravity alone, and does not without", async () => {
    const { state } = await edit<EdgeMaterialState>(mesh, cloth);
    expect(state.result[0][2]).toBeLessThan(mesh.positions[2] - 0.1);
    expect(state.result[centre]).toEqual(Array.from(mesh.positions.subarray(3 * centre, 3 * centre + 3)));
    for (const more of [{}, { handles: [] }]) {
      const error = await errorOf(() => edit(mesh, { ...cloth, options: { gravity: [0, 0, 0] }, ...more }));
      expect(error.code).toBe("invalid-script");
      for (const words of ["steps[0]", "asks for nothing", "a load"]) expect(error.message).toContain(words);
    }
    const dragged = await edit<EdgeMaterialState>(mesh, {
      ...cloth, options: { bend: 0.01 }, handles: [], drag: [{ options: { gravity: [0, 0, -1] }, iterations: 50 }],
    });
    expect(dragged.state.result[0][2]).toBeLessThan(mesh.positions[2] - 0.1);
  });

  it("lets only those parts fall that something holds", async () => {
    const positions = Float64Array.of(...mesh.positions, ...mesh.positions.map((x, i) => (i % 3 === 2 ? x + 3 : x)));
    const triangles = Uint32Array.of(...mesh.triangles, ...mesh.triangles.map((v) => v + 441));
    const two = { positions, triangles };
    const { state, report } = await edit<EdgeMaterialState>(two, cloth);
    expect(state.floating).toEqual(Array.from({ length: 441 }, (_, v) => v + 441));
    expect(
      Math.max(
        ...state.result
          .slice(441)
          .flat()
          .map((x, i) => Math.abs(x - positions[3 * 441 + i])),
      ),
    ).toBeLessThan(1e-9);
    expect(report.energy.gravity / evaluateEdgeMaterial(state, two).gravity).toBeCloseTo(1, 9);
  });

  it("remembers the normal of an edge that is folded flat, also in its state", async () => {
    const leaf = {
      positions: Float64Array.of(0, 0, 0, 0, 1, 0, 1, 0.5, 0, -1, 0.5, 0.6),
      triangles: Uint32Array.of(0, 2, 1, 0, 1, 3),
    };
    const book = pliant.shape(leaf);
    const held = () => {
      const deformer = pliant.deformer(book, { method: "edge-material" });
      return { deformer, page: deformer.addHandle([0, 1, 2]), flap: deformer.addHandle([3]) };
    };
    const { deformer, page, flap } = held();
    const rotate = { axis: [0, 0, 1], degrees: 90, about: [0, 0, 0] };
    for (const handle of [page, flap]) handle.move({ rotate });
    await deformer.solve();
    expect(deformer.state().folded).toEqual([]);
    flap.moveTo([-0.5, 1, 0.01]); // onto the other leaf
    await deformer.solve();
    const state = JSON.parse(JSON.stringify(deformer.state())) as EdgeMaterialState;
    const [{ edge, normal }] = state.folded;
    expect(state.edges[edge].l).toBeGreaterThanOrEqual(0);
    expect(Math.hypot(...normal)).toBeCloseTo(1, 12);
    const energy = deformer.energy();
    expect(energy.terms.bend / evaluateEdgeMaterial(state, leaf).bend).toBeCloseTo(1, 9);
    const other = held().deformer;
    other.restore(state as never);
    expect(other.energy()).toEqual(energy);
    expect(other.state()).toEqual(deformer.state());
    for (const wrong of [{ edge: 9, normal }, { edge }]) {
      expect((await errorOf(() => other.restore({ ...state, folded: [wrong] } as never))).message).toContain("folded");
    }
  });

  it.each([
    ["an axis", { axis: [1, 1, 0] }],
    ["curvature", { curvature: "max" }],
    ["paths from a vertex", { geodesic: [0] }],
    ["paths from a region", { geodesic: left }],
    ["strokes", { strokes: [[[0, 0, 0], [0.3, 0.2, 0], [1, 1, 0]], [[1, 0, 0], [1, 0.2, 0]]] }],
  ])("takes a field from %s", async (_, field) => {
    const deformer = pliant.deformer(shape, { method: "edge-material", field: field as never });
    const directions = deformer.field();
    expect(directions).toHaveLength(mesh.positions.length);
    const lengths = Array.from({ length: 441 }, (__, v) => Math.hypot(...directions.subarray(3 * v, 3 * v + 3)));
    for (const length of lengths) expect(Math.min(length, Math.abs(length - 1))).toBeLessThan(1e-5);
    expect(lengths.filter((length) => length > 0).length).toBeGreaterThan(300);
    const { edges } = deformer.state() as unknown as EdgeMaterialState;
    expect(new Set(edges.map(({ kappa }) => kappa)).size).toBeGreaterThan(1);
    deformer.setOptions({ field: null });
    expect(deformer.field().every((x) => x === 0)).toBe(true);
  });

  it("paints a field in the plane", () => {
    const flat = pliant.shape({ ...picture(11), dimension: 2 });
    const deformer = pliant.deformer(flat, {
      method: "edge-material", gravity: [0, -1], field: { strokes: [[[0, 0.5], [1, 0.5]]] },
    });
    expect(Math.abs(deformer.field()[0])).toBeCloseTo(1, 6);
    deformer.setOptions({ field: { axis: [0, 1] } });
    expect(Math.abs(deformer.field()[1])).toBeCloseTo(1, 6);
  });
});
