// arap and edge-material: the methods that move a surface, one constant matrix for many materials.

import { BoxGeometry } from "three";
import { describe, expect, it } from "vitest";
import { entries, errorOf, pliant } from "./support/package.js";
import { picture, sheet, torus, where } from "./support/shapes.js";
import {
  type ArapState, cotangentWeights, type EdgeMaterialState, evaluateArap, evaluateEdgeMaterial, meanEdge, restErrors,
} from "./support/surface_oracle.js";

const half = (normal: number[], offset: number) => ({ halfSpace: { normal, offset } });
const left = half([-1, 0, 0], -0.1);
const right = half([1, 0, 0], 0.93);
const lift = { name: "hand", select: right, move: { translate: [-0.1, 0, 0.3], rotate: { axis: [0, 1, 0], degrees: -30 } } };
const script = (step: object) => ({ format: "pliant-edit", version: 1, steps: [step] });
const exactly = { iterations: 1000, tolerance: 1e-12 };

const mesh = sheet(21);
const shape = pliant.shape(mesh);
const ring = torus(30, 12);
const ringEdit = {
  fixed: [half([-1, 0, 0], 1)],
  handles: [{ select: half([1, 0, 0], 1.2), move: { translate: [0, 0.2, 0.4], rotate: { axis: [0, 1, 0], degrees: 50 } } }],
};

/** Runs one step; the state as a reader of `--state` has it. */
async function edit<T>(of: typeof mesh, step: object) {
  const { positions, report, state } = await pliant.edit(pliant.shape(of), script({ solve: exactly, ...step }) as never);
  return { positions, report: report.steps[0], quality: report.quality, state: JSON.parse(JSON.stringify(state)) as T };
}

const largest = (rows: number[][], except: Set<number>) => Math.max(...rows.flatMap((row, v) => (except.has(v) ? [0] : row.map(Math.abs))));
const heldVertices = (of: typeof mesh, { fixed, handles }: { fixed: object[]; handles: { select: object }[] }) =>
  new Set([...fixed, ...handles.map(({ select }) => select)].flatMap((selection) => Array.from(pliant.shape(of).select(selection as never))));

describe.each([
  { name: "a sheet, spokes", of: mesh, energy: "spokes", held: { fixed: [left], handles: [lift] } },
  { name: "a sheet, spokes and rims", of: mesh, energy: "spokes-and-rims", held: { fixed: [left], handles: [lift] } },
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
    const step = { method: "arap", options: { constraintWeight: 0.5 }, fixed: [left], handles: [lift] };
    const { state, report, quality } = await edit<ArapState>(mesh, step);
    const [{ vertices, targets }] = state.handles;
    const apart = vertices.reduce((sum, v, i) => sum + targets[i].reduce((s, x, a) => s + (x - state.result[v][a]) ** 2, 0), 0);
    expect(quality.constraintError).toBeGreaterThan(1e-3);
    expect(report.energy.constraint / apart).toBeCloseTo(1, 6);
    expect(report.energy.total / (evaluateArap(state, mesh, false).energy + 0.5 * apart)).toBeCloseTo(1, 6);
  });

  it("grows no spike under a single vertex where it is smooth", async () => {
    const middle = 10 * 21 + 10;
    const peak = async (smoothness: number) => {
      const handles = [{ select: { vertices: [middle] }, move: { translate: [0, 0, 0.3] } }];
      const { state, report } = await edit<ArapState>(mesh, { method: "arap", options: { smoothness }, fixed: [left, right], handles });
      expect("smoothness" in report.energy).toBe(smoothness > 0);
      return state.result[middle][2] - state.result[middle + 1][2];
    };
    expect(await peak(0.1)).toBeLessThan(0.7 * (await peak(0)));
  });

  it("works in the plane", async () => {
    const plane = pliant.shape({ ...picture(11), dimension: 2 });
    const bend = { method: "arap", fixed: [half([-1, 0], -0.15)], handles: [{ select: half([1, 0], 0.9), move: { rotate: { degrees: 30 }, translate: [0, 0.2] } }] };
    const { positions, report } = await pliant.edit(plane, script(bend) as never);
    expect(positions).toHaveLength(242);
    expect(positions[241]).toBeGreaterThan(1.1);
    expect(report.quality.constraintError).toBe(0);
  });
});

describe.each([
  { name: "a sheet", of: mesh, options: {}, held: { fixed: [left], handles: [lift] } },
  { name: "a sheet that stretches easily along y, under gravity", of: mesh, options: { stretch: 3, bend: 0.5, pStretch: 0.7, pBend: 0.4, gravity: [0, 0, -2], field: { axis: [1, 0, 0] } }, held: { fixed: [left], handles: [lift] } },
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
        expect(Math.abs(plus - minus) / (2 * step)).toBeLessThan(1e-4 * Math.max(1e-3, report.energy.stretch + report.energy.bend));
      }
    }
  });
});

