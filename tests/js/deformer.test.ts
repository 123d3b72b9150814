// Deformers and handles: their calls, on the installed package.

import { beforeEach, describe, expect, it } from "vitest";
import { errorOf, pliant } from "./support/package.js";
import { cloud, picture, sheet, torus, where } from "./support/shapes.js";

const mesh = sheet(21);
const shape = pliant.shape(mesh);
const left = where(mesh.positions, (x) => x < 0.15);
const right = where(mesh.positions, (x) => x > 0.9);
const options = { method: "embedded-graph", nodeCount: 40 } as const;

const largest = (values: readonly number[]) => values.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
const difference = (a: ArrayLike<number>, b: ArrayLike<number>) => largest(Array.from(a, (x, i) => x - b[i]));

let deformer = pliant.deformer(shape, options);
beforeEach(() => {
  deformer = pliant.deformer(shape, options);
  deformer.setFixed(left);
});

describe("results", () => {
  it("begin at rest", () => {
    expect(deformer.positions()).toEqual(Float32Array.from(mesh.positions));
    expect(deformer.energy().total).toBe(0);
  });

  it("are copies", async () => {
    const hand = deformer.addHandle(right);
    const before = deformer.positions();
    const kept = before.slice();
    hand.move({ translate: [0, 0, 0.3] });
    await deformer.solve();
    expect(before).toEqual(kept);
    expect(difference(deformer.positions(), before)).toBeGreaterThan(0.2);
  });

  it("go into the caller's array, in its precision", async () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.3] });
    await deformer.solve();
    const singles = new Float32Array(mesh.positions.length);
    const doubles = new Float64Array(mesh.positions.length);
    expect(deformer.positions(singles)).toBe(singles);
    expect(deformer.positions(doubles)).toBe(doubles);
    expect(singles).toEqual(Float32Array.from(doubles));
    expect(singles).not.toEqual(doubles);
    expect(deformer.normals(doubles)).toBe(doubles);
    for (let v = 0; v < doubles.length; v += 3) expect(Math.hypot(...doubles.subarray(v, v + 3))).toBeCloseTo(1, 6);
  });

  it("leave fixed vertices where they are and bring handles near their targets", async () => {
    const hand = deformer.addHandle(right);
    hand.move({ translate: [0, 0, 0.2] });
    await deformer.solve();
    const moved = deformer.positions(new Float64Array(mesh.positions.length));
    for (const v of left) expect(moved.subarray(3 * v, 3 * v + 3)).toEqual(mesh.positions.subarray(3 * v, 3 * v + 3));
    for (const v of right) expect(moved[3 * v + 2] - mesh.positions[3 * v + 2]).toBeCloseTo(0.2, 1);
  });

  it("carry other points as they carry vertices, in place if asked", async () => {
    deformer.addHandle(right).move({ translate: [0, 0.1, 0.3] });
    await deformer.solve();
    const expected = deformer.positions(new Float64Array(mesh.positions.length));
    expect(difference(deformer.transformPoints(mesh.positions), expected)).toBeLessThan(1e-12);
    const points = mesh.positions.slice();
    expect(deformer.transformPoints(points, points)).toBe(points);
    expect(difference(points, expected)).toBeLessThan(1e-12);
    expect(deformer.transformPoints(Float32Array.from(points))).toBeInstanceOf(Float32Array);
  });

  it("carry more points than fit in one piece", () => {
    const many = cloud(70_000);
    expect(difference(deformer.transformPoints(many), many)).toBeLessThan(1e-12);
  });
});

