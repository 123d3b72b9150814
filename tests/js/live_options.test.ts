// Options of arap and edge-material that change while a handle is held: one constant matrix for many materials.

import { describe, expect, it } from "vitest";
import { half } from "./support/edit_script.js";
import { errorOf, pliant } from "./support/package.js";
import { edit, left, lift, mesh, right, shape, sheetEdit } from "./support/surface_edits.js";

describe("options while a handle is held", () => {
  const step = { method: "edge-material", ...sheetEdit };
  const costs = async (base: object, drag: object[]) => {
    const { report } = await edit(mesh, { ...base, solve: { iterations: 20 }, drag });
    return report.drag!.map(({ factorizations, analyses }) => [factorizations, analyses]);
  };

  it("cost what is promised: nothing for p, gravity and targets, one factorisation for stiffness", async () => {
    const hand = [{ name: "hand", move: { translate: [0, 0, 0.2] } }];
    expect(
      await costs(step, [
        { options: { pStretch: 0.5 } },
        { options: { pBend: 0.2 } },
        { options: { gravity: [0, 0, -1] } },
        { handles: hand },
        { options: { stretch: 2 } },
        { options: { lambda: 1e-4 } },
        { options: { bend: 0.5 } },
        { options: { field: { axis: [1, 0, 0] } } },
        { options: {} },
        { options: { lambda: 1e-4, pStretch: 1 }, handles: hand },
      ]),
    ).toEqual([[0, 0], [0, 0], [0, 0], [0, 0], [1, 0], [1, 0], [1, 0], [1, 0], [0, 0], [0, 0]]);
    expect(
      await costs({ ...step, method: "arap" }, [
        { handles: hand },
        { options: { energy: "spokes-and-rims" } },
        { options: { constraintWeight: 2 } },
        { options: { constraintWeight: 3 } },
        { options: { constraintWeight: null } },
        { options: { smoothness: 0.1 } },
        { options: { smoothness: 0.2 } },
      ]),
    ).toEqual([[0, 0], [1, 0], [1, 1], [1, 0], [1, 1], [1, 1], [1, 0]]);
  });

  it.each([
    ["edge-material", { stretch: 4, bend: 2, pStretch: 0.8, field: { axis: [1, 0, 0] } },
      { stretch: 1 }, { lambda: 0.01, pStretch: 0.5, field: null, gravity: [0, 0, -1] }],
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
    const ends = await Promise.all(
      [live, fresh].map((deformer) => deformer.solve({ maxIterations: 2000, tolerance: 1e-12 })),
    );
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
    expect(await drag({ gravity: [0, 1] })).toMatchObject({
      code: "invalid-script", message: expect.stringContaining("steps[0].drag[1].options.gravity"),
    });
    expect(await drag({ nodeCount: 3 })).toMatchObject({
      code: "invalid-script", message: expect.stringContaining("steps[0].drag[1].options.nodeCount"),
    });
    expect(await drag({ bend: 0, stretch: 0 })).toMatchObject({
      code: "invalid-script", message: expect.stringContaining("steps[0].drag[1].options"),
    });
  });
});
