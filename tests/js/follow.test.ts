// Parts that follow: what no edge joins to a surface goes along with it.

import { describe, expect, it } from "vitest";
import { half } from "./support/edit_script.js";
import { arc, camera, limb, straight } from "./support/limb.js";
import { entries, errorOf, pliant } from "./support/package.js";
import { joined, orb } from "./support/parts.js";
import { sheet, where } from "./support/shapes.js";

interface FollowState {
  vertices: number[];
  rotation: number[];
  translation: number[];
}
type Document = Parameters<ReturnType<typeof pliant.open>["apply"]>[0];

const document = (...steps: object[]) => ({ format: "pliant-edit", version: 1, steps }) as object as Document;
const at = (positions: ArrayLike<number>, v: number) => [0, 1, 2].map((k) => positions[3 * v + k]);
const gathered = (positions: ArrayLike<number>, ids: readonly number[]) => ids.flatMap((v) => at(positions, v));
const apart = (a: number[], b: number[]) => Math.hypot(...a.map((x, i) => x - b[i]));

/** Carries documents out one after the other, in double. */
function result(mesh: ReturnType<typeof sheet>, ...documents: Document[]) {
  const edit = pliant.open(pliant.shape(mesh));
  for (const one of documents) {
    edit.apply(one);
    edit.run();
  }
  return { edit, positions: edit.positions(new Float64Array(mesh.positions.length)), normals: edit.normals() };
}

const plane = sheet(13);
const bead = orb(6, 0.04, [0.75, 0.5, 0.08]);
const mesh = joined(plane, bead);
const first = plane.positions.length / 3;
const ids = Array.from({ length: bead.positions.length / 3 }, (_, i) => first + i);
const along = where(plane.positions, (x, y) => Math.hypot(x - 0.75, y - 0.5) < 0.15);
const follow = [{ select: { vertices: ids }, along: { vertices: along } }];
const lift = {
  method: "arap", fixed: [{ vertices: where(plane.positions, (x) => x < 0.1) }],
  handles: [{
    name: "hand", select: { vertices: where(plane.positions, (x) => x > 0.9) },
    move: { translate: [-0.1, 0, 0.4], rotate: { axis: [0, 1, 0], degrees: -60 } },
  }],
  solve: { iterations: 200 },
};