describe("handles", () => {
  it("follow scale, rotation and translation in this order, about the centroid", async () => {
    const alone = pliant.deformer(shape, options);
    const hand = alone.addHandle(right);
    hand.move({ scale: 2, rotate: { axis: [0, 0, 3], degrees: 90 }, translate: [1, 2, 3] });
    const { targets } = alone.state().handles[0];
    const center = [0, 1, 2].map(
      (axis) => right.reduce((sum, v) => sum + mesh.positions[3 * v + axis], 0) / right.length,
    );
    right.forEach((v, i) => {
      const [x, y, z] = [0, 1, 2].map((axis) => 2 * (mesh.positions[3 * v + axis] - center[axis]));
      expect(difference(targets[i], [center[0] - y + 1, center[1] + x + 2, center[2] + z + 3])).toBeLessThan(1e-12);
    });
  });

  it("turn about another point when told", () => {
    const hand = deformer.addHandle([right[0]]);
    hand.move({ rotate: { axis: [0, 0, 1], degrees: 180, about: [0, 0, 0] } });
    const [x, y, z] = mesh.positions.subarray(3 * right[0], 3 * right[0] + 3);
    expect(difference(deformer.state().handles[0].targets[0], [-x, -y, z])).toBeLessThan(1e-12);
  });

  it("take a matrix, column by column", () => {
    const hand = deformer.addHandle([right[0]]);
    hand.move({ matrix: [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1] });
    const [x, y, z] = mesh.positions.subarray(3 * right[0], 3 * right[0] + 3);
    expect(difference(deformer.state().handles[0].targets[0], [5 - y, 6 + x, 7 + z])).toBeLessThan(1e-12);
  });

  it("move each vertex to its own target, in the order they were given", () => {
    const order = [right[2], right[0], right[1]];
    deformer.addHandle(order).moveTo(Float32Array.from({ length: 9 }, (_, i) => i));
    const { vertices, targets } = deformer.state().handles[0];
    expect(vertices).toEqual(order);
    expect(targets).toEqual([[0, 1, 2], [3, 4, 5], [6, 7, 8]]);
  });

  it("move from rest every time", () => {
    const hand = deformer.addHandle(right);
    hand.move({ translate: [0, 0, 1] });
    hand.move({ translate: [0, 0, 1] });
    expect(deformer.state().handles[0].targets[0][2] - mesh.positions[3 * right[0] + 2]).toBeCloseTo(1, 12);
    hand.move({});
    expect(deformer.state().handles[0].targets[0]).toEqual(
      Array.from(mesh.positions.subarray(3 * right[0], 3 * right[0] + 3)),
    );
  });

  it("can be removed, and their vertices held again", async () => {
    const hand = deformer.addHandle(right);
    expect(deformer.handles).toEqual([hand]);
    hand.remove();
    expect(deformer.handles).toEqual([]);
    expect((await errorOf(() => hand.move({}))).code).toBe("disposed");
    deformer.addHandle(right);
  });

  it("take ids from any iterable", () => {
    const ids = function* () { yield* right; };
    expect(Array.from(deformer.addHandle(ids()).vertices)).toEqual(right);
  });

  it("stand for all copies of a vertex along a seam", async () => {
    // The last column of vertices once more, at the same places.
    const copies = right.flatMap((v) => Array.from(mesh.positions.subarray(3 * v, 3 * v + 3)));
    const seamed = pliant.shape({ positions: [...mesh.positions, ...copies], triangles: mesh.triangles });
    const twin = pliant.deformer(seamed, options);
    twin.setFixed(left);
    twin.addHandle(right).move({ translate: [0, 0, 0.3] });
    await twin.solve();
    const moved = twin.positions();
    right.forEach((v, i) => {
      const copy = mesh.positions.length / 3 + i;
      expect(moved.subarray(3 * copy, 3 * copy + 3)).toEqual(moved.subarray(3 * v, 3 * v + 3));
    });
    expect((await errorOf(() => twin.addHandle([mesh.positions.length / 3]))).code).toBe("invalid-handle");
  });
});