describe("edge-material", () => {
  const centre = 10 * 21 + 10;
  const cloth = { method: "edge-material", options: { gravity: [0, 0, -1], bend: 0.01 }, fixed: [{ vertices: [centre] }] };

  it("falls under gravity alone, and does not without", async () => {
    const { state } = await edit<EdgeMaterialState>(mesh, cloth);
    expect(state.result[0][2]).toBeLessThan(mesh.positions[2] - 0.1);
    expect(state.result[centre]).toEqual(Array.from(mesh.positions.subarray(3 * centre, 3 * centre + 3)));
    for (const more of [{}, { handles: [] }]) {
      const error = await errorOf(() => edit(mesh, { ...cloth, options: { gravity: [0, 0, 0] }, ...more }));
      expect(error.code).toBe("invalid-script");
      for (const words of ["steps[0]", "asks for nothing", "a load"]) expect(error.message).toContain(words);
    }
    const dragged = await edit<EdgeMaterialState>(mesh, { ...cloth, options: { bend: 0.01 }, handles: [], drag: [{ options: { gravity: [0, 0, -1] }, iterations: 50 }] });
    expect(dragged.state.result[0][2]).toBeLessThan(mesh.positions[2] - 0.1);
  });

  it("lets only those parts fall that something holds", async () => {
    const positions = Float64Array.of(...mesh.positions, ...mesh.positions.map((x, i) => (i % 3 === 2 ? x + 3 : x)));
    const triangles = Uint32Array.of(...mesh.triangles, ...mesh.triangles.map((v) => v + 441));
    const two = { positions, triangles };
    const { state, report } = await edit<EdgeMaterialState>(two, cloth);
    expect(state.floating).toEqual(Array.from({ length: 441 }, (_, v) => v + 441));
    expect(Math.max(...state.result.slice(441).flat().map((x, i) => Math.abs(x - positions[3 * 441 + i])))).toBeLessThan(1e-9);
    expect(report.energy.gravity / evaluateEdgeMaterial(state, two).gravity).toBeCloseTo(1, 9);
  });

  it("remembers the normal of an edge that is folded flat, also in its state", async () => {
    const leaf = { positions: Float64Array.of(0, 0, 0, 0, 1, 0, 1, 0.5, 0, -1, 0.5, 0.6), triangles: Uint32Array.of(0, 2, 1, 0, 1, 3) };
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
    ["an axis", { axis: [1, 1, 0] }], ["curvature", { curvature: "max" }], ["paths from a vertex", { geodesic: [0] }],
    ["paths from a region", { geodesic: left }], ["strokes", { strokes: [[[0, 0, 0], [0.3, 0.2, 0], [1, 1, 0]], [[1, 0, 0], [1, 0.2, 0]]] }],
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
    const deformer = pliant.deformer(flat, { method: "edge-material", gravity: [0, -1], field: { strokes: [[[0, 0.5], [1, 0.5]]] } });
    expect(Math.abs(deformer.field()[0])).toBeCloseTo(1, 6);
    deformer.setOptions({ field: { axis: [0, 1] } });
    expect(Math.abs(deformer.field()[1])).toBeCloseTo(1, 6);
  });
});

