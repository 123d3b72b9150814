// What arap and edge-material have in common: the methods that move a surface.

import { BoxGeometry } from "three";
import { describe, expect, it } from "vitest";
import { half } from "./support/edit_script.js";
import { entries, errorOf, pliant } from "./support/package.js";
import { where } from "./support/shapes.js";
import { lift, mesh, shape } from "./support/surface_edits.js";

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
    expect(other.deformer.positions(new Float64Array(mesh.positions.length))).toEqual(
      deformer.positions(new Float64Array(mesh.positions.length)),
    );
    expect(other.deformer.energy()).toEqual(deformer.energy());
    expect(other.deformer.state()).toEqual(deformer.state());
    const rows: [object, ...string[]][] = [
      [{ ...state, result: undefined }, "result"],
      [{ ...state, result: state.result.slice(1) }, "result"],
      [{ ...state, nodes: [] }, "state.nodes"],
      [{ ...state, edges: [{ ...state.edges[0], i: -2 }] }, "state.edges[0].i", "-2"],
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
    expect(carried).toMatchObject({
      code: "not-solvable", message: expect.stringContaining("a method that carries points"),
    });
    const refined = await errorOf(() => pliant.deformer(shape, { method, refine: true } as never));
    expect(refined).toMatchObject({
      code: "invalid-option", message: expect.stringContaining(`options.refine is not a known option of ${method}`),
    });
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
    const change = (
      method === "arap" ? { energy: "spokes-and-rims" } : { pBend: 0.5, field: { geodesic: { vertices: [0] } } }
    ) as never;
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
