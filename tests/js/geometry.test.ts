// What a shape tells beside its report: patches, loose parts, its volume; and the rigid motion between points.

import { describe, expect, it } from "vitest";
import { entries, errorOf, pliant } from "./support/package.js";
import { joined, orb } from "./support/parts.js";
import { cloud, picture, sheet, torus, where } from "./support/shapes.js";

describe("a patch", () => {
  const mesh = sheet(9);
  const shape = pliant.shape(mesh);
  const middle = 40;
  const center = [...mesh.positions.subarray(3 * middle, 3 * middle + 3)];
  const within = (radius: number, [x, y, z] = center) =>
    where(mesh.positions, (a, b, c) => Math.hypot(a - x, b - y, c - z) <= radius);

  it("is what lies within its ball, and always its vertex", () => {
    expect(within(0.3).length).toBeGreaterThan(9);
    expect(Array.from(shape.patch([{ vertex: middle, center }], 0.3))).toEqual(within(0.3));
    expect(shape.patch([{ vertex: middle }], 0.3)).toEqual(shape.patch([{ vertex: middle, center }], 0.3));
    expect(shape.patch([{ vertex: middle, center: [5, 5, 5] }], 0.3)).toEqual(Uint32Array.of(middle));
    expect(shape.patch([], 0.3)).toEqual(Uint32Array.of());
  });

  it("of several spots is what each of them has", () => {
    const [a, b] = [0, 80].map((vertex) => shape.patch([{ vertex }], 0.3));
    expect(shape.patch([{ vertex: 80 }, { vertex: 0 }], 0.3)).toEqual(Uint32Array.of(...a, ...b).sort());
  });

  it("keeps copies of a vertex together", () => {
    const corners = Array.from(mesh.triangles);
    const positions = corners.flatMap((v) => [...mesh.positions.subarray(3 * v, 3 * v + 3)]);
    const soup = pliant.shape({ positions, triangles: corners.map((_, i) => i) });
    const found = soup.patch([{ vertex: corners.indexOf(middle) }], 0.3);
    expect(new Set(Array.from(found, (i) => corners[i]))).toEqual(new Set(within(0.3)));
    expect(found).toHaveLength(corners.filter((v) => within(0.3).includes(v)).length);
  });

  it("is measured where the vertices are now", () => {
    const stretched = mesh.positions.map((x) => 3 * x);
    expect(Array.from(shape.patch([{ vertex: middle }], 0.9, stretched))).toEqual(within(0.3));
    expect(Array.from(shape.patch([{ vertex: middle }], 0.9, Float32Array.from(stretched)))).toEqual(within(0.3));
  });

  it("takes points by distance, and lies in the plane", () => {
    const points = pliant.shape({ positions: cloud(60) });
    expect(points.patch([{ vertex: 3 }], 0.4).length).toBeGreaterThan(3);
    const flat = pliant.shape({ ...picture(9), dimension: 2 });
    const { positions } = picture(9);
    const two = (vertex: number) => ({ vertex, center: [...positions.subarray(2 * vertex, 2 * vertex + 2)] });
    expect(flat.patch([two(40)], 0.3)).toEqual(flat.patch([{ vertex: 40 }], 0.3));
    expect(flat.patch([two(40)], 0.3, picture(9).positions)).toEqual(flat.patch([{ vertex: 40 }], 0.3));
  });

  it.each<[string, Parameters<typeof shape.patch>, string]>([
    ["no list", [7 as never, 1], "spots is 7"],
    ["no vertex", [[{ vertex: 81 }], 1], "spots[0].vertex is 81"],
    ["a center of two numbers", [[{ vertex: 1 }, { vertex: 0, center: [0, 0] }], 1], "spots[1].center"],
    ["an unknown key", [[{ vertex: 0, centre: [0, 0, 0] } as never], 1], "spots[0].centre"],
    ["a radius below 0", [[{ vertex: 0 }], -1], "radius is -1"],
    ["too few positions", [[{ vertex: 0 }], 1, [0, 0, 0]], "positions"],
    ["a number that is none", [[{ vertex: 0 }], 1, mesh.positions.map(() => NaN)], "positions[0] is NaN"],
  ])("is refused for %s", async (_, args, says) => {
    const { code, message } = await errorOf(() => shape.patch(...args));
    expect([code, message]).toEqual(["invalid-option", expect.stringContaining(says)]);
  });
});