describe("options while a handle is held", () => {
  const step = { method: "edge-material", fixed: [left], handles: [lift] };
  const costs = async (base: object, drag: object[]) => {
    const { report } = await edit(mesh, { ...base, solve: { iterations: 20 }, drag });
    return report.drag!.map(({ factorizations, analyses }) => [factorizations, analyses]);
  };

  it("cost what the contract says: nothing for p, gravity and targets, one factorisation for stiffness", async () => {
    const hand = [{ name: "hand", move: { translate: [0, 0, 0.2] } }];
    expect(await costs(step, [
      { options: { pStretch: 0.5 } }, { options: { pBend: 0.2 } }, { options: { gravity: [0, 0, -1] } }, { handles: hand },
      { options: { stretch: 2 } }, { options: { lambda: 1e-4 } }, { options: { bend: 0.5 } }, { options: { field: { axis: [1, 0, 0] } } },
      { options: {} }, { options: { lambda: 1e-4, pStretch: 1 }, handles: hand },
    ])).toEqual([[0, 0], [0, 0], [0, 0], [0, 0], [1, 0], [1, 0], [1, 0], [1, 0], [0, 0], [0, 0]]);
    expect(await costs({ ...step, method: "arap" }, [
      { handles: hand }, { options: { energy: "spokes-and-rims" } }, { options: { constraintWeight: 2 } }, { options: { constraintWeight: 3 } },
      { options: { constraintWeight: null } }, { options: { smoothness: 0.1 } }, { options: { smoothness: 0.2 } },
    ])).toEqual([[0, 0], [1, 0], [1, 1], [1, 0], [1, 1], [1, 1], [1, 0]]);
  });

  it.each([
    ["edge-material", { stretch: 4, bend: 2, pStretch: 0.8, field: { axis: [1, 0, 0] } }, { stretch: 1 }, { lambda: 0.01, pStretch: 0.5, field: null, gravity: [0, 0, -1] }],
    ["arap", { energy: "spokes" }, { constraintWeight: 3 }, { energy: "spokes-and-rims", smoothness: 0.05 }],
  ])("of %s end where a new deformer rests", async (method, first, ...changes) => {
    const start = (options: object) => {
      const deformer = pliant.deformer(shape, { method, ...options } as never);
      deformer.setFixed(shape.select(left));
      deformer.addHandle(shape.select(right)).move(lift.move);
      return deformer;
    };
    const live = start(first);
    await live.solve({ maxIterations: 5 });
    for (const change of changes) live.setOptions(change as never);
    const { stretch: _, ...all } = Object.assign({}, first, ...changes); // lambda came last
    const fresh = start(all);
    const ends = await Promise.all([live, fresh].map((deformer) => deformer.solve({ maxIterations: 2000, tolerance: 1e-12 })));
    expect(ends[0].energy / ends[1].energy).toBeCloseTo(1, 6);
    expect(live.energy().weights).toEqual(fresh.energy().weights);
  });

  it("are refused where they do not exist, do not fit or cannot change, and nothing changes", async () => {
    const graph = pliant.deformer(shape, { method: "embedded-graph", nodeCount: 20 });
    const arap = pliant.deformer(shape, { method: "arap" });
    const material = pliant.deformer(shape, { method: "edge-material", lambda: 0 });
    const before = material.state();
    const rows: [() => void, ...string[]][] = [
      // @ts-expect-error: no option of embedded-graph is live
      [() => graph.setOptions({ nodeCount: 30 }), "options.nodeCount", "embedded-graph", "during a drag"],
      // @ts-expect-error: an option of the other method
      [() => arap.setOptions({ pStretch: 1 }), "options.pStretch", "arap", "energy, constraintWeight, smoothness"],
      // @ts-expect-error: the method stays
      [() => material.setOptions({ method: "arap" }), "options.method"],
      [() => material.setOptions(5 as never), "options", "5", "object"],
      [() => material.setOptions({ bend: 0 }), "bend and lambda of 0"],
      [() => material.setOptions({ pStretch: 1.5 }), "options.pStretch", "1.5", "from 0 to 1"],
      [() => material.setOptions({ stretch: 1, lambda: 1 }), "stretch and lambda"],
      [() => material.setOptions({ field: { geodesic: half([1, 0, 0], 9) } }), "options.field.geodesic", "no vertex"],
      [() => material.setOptions({ field: { strokes: [[[0, 0, 0], [0, 0, 0]]] } }), "field.strokes[0]", "no length"],
    ];
    for (const [action, ...says] of rows) {
      const { code, message } = await errorOf(action);
      expect(code).toBe("invalid-option");
      for (const words of says) expect(message).toContain(words);
    }
    expect(material.state()).toEqual(before);
    expect(material.energy().weights).toMatchObject({ stretch: 0, bend: 1 });
    graph.setOptions({});
  });

  it("are refused in a script at their place", async () => {
    const drag = (options: object) => errorOf(() => edit(mesh, { ...step, drag: [{}, { options }] }));
    expect(await drag({ gravity: [0, 1] })).toMatchObject({ code: "invalid-script", message: expect.stringContaining("steps[0].drag[1].options.gravity") });
    expect(await drag({ nodeCount: 3 })).toMatchObject({ code: "invalid-script", message: expect.stringContaining("steps[0].drag[1].options.nodeCount") });
    expect(await drag({ bend: 0, stretch: 0 })).toMatchObject({ code: "invalid-script", message: expect.stringContaining("steps[0].drag[1].options") });
  });
});