describe("solving", () => {
  it("reports a step", () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.3] });
    const start = deformer.energy();
    const step = deformer.step();
    expect(step).toMatchObject({ iteration: 1, converged: false });
    expect(step.energy).toBeLessThan(start.total);
    expect(Object.keys(step.terms)).toEqual(["rotation", "regularization", "constraint"]);
    const { rotation, regularization, constraint } = step.terms;
    expect(rotation + 10 * regularization + 100 * constraint).toBeCloseTo(step.energy, 9);
    expect(step.milliseconds).toBeGreaterThanOrEqual(0);
  });

  it("never raises the energy, and tells every iteration", async () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.4] });
    const energies = [deformer.energy().total];
    const solution = await deformer.solve({ onProgress: ({ accepted, energy }) => accepted && energies.push(energy) });
    expect(solution.converged).toBe(true);
    expect(solution.iterations).toBe(energies.length - 1);
    energies.slice(1).forEach((energy, i) => expect(energy).toBeLessThanOrEqual(energies[i]));
  });

  it("stops after maxIterations", async () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.4] });
    expect(await deformer.solve({ maxIterations: 2 })).toMatchObject({ iterations: 2, converged: false });
  });

  it("factorises on a grab and not while dragging", async () => {
    const hand = deformer.addHandle(right);
    hand.move({ translate: [0, 0, 0.1] });
    await deformer.solve();
    const { factorizations, analyses } = deformer.counters();
    expect(factorizations).toBeGreaterThan(0);
    for (let i = 1; i <= 5; ++i) {
      hand.move({ translate: [0, 0, 0.1 + 0.01 * i] });
      deformer.step();
    }
    expect(deformer.counters()).toMatchObject({ factorizations, analyses });
  });

  it("leaves fixed regions out of the unknowns", () => {
    const free = pliant.deformer(shape, options);
    for (const each of [free, deformer]) each.addHandle(right).move({ translate: [0, 0, 0.1] });
    free.step();
    deformer.step();
    expect(free.counters().unknowns).toBe(12 * 40);
    expect(deformer.counters().unknowns).toBe(12 * (40 - (deformer.state().frozen as number[]).length));
    expect(deformer.counters().unknowns).toBeLessThan(12 * 40);
  });

  it("meets targets exactly when asked", async () => {
    const exact = pliant.deformer(shape, { ...options, exactHandles: true });
    exact.setFixed(left);
    const ids = [right[0], right[right.length - 1]];
    exact.addHandle(ids).moveTo([1.1, 0, 0.2, 1.05, 1, 0.3]);
    await exact.solve({ maxIterations: 300 });
    const moved = exact.positions(new Float64Array(mesh.positions.length));
    expect(
      difference(ids.flatMap((v) => Array.from(moved.subarray(3 * v, 3 * v + 3))), [1.1, 0, 0.2, 1.05, 1, 0.3]),
    ).toBeLessThan(1e-6 * shape.diagonal);
  });

  it("adds nodes where they are missing when asked", async () => {
    const coarse = pliant.deformer(shape, { ...options, nodeCount: 16, refine: true });
    coarse.setFixed(left);
    coarse.addHandle(right).move({ translate: [-0.3, 0, 0.5], rotate: { axis: [0, 1, 0], degrees: 120 } });
    await coarse.solve({ maxIterations: 500 });
    const nodes = (coarse.state().nodes as number[][]).length;
    expect(nodes).toBeGreaterThan(16);
    expect(nodes).toBeLessThanOrEqual(24);
  });

  it("has two regions that are cut move on their own", async () => {
    const cut = pliant.deformer(shape, { ...options, cuts: [[{ vertices: left }, { not: { vertices: left } }]] });
    cut.addHandle(right).move({ translate: [0, 0, 0.5] });
    await cut.solve();
    const moved = cut.positions();
    expect(largest(left.map((v) => moved[3 * v + 2] - mesh.positions[3 * v + 2]))).toBeLessThan(1e-6);
    expect(largest(right.map((v) => moved[3 * v + 2] - mesh.positions[3 * v + 2]))).toBeGreaterThan(0.4);
  });

  it.each([
    ["nodes placed by hand", { nodes: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0.5, 0.5, 0]] }, 5],
    ["nodes in one array", { nodes: Float32Array.of(0, 0, 0, 1, 1, 0) }, 2],
    ["what simplification leaves", { sampling: "simplify", nodeCount: 30 }, 30],
  ])("builds on %s", (_, more, count) => {
    const built = pliant.deformer(shape, { method: "embedded-graph", ...more } as never);
    expect(built.state().nodes).toHaveLength(count);
  });

  it("has a default number of nodes that fits small shapes", () => {
    const small = pliant.shape({ positions: cloud(10) });
    expect(pliant.deformer(small, { method: "embedded-graph" }).state().nodes).toHaveLength(10);
  });

  it("lets the event loop run", async () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.4] });
    let turns = 0;
    const timer = setInterval(() => ++turns, 0);
    await deformer.solve({
      tolerance: 1e-14,
      maxIterations: 1000,
      onProgress: () => {
        for (const end = performance.now() + 2; performance.now() < end;);
      },
    });
    clearInterval(timer);
    expect(turns).toBeGreaterThan(0);
  });
});