describe("loose parts", () => {
  const ball = orb(24, 1, [0, 0, 0]);
  const head = joined(orb(6, 0.1, [0.4, 0.3, 1.05]), ball, orb(8, 0.1, [-0.4, 0.3, 1.05]));

  it("are small, most vertices first, and lie beside what is near", () => {
    const parts = pliant.shape(head).looseParts();
    expect(parts.map(({ vertices }) => [vertices[0], vertices.length])).toEqual([[36 + 576, 64], [0, 36]]);
    for (const { vertices, beside } of parts) {
      expect(beside.length).toBeGreaterThan(8);
      const at = (v: number) => head.positions.subarray(3 * v, 3 * v + 3);
      for (const v of beside) {
        expect(v).toBeGreaterThanOrEqual(36);
        expect(v).toBeLessThan(36 + 576);
        expect(Math.hypot(...at(v).map((x, k) => x - at(vertices[0])[k]))).toBeLessThan(0.9);
      }
    }
  });

  it("are none of one piece, of points and of equals", () => {
    expect(pliant.shape(ball).looseParts()).toEqual([]);
    expect(pliant.shape({ positions: head.positions }).looseParts()).toEqual([]);
    expect(pliant.shape(joined(ball, orb(24, 1, [3, 0, 0]))).looseParts()).toEqual([]);
  });
});

it("the volume is signed, and null where nothing is bounded", () => {
  const { positions, triangles } = torus(60, 40);
  const volume = pliant.shape({ positions, triangles }).volume()!;
  expect(Math.abs(volume)).toBeGreaterThan(0.97 * 2 * Math.PI ** 2 * 0.16);
  expect(Math.abs(volume)).toBeLessThan(2 * Math.PI ** 2 * 0.16);
  expect(pliant.shape({ positions, triangles: triangles.toReversed() }).volume()).toBeCloseTo(-volume, 12);
  expect(pliant.shape(sheet(5)).volume()).toBeNull();
  expect(pliant.shape({ positions }).volume()).toBeNull();
});

describe("the rigid motion between points", () => {
  const from = cloud(20);

  it("is found again as a transform that a handle takes", () => {
    const shape = pliant.shape({ positions: from });
    const moved = (move: object) => {
      const { targets } = (() => {
        const deformer = pliant.deformer(shape, { method: "embedded-graph", nodeCount: 5 });
        deformer.addHandle(where(from, () => true)).move(move);
        return deformer.state().handles[0];
      })();
      return targets.flat();
    };
    const to = moved({ rotate: { axis: [1, 2, -0.5], degrees: 140 }, translate: [3, 0, -1] });
    const motion = pliant.rigidMotion(from, to);
    expect(motion.rotate.degrees).toBeCloseTo(140, 9);
    moved(motion).forEach((x, i) => expect(x).toBeCloseTo(to[i], 12));
    const still = { axis: [0, 0, 1], degrees: 0 };
    expect(pliant.rigidMotion(from, from)).toMatchObject({ rotate: still, translate: [0, 0, 0] });
    const shift = { rotate: { ...still, about: [1, 2, 3] }, translate: [3, 2, 1] };
    expect(pliant.rigidMotion([1, 2, 3], [4, 4, 4])).toEqual(shift);
  });

  it.each<[ArrayLike<number>, ArrayLike<number>, string]>([
    [[], [], "from is empty"],
    [[1, 2], [1, 2], "from is an array of length 2"],
    [[1, 2, 3], [1, 2, 3, 4, 5, 6], "to is an array of length 6; expected 3 numbers"],
    [[1, 2, NaN], [1, 2, 3], "from[2] is NaN"],
  ])("is refused for %j and %j", async (a, b, says) => {
    const { code, message } = await errorOf(() => pliant.rigidMotion(a, b));
    expect([code, message]).toEqual(["invalid-option", expect.stringContaining(says)]);
  });
});

it("a worker tells the same", async () => {
  const library = await entries.worker.init();
  const mesh = joined(orb(24, 1, [0, 0, 0]), orb(8, 0.1, [-0.4, 0.3, 1.05]));
  const [there, here] = [await library.shape(mesh), pliant.shape(mesh)];
  expect(await there.patch([{ vertex: 5 }], 0.4, mesh.positions)).toEqual(here.patch([{ vertex: 5 }], 0.4));
  expect(await there.looseParts()).toEqual(here.looseParts());
  expect(await there.volume()).toBe(here.volume());
  expect(await library.rigidMotion([1, 2, 3], [4, 4, 4])).toEqual(pliant.rigidMotion([1, 2, 3], [4, 4, 4]));
  await there.dispose();
});