describe.each(["arap", "edge-material"] as const)("%s", (method) => {
  const grabbed = (library = pliant) => {
    const deformer = library.deformer(library.shape(mesh), { method });
    deformer.setFixed(where(mesh.positions, (x) => x <= 0.1));
    const hand = deformer.addHandle(where(mesh.positions, (x) => x >= 0.93));
    hand.move(lift.move);
    return { deformer, hand };
  };

  it("stays at rest until it is moved, and comes back", async () => {
    const { deformer, hand } = grabbed();
    hand.move({});
    expect((await deformer.solve()).energy).toBe(0);
    expect(deformer.positions()).toEqual(Float32Array.from(mesh.positions));
    hand.move(lift.move);
    await deformer.solve();
    expect(deformer.positions()).not.toEqual(Float32Array.from(mesh.positions));
    deformer.reset();
    expect(deformer.positions()).toEqual(Float32Array.from(mesh.positions));
  });

  it("is restored from its state, also one that went through a file", async () => {
    const { deformer } = grabbed();
    await deformer.solve({ maxIterations: 7 });
    const state = JSON.parse(JSON.stringify(deformer.state()));
    const other = grabbed();
    other.hand.move({});
    other.deformer.restore(state);
    expect(other.deformer.positions(new Float64Array(mesh.positions.length))).toEqual(deformer.positions(new Float64Array(mesh.positions.length)));
    expect(other.deformer.energy()).toEqual(deformer.energy());
    expect(other.deformer.state()).toEqual(deformer.state());
    const rows: [object, ...string[]][] = [
      [{ ...state, result: undefined }, "result"],
      [{ ...state, result: state.result.slice(1) }, "result"],
      [{ ...state, nodes: [] }, "state.nodes"],
      [{ ...state, edges: [{ ...state.edges[0], i: -2 }] }, "state.edges.i[0]", "-2"],
      [{ ...state, edges: [{ ...state.edges[0], w: 1 }] }, "state.edges[0].w"],
      [{ ...state, edges: 4 }, "state.edges"],
    ];
    for (const [wrong, ...says] of rows) {
      const { code, message } = await errorOf(() => other.deformer.restore(wrong as never));
      expect(code).toBe("invalid-option");
      for (const words of says) expect(message).toContain(words);
    }
    expect(other.deformer.state()).toEqual(deformer.state());
  });

  it("carries no other points, refines nothing, and needs a surface", async () => {
    const { deformer } = grabbed();
    const carried = await errorOf(() => deformer.transformPoints([1, 2, 3]));
    expect(carried).toMatchObject({ code: "not-solvable", message: expect.stringContaining("embedded-graph") });
    const refined = await errorOf(() => pliant.deformer(shape, { method, refine: true } as never));
    expect(refined).toMatchObject({ code: "invalid-option", message: expect.stringContaining(`options.refine is not a known option of ${method}`) });
    const points = await errorOf(() => pliant.deformer(pliant.shape({ positions: mesh.positions }), { method }));
    expect(points).toMatchObject({ code: "invalid-shape", message: expect.stringContaining("no triangles") });
    expect((await deformer.solve()).converged).toBe(true);
  });

  it("gives the same from a worker", async () => {
    const { deformer, hand } = grabbed();
    const library = await entries.worker.init();
    const remote = await library.deformer(await library.shape(mesh), { method });
    await remote.setFixed(where(mesh.positions, (x) => x <= 0.1));
    const far = await remote.addHandle(hand.vertices);
    await far.move(lift.move);
    const change = (method === "arap" ? { energy: "spokes-and-rims" } : { pBend: 0.5, field: { geodesic: { vertices: [0] } } }) as never;
    for (const each of [deformer, remote]) {
      await each.setOptions(change);
      await each.solve({ maxIterations: 9 });
    }
    expect(await remote.positions()).toEqual(deformer.positions());
    expect(await remote.state()).toEqual(deformer.state());
    if (method === "edge-material") expect(await remote.field()).toEqual(deformer.field());
    else expect((await errorOf(() => remote.field())).code).toBe("not-solvable");
    expect((await errorOf(() => remote.transformPoints([1, 2, 3]))).code).toBe("not-solvable");
    expect((await errorOf(() => remote.setOptions({ nodeCount: 3 } as never))).code).toBe("invalid-option");
    library.dispose();
  });

  it("moves a three.js geometry whose seams stay closed", async () => {
    const geometry = new BoxGeometry(1, 1, 1, 4, 4, 4);
    const binding = new entries.three.GeometryBinding(geometry);
    const box = pliant.shape(entries.three.shapeOf(geometry));
    const deformer = pliant.deformer(box, { method });
    deformer.setFixed(box.select(half([0, -1, 0], 0.49)));
    deformer.addHandle(box.select(half([0, 1, 0], 0.49))).move({ rotate: { axis: [0, 1, 0], degrees: 60 } });
    const { attributes: { position } } = geometry;
    const at = (v: number) => [position.getX(v), position.getY(v), position.getZ(v)].join(" ");
    const places = () => new Set(Array.from({ length: position.count }, (_, v) => at(v))).size;
    const before = places();
    await deformer.solve();
    binding.update(deformer);
    expect(before).toBeLessThan(position.count);
    expect(places()).toBe(before);
  });
});