describe("aborting", () => {
  it("rejects and leaves a deformer that solves on", async () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.4] });
    const controller = new AbortController();
    const aborted = errorOf(() => deformer.solve({ signal: controller.signal, onProgress: () => controller.abort() }));
    expect((await aborted).code).toBe("aborted");
    expect((await deformer.solve()).converged).toBe(true);
  });

  it("rejects at once when the signal is aborted already", async () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.4] });
    const rest = deformer.energy().total;
    expect((await errorOf(() => deformer.solve({ signal: AbortSignal.abort() }))).code).toBe("aborted");
    expect(deformer.energy().total).toBe(rest);
  });

  it("rejects with what a callback throws, and solves on", async () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.4] });
    await expect(deformer.solve({ onProgress: () => { throw new RangeError("mine"); } })).rejects.toThrow(RangeError);
    expect((await deformer.solve()).converged).toBe(true);
  });
});

describe("states", () => {
  it("restore what was, after JSON", async () => {
    const hand = deformer.addHandle(right);
    hand.move({ translate: [0, 0, 0.3] });
    await deformer.solve();
    const then = deformer.positions();
    const saved = JSON.parse(JSON.stringify(deformer.state()));
    hand.move({ translate: [0.1, 0, -0.3] });
    await deformer.solve();
    expect(deformer.positions()).not.toEqual(then);
    deformer.restore(saved);
    expect(difference(deformer.positions(), then)).toBeLessThan(1e-6);
    expect(deformer.state().handles).toEqual(saved.handles);
    expect((await deformer.solve()).iterations).toBeLessThanOrEqual(3);
  });

  it("go to another deformer over the same shape", async () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.3] });
    await deformer.solve();
    const other = pliant.deformer(shape, { method: "embedded-graph", nodeCount: 20 });
    other.restore(deformer.state());
    expect(difference(other.positions(), deformer.positions())).toBeLessThan(1e-6);
  });

  it("return to rest bit for bit, with handles at rest", async () => {
    deformer.addHandle(right).move({ translate: [0, 0, 0.3] });
    await deformer.solve();
    deformer.reset();
    expect(deformer.positions(new Float64Array(mesh.positions.length))).toEqual(mesh.positions);
    expect(deformer.energy().total).toBe(0);
  });
});

describe("the plane", () => {
  const flat = picture(15);
  const flatShape = pliant.shape({ ...flat, dimension: 2 });
  const side = (test: (x: number) => boolean) =>
    Array.from({ length: 225 }, (_, v) => v).filter((v) => test(flat.positions[2 * v]));

  it("has two numbers a point everywhere", async () => {
    const bent = pliant.deformer(flatShape, { method: "embedded-graph", nodeCount: 25 });
    bent.setFixed(side((x) => x < 0.1));
    const hand = bent.addHandle(side((x) => x > 0.9));
    hand.move({ rotate: { degrees: 40, about: [0.5, 0.5] }, translate: [0, 0.1] });
    await bent.solve();
    const moved = bent.positions();
    expect(moved).toHaveLength(2 * 225);
    expect(difference(bent.transformPoints(flat.positions), moved)).toBeLessThan(1e-6);
    hand.moveTo(side((x) => x > 0.9).flatMap((v) => [1.2, flat.positions[2 * v + 1]]));
    await bent.solve();
    expect(bent.positions()[moved.length - 2]).toBeGreaterThan(1.1);
    expect((await errorOf(() => hand.move({ translate: [0, 0, 1] } as never))).code).toBe("invalid-handle");
    expect((await errorOf(() => hand.move({ rotate: { axis: [1, 0, 0], degrees: 10 } }))).message).toContain(
      "leaves the plane",
    );
  });
});