describe("a part that follows", () => {
  const { positions, normals, edit } = result(mesh, document({ ...lift, follow }));
  const alone = result(mesh, document(lift));

  it("goes where the rigid motion of what it lies on takes it, and the rest is as without it", () => {
    const move = pliant.rigidMotion(gathered(mesh.positions, along), gathered(positions, along));
    expect(move.rotate.degrees).toBeGreaterThan(20);
    const moved = document({ method: "place", parts: [{ select: { vertices: ids }, move }] });
    const expected = result(mesh, moved).positions;
    for (const v of ids) expect(apart(at(positions, v), at(expected, v))).toBeLessThan(1e-12);
    expect(positions.subarray(0, 3 * first)).toEqual(alone.positions.subarray(0, 3 * first));
    expect(Math.max(...ids.map((v) => apart(at(positions, v), at(alone.positions, v))))).toBeGreaterThan(0.05);
  });

  it("turns its normals, and is the rest of the step after it", () => {
    const outwards = (points: ArrayLike<number>, v: number) => {
      const center = [0, 1, 2].map((k) => ids.reduce((sum, id) => sum + points[3 * id + k], 0) / ids.length);
      return at(points, v).map((x, k) => (x - center[k]) / 0.04);
    };
    const [before] = [pliant.open(pliant.shape(mesh)).normals()];
    for (const v of ids) {
      const [was, now] = [at(before, v), at(normals, v)];
      const dot = (a: number[], b: number[]) => a.reduce((sum, x, i) => sum + x * b[i], 0);
      expect(dot(now, outwards(positions, v))).toBeCloseTo(dot(was, outwards(mesh.positions, v)), 5);
    }
    const next = { method: "place", parts: [{ select: { vertices: [0] }, move: { translate: [0, 0, 0] } }] };
    const after = result(mesh, document({ ...lift, follow }, next)).positions;
    expect(after).toEqual(positions);
  });

  it("is told by the state", () => {
    const [{ vertices, rotation, translation }] = edit.state().follow as FollowState[];
    expect(vertices).toEqual(ids);
    for (const v of ids) {
      const p = at(mesh.positions, v);
      const turned = [0, 1, 2].map((row) => p.reduce((sum, x, k) => sum + rotation[3 * row + k] * x, 0));
      const moved = turned.map((x, k) => x + translation[k]);
      expect(apart(moved, at(positions, v))).toBeLessThan(1e-12);
    }
    expect(alone.edit.state()).not.toHaveProperty("follow");
    const deformer = pliant.deformer(pliant.shape(mesh), { method: "arap" }); // which takes the rest of it back
    deformer.setFixed(lift.fixed[0].vertices);
    deformer.addHandle(lift.handles[0].select.vertices);
    deformer.restore(edit.state());
    expect(deformer.positions(new Float64Array(positions.length))).toEqual(alone.positions);
  });

  it("comes and goes with the document, comes back with a moment, in pliant.edit and a worker too", async () => {
    const { edit } = result(mesh, document(lift), document({ ...lift, follow }));
    expect(edit.positions(new Float64Array(positions.length))).toEqual(positions);
    expect(edit.report().steps[0].factorizations).toBe(alone.edit.report().steps[0].factorizations); // it costs nothing
    const moment = structuredClone(edit.moment());
    edit.apply(document(lift));
    edit.run();
    expect(edit.positions(new Float64Array(positions.length))).toEqual(alone.positions);
    edit.apply(moment);
    expect(edit.positions(new Float64Array(positions.length))).toEqual(positions);
    const edited = await pliant.edit(pliant.shape(mesh), document({ ...lift, follow }) as never);
    expect(edited.positions).toEqual(positions);
    const library = await entries.worker.init();
    const there = await library.open(await library.shape(mesh));
    await there.apply(document({ ...lift, follow }));
    await there.run();
    expect(await there.positions(new Float64Array(positions.length))).toEqual(positions);
  });

  it("goes its own way where the step fixes or moves a vertex of it", () => {
    const held = { name: "bead", select: { vertices: [ids[0]] }, move: { translate: [0, 0, 0.1] } };
    const moves = { ...lift, handles: [...lift.handles, held] };
    const fixes = { ...lift, fixed: [...lift.fixed, { vertices: [ids[3]] }] };
    for (const step of [moves, fixes]) {
      expect(result(mesh, document({ ...step, follow })).positions).toEqual(result(mesh, document(step)).positions);
    }
  });

  it("follows every way of drawing on the surface it lies on", () => {
    const tube = limb(12, 31);
    const eye = orb(6, 0.02, [0.07, 0, 0.9]);
    const head = joined(tube, eye);
    const eyes = where(head.positions, (x) => x > 0.0501);
    const step = { method: "sketch", camera, reference: straight, bend: { target: arc } };
    const near = where(tube.positions, (x, _, z) => x > 0 && Math.abs(z - 0.9) < 0.08);
    const part = { select: { vertices: eyes }, along: { vertices: near } };
    const { positions } = result(head, document({ ...step, follow: [part] }));
    for (const v of eyes) {
      expect(Math.min(...near.map((w) => apart(at(positions, v), at(positions, w))))).toBeLessThan(0.1);
    }
    expect(Math.min(...eyes.map((v) => apart(at(positions, v), at(head.positions, v))))).toBeGreaterThan(0.2);
  });

  it.each<[string, unknown, string]>([
    ["no list", 3, "steps[0].follow is 3"],
    ["an unknown key", [{ ...follow[0], after: 1 }], "steps[0].follow[0].after"],
    ["nothing that follows", [{ select: half([0, 0, 1], 9), along: { all: true } }], "steps[0].follow[0].select"],
    ["nothing to go along with", [{ select: { all: true }, along: half([0, 0, 1], 9) }], "steps[0].follow[0].along"],
    ["a selection left out", [{ select: { all: true } }], "steps[0].follow[0].along"],
  ])("is refused for %s, and nothing has changed", async (_, wrong, says) => {
    const { edit } = result(mesh, document({ ...lift, follow }));
    const { code, message } = await errorOf(() => {
      edit.apply(document({ ...lift, follow: wrong }));
      edit.run();
    });
    expect([code, message]).toEqual(["invalid-script", expect.stringContaining(says)]);
    expect(edit.positions(new Float64Array(positions.length))).toEqual(positions);
  });

  it("is the same in all key frames", async () => {
    const keyframes = [{ time: 0, steps: [{ ...lift, follow }] }, { time: 1, steps: [lift] }];
    const script = { format: "pliant-edit", version: 1, frames: 2, keyframes };
    const { message } = await errorOf(() => pliant.edit(pliant.shape(mesh), script as never));
    expect(message).toContain("keyframes[1].steps[0].follow");
  });
});