describe("large turns", () => {
  it("are followed beyond half a turn", async () => {
    const ring = torus(48, 10);
    const bar = pliant.deformer(pliant.shape(ring), { method: "embedded-graph", nodeCount: 80 });
    bar.setFixed(where(ring.positions, (x) => x < -1));
    const end = where(ring.positions, (x) => x > 1.2);
    const hand = bar.addHandle(end);
    hand.move({ rotate: { axis: [1, 0, 0], degrees: 150 } });
    await bar.solve({ maxIterations: 300 });
    const rotations = bar.state().rotations as number[][];
    const determinants = rotations.map(
      ([a, b, c, d, e, f, g, h, i]) => a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g),
    );
    expect(Math.min(...determinants)).toBeGreaterThan(0);
  });
});

describe("measuring", () => {
  it("finds nothing at rest and the factor of a scaling", () => {
    expect(pliant.measure(shape, mesh.positions)).toMatchObject({
      stretch: { mean: 0, p95: 0, max: 0 }, shear: 0, area: 1, volume: null, folds: 0, intersections: 0,
    });
    const solid = torus(24, 12);
    const twice = pliant.measure(pliant.shape(solid), solid.positions.map((x) => 2 * x), { intersections: false });
    expect(twice.stretch.mean).toBeCloseTo(1, 9);
    expect(twice.area).toBeCloseTo(4, 9);
    expect(twice.volume).toBeCloseTo(8, 9);
    expect(twice.intersections).toBeNull();
  });
});

describe("the life of objects", () => {
  it("ends at dispose, every later call an error", async () => {
    const gone = pliant.deformer(shape, options);
    const hand = gone.addHandle(right);
    gone.dispose();
    gone.dispose();
    const calls = [
      () => gone.step(), () => gone.solve(), () => gone.positions(), () => gone.normals(),
      () => gone.transformPoints([0, 0, 0]), () => gone.state(), () => gone.restore({ handles: [] }),
      () => gone.reset(), () => gone.setFixed(left), () => gone.addHandle([0]), () => gone.energy(),
      () => gone.counters(), () => hand.move({}), () => hand.remove(),
    ];
    for (const call of calls) expect((await errorOf(call)).code, String(call)).toBe("disposed");
  });

  it("ends a solve that is under way", async () => {
    const busy = pliant.deformer(shape, options);
    busy.addHandle(right).move({ translate: [0, 0, 0.4] });
    const outcome = errorOf(() => busy.solve({ tolerance: 1e-14 }));
    busy.dispose();
    expect((await outcome).code).toBe("disposed");
  });

  it("is one of its own for a deformer whose shape is gone", async () => {
    const short = pliant.shape(mesh);
    const lasting = pliant.deformer(short, options);
    short.dispose();
    lasting.addHandle(right).move({ translate: [0, 0, 0.1] });
    expect((await lasting.solve()).converged).toBe(true);
    expect((await errorOf(() => pliant.deformer(short, options))).code).toBe("disposed");
  });

  it("ends with a using declaration", () => {
    const scoped = pliant.shape(mesh);
    // What the declaration calls.
    (scoped as unknown as Record<symbol, () => void>)[Symbol.dispose ?? Symbol.for("Symbol.dispose")]();
    expect(() => pliant.deformer(scoped, options)).toThrow("disposed");
  });
});
