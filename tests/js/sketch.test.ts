// Sketches: results against the paper's formulas, worked out here from the state alone.

import { describe, expect, it } from "vitest";
import { arc, camera, curved, limb, longArc, pixel, radius, straight, twoLimbs } from "./support/limb.js";
import { pliant } from "./support/package.js";

const mesh = limb();
const shape = pliant.shape(mesh);
const n = mesh.positions.length / 3;
const make = (more: object = {}) => pliant.sketch(shape, { camera, reference: straight, ...more });
const doubles = (sketch: ReturnType<typeof make>) => sketch.positions(new Float64Array(3 * sketch.vertices));
const difference = (a: ArrayLike<number>, b: ArrayLike<number>) =>
  Math.max(...Array.from(a, (x, i) => Math.abs(x - b[i])));
const vertex = (positions: ArrayLike<number>, v: number) => [0, 1, 2].map((k) => positions[3 * v + k]);

type Vector = readonly number[];
const minus = (a: Vector, b: Vector) => a.map((x, i) => x - b[i]);
const dot = (a: Vector, b: Vector) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = ([a, b, c]: Vector, [d, e, f]: Vector) => [b * f - c * e, c * d - a * f, a * e - b * d];

/** Right-handed about a unit axis (Rodrigues). */
function turned(v: Vector, axis: Vector, angle: number): number[] {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const across = cross(axis, v);
  return v.map((x, i) => x * c + across[i] * s + axis[i] * dot(axis, v) * (1 - c));
}

/** The point of a curve of equal steps at normalised arc length s. */
function along(curve: number[][], s: number): number[] {
  const at = Math.min(Math.max(s, 0), 1) * (curve.length - 1);
  const i = Math.min(Math.floor(at), curve.length - 2);
  return curve[i].map((x, k) => x + (at - i) * (curve[i + 1][k] - x));
}

/**
 * Where the state says that a vertex is bent to: carried with the point of the curve nearest to it, turned by its
 * angle.
 */
function bent(state: ReturnType<ReturnType<typeof make>["state"]>, v: number, rest: Vector): number[] {
  const arm = turned(
    minus(rest, along(state.reference, state.s[v])), (state.normals as number[][])[0], state.angles[v],
  );
  return along(state.target, state.s[v]).map((x, k) => x + arm[k]);
}

describe("a region", () => {
  it("is the part of the limb that the stroke covers: held at its start, moved as a whole beyond its end", () => {
    const labels = make().labels();
    expect(labels).toHaveLength(n);
    for (let v = 0; v < n; ++v) {
      const z = mesh.positions[3 * v + 2];
      if (z < 0.15) expect(labels[v]).toBe(0);
      else if (z > 0.25 && z < 0.75) expect(labels[v]).toBe(1);
      else if (z > 0.85) expect(labels[v]).toBe(2);
    }
  });

  it("has parameters from 0 to 1 along the stroke", () => {
    const s = make({ smooth: false }).parameters();
    for (let v = 0; v < n; ++v) {
      expect(s[v]).toBeCloseTo(Math.min(Math.max((mesh.positions[3 * v + 2] - 0.2) / 0.6, 0), 1), 1);
    }
  });

  it.each([
    [0.35, 0], [0.65, 2],
  ])("is cut by partitions: a line at %s leaves what lies beyond with label %s", (height, label) => {
    const labels = make({ partitions: [[pixel(-0.2, height), pixel(0.2, height)]] }).labels();
    for (let v = 0; v < n; ++v) {
      const beyond = (mesh.positions[3 * v + 2] - height) * (label === 0 ? -1 : 1);
      if (beyond > 0.05 && beyond < 0.1) expect(labels[v]).toBe(label);
      if (beyond < -0.05 && beyond > -0.3) expect(labels[v]).toBe(1);
    }
  });

  it("stays for another stroke, and can be taken over", () => {
    const sketch = make();
    const labels = sketch.labels();
    const leaning = curved(0.01, 0.22, 0.55, () => 0.1);
    sketch.redraw(camera, leaning);
    expect(sketch.labels()).toEqual(labels);
    sketch.bend(arc);
    const taken = make({ reference: leaning, labels });
    taken.bend(arc);
    expect(doubles(taken)).toEqual(doubles(sketch));
  });
});

describe("hold", () => {
  const reversed = (stroke: number[][]) => stroke.slice().reverse();
  // A limb of which four fifths lie above the stroke's end, or below its start.
  const low = curved(0, 0.05, 0.3, () => 0);

  it("is of the larger side, whichever way one draws", () => {
    const [up, down] = [make({ reference: low }), make({ reference: reversed(low) })];
    expect([up.held(), down.held()]).toEqual(["end", "start"]);
    expect(up.labels()).toEqual(down.labels());
    expect(up.labels()[n - 1]).toBe(0); // the far lid
    up.bend(curved(0, 0.05, 0.3, () => 1));
    down.bend(reversed(curved(0, 0.05, 0.3, () => 1)));
    expect(difference(doubles(up), doubles(down))).toBeLessThan(1e-3);
  });

  it("is of the end asked for, in scripts too", async () => {
    const up = make({ reference: low, hold: "start" });
    expect(up.held()).toBe("start");
    expect(up.labels()[n - 1]).toBe(2);
    const target = curved(0, 0.05, 0.3, () => 1);
    up.bend(target);
    const step = { method: "sketch" as const, camera, reference: low, hold: "start" as const, bend: { target } };
    const { positions } = await pliant.edit(shape, { format: "pliant-edit", version: 1, steps: [step] });
    expect(difference(positions, doubles(up))).toBeLessThan(1e-6);
    expect(() => make({ hold: "both" })).toThrow(/^hold is "both"; expected/);
  });
});

describe("a stroke that leaves the shape at once", () => {
  it("is refused, and the limb it began on has a stroke of its own", () => {
    const tip = pixel(0, 0.95);
    const away = Array.from({ length: 40 }, (_, i) => [tip[0] + 10 * i, tip[1]]);
    expect(() => make({ reference: away })).toThrow(
      /^reference leaves the shape after \d+ % of its length; expected a stroke along a limb/,
    );
    const stroke = pliant.limbStroke(shape, { camera, pixel: tip });
    expect(stroke.at(-1)![1]).toBeLessThan(stroke[0][1] - 100);
    expect(Math.max(...stroke.map(([x]) => Math.abs(x - tip[0])))).toBeLessThan(5);
    expect(make({ reference: stroke }).labels()[n - 1]).toBeGreaterThan(0);
    expect(() => pliant.limbStroke(shape, { camera, pixel: [5, 5] })).toThrow(/^pixel lies beside the shape/);
    expect(() => pliant.limbStroke(shape, { camera, pixel: [5, Number.NaN] })).toThrow(/^pixel/);
  });
});

describe("a bend", () => {
  it("that goes where the reference is changes nothing", () => {
    const sketch = make();
    sketch.bend(straight);
    expect(difference(doubles(sketch), mesh.positions) / shape.diagonal).toBeLessThan(1e-6);
  });

  it.each([false, true])("is that of the paper (eq. 5 and 6), smooth: %s", (smooth) => {
    const sketch = make({ smooth });
    sketch.bend(arc);
    const [state, positions] = [sketch.state(), doubles(sketch)];
    let moved = 0;
    for (let v = 0; v < n; ++v) {
      const expected = state.labels[v] === 0 ? vertex(mesh.positions, v) : bent(state, v, vertex(mesh.positions, v));
      expect(difference(vertex(positions, v), expected)).toBeLessThan(1e-9);
      moved = Math.max(moved, difference(expected, vertex(mesh.positions, v)));
    }
    expect(moved).toBeGreaterThan(0.3);
  });

  it("turns every vertex as much as the target has turned (eq. 1 to 4)", () => {
    const sketch = make({ smooth: false });
    sketch.bend(arc);
    const { labels, s, angles, normals } = sketch.state();
    const left = Math.sign(dot(cross([0, 0, 1], [-1, 0, 0]), (normals as number[][])[0]));
    for (let v = 0; v < n; ++v) {
      if (labels[v] === 1 && s[v] > 0.05 && s[v] < 0.95) expect(left * angles[v]).toBeCloseTo((s[v] * Math.PI) / 2, 1);
    }
  });

  it("keeps the length of the limb while it is drawn, and can be taken back", () => {
    const sketch = make();
    sketch.bend(arc.slice(0, 30), { unfinished: true });
    const target = sketch.target();
    const length = Array.from({ length: target.length / 3 - 1 }, (_, i) =>
      Math.hypot(...minus(vertex(target, i + 1), vertex(target, i))),
    ).reduce((a, b) => a + b);
    expect(length).toBeCloseTo(0.6, 2);
    sketch.unbend();
    expect(doubles(sketch)).toEqual(mesh.positions);
  });

  it("takes a turning angle over s on top (eq. 8)", () => {
    const sketch = make({ smooth: false });
    sketch.bend(straight);
    sketch.turning([[0, 0.8], [1, 1.8]]);
    const { labels, s, angles } = sketch.state();
    for (let v = 0; v < n; ++v) if (labels[v] === 1) expect(Math.abs(angles[v])).toBeCloseTo(0.8 * s[v], 1);
  });
});

describe("twist and scale", () => {
  const ofRegion = (visit: (v: number, s: number, rest: number[]) => void) => {
    const state = make({ smooth: false }).state();
    for (let v = 0; v < n; ++v) if (state.labels[v] === 1) visit(v, state.s[v], vertex(mesh.positions, v));
  };

  it("turns sections evenly, right-handed about the stroke (eq. 7)", () => {
    const sketch = make({ smooth: false });
    sketch.twist(120);
    const positions = doubles(sketch);
    ofRegion((v, s, rest) =>
      expect(difference(vertex(positions, v), turned(rest, [0, 0, 1], (s * 2 * Math.PI) / 3))).toBeLessThan(1e-6),
    );
    const end = vertex(mesh.positions, n - 3);
    expect(difference(vertex(positions, n - 3), turned(end, [0, 0, 1], (2 * Math.PI) / 3))).toBeLessThan(1e-6);
  });

  it("twists at the speed asked for", () => {
    const sketch = make({ smooth: false });
    sketch.twist(90);
    sketch.twistSpeed([[0, 0], [0.5, 1], [1, 1]]);
    const positions = doubles(sketch);
    ofRegion((v, s, rest) =>
      expect(
        difference(vertex(positions, v), turned(rest, [0, 0, 1], (Math.min(2 * s, 1) * Math.PI) / 2)),
      ).toBeLessThan(1e-6),
    );
  });

  it("scales sections by F(s)", () => {
    const sketch = make({ smooth: false });
    sketch.scale([[0, 1], [0.5, 3], [1, 1]]);
    const positions = doubles(sketch);
    ofRegion((v, s) =>
      expect(Math.hypot(positions[3 * v], positions[3 * v + 1]) / radius).toBeCloseTo(1 + 4 * Math.min(s, 1 - s), 6),
    );
  });
});

describe("a pose", () => {
  it("can be kept, set, and blended", () => {
    const sketch = make();
    sketch.bend(arc);
    sketch.twist(90);
    sketch.scale([[0, 1], [1, 1.5]]);
    const [pose, there] = [sketch.pose(), doubles(sketch)];
    expect(JSON.parse(JSON.stringify(pose))).toEqual(pose);
    sketch.reset();
    expect(doubles(sketch)).toEqual(mesh.positions);
    const rest = sketch.pose();
    expect(rest).toMatchObject({ heading: 0, length: 1 });
    sketch.setPose(pose);
    expect(doubles(sketch)).toEqual(there);
    sketch.morph(0.5);
    const half = doubles(sketch);
    sketch.morph(1);
    sketch.setPose(rest, pose, 0.5);
    expect(difference(doubles(sketch), half)).toBeLessThan(1e-7); // the smoothing solves to a tolerance
  });

  it("morphs by lengths and angles: halfway the limb is as long as at rest", () => {
    const sketch = make({ smooth: false });
    sketch.bend(arc);
    sketch.morph(0.5);
    const ringAt = (j: number) => vertex(doubles(sketch), 24 * j);
    expect(Math.hypot(...minus(ringAt(31), ringAt(30)))).toBeCloseTo(1 / 60, 2);
    sketch.morph(0);
    expect(difference(doubles(sketch), mesh.positions)).toBeLessThan(1e-12);
  });

  it("is mirrored", () => {
    const two = twoLimbs();
    const stroke = curved(0.2, 0.2, 0.6, () => 0);
    const sketch = pliant.sketch(pliant.shape(two), { camera, reference: stroke, mirror: { normal: [2, 0, 0] } });
    sketch.bend(curved(0.2, 0.2, 0.6, () => -1));
    sketch.twist(40);
    const positions = doubles(sketch);
    const places = Array.from({ length: n }, (_, v) => vertex(positions, n + v));
    let moved = 0;
    for (let v = 0; v < n; ++v) {
      const [x, y, z] = vertex(positions, v);
      expect(Math.min(...places.map(([a, b, c]) => Math.hypot(a + x, b - y, c - z)))).toBeLessThan(1e-7);
      moved = Math.max(moved, Math.abs(z - two.positions[3 * v + 2]));
    }
    expect(moved).toBeGreaterThan(0.1);
  });

  it("smooths its parameters, or not", () => {
    const sketch = make();
    sketch.bend(arc);
    const smooth = doubles(sketch);
    sketch.setSmooth(false);
    expect(difference(doubles(sketch), smooth)).toBeGreaterThan(1e-6);
    sketch.setSmooth(true);
    expect(doubles(sketch)).toEqual(smooth);
  });
});

describe("refinement", () => {
  const coarse = limb(12, 13);
  const coarseShape = pliant.shape(coarse);
  const count = coarse.positions.length / 3;
  const refined = () => {
    const sketch = pliant.sketch(coarseShape, { camera, reference: straight });
    sketch.bend(longArc);
    return { sketch, ...sketch.refine() };
  };

  it("adds vertices in the middle of edges, and triangles that close the surface again", () => {
    const { sketch, parents, triangles, triangleParents } = refined();
    expect(sketch.vertices).toBe(count + parents.length / 2);
    expect(parents.length).toBeGreaterThan(20);
    const rest = sketch.restPositions(new Float64Array(3 * sketch.vertices));
    expect(rest.slice(0, 3 * count)).toEqual(coarse.positions);
    for (let i = 0; i < parents.length; i += 2) {
      expect(Math.max(parents[i], parents[i + 1])).toBeLessThan(count + i / 2);
      const middle = vertex(rest, parents[i]).map((x, k) => (x + rest[3 * parents[i + 1] + k]) / 2);
      expect(difference(vertex(rest, count + i / 2), middle)).toBeLessThan(1e-15);
    }
    const edges = new Map<string, number>();
    for (let c = 0; c < triangles.length; ++c) {
      const next = c % 3 === 2 ? c - 2 : c + 1;
      const [a, b] = [triangles[c], triangles[next]];
      edges.set(`${a} ${b}`, (edges.get(`${a} ${b}`) ?? 0) + 1);
      expect(edges.get(`${a} ${b}`)).toBe(1);
    }
    for (const edge of edges.keys()) expect(edges.has(edge.split(" ").reverse().join(" "))).toBe(true);
    expect(triangleParents).toHaveLength(triangles.length / 3);
    triangleParents.forEach((t, i) => expect(t).toBeGreaterThanOrEqual(i > 0 ? triangleParents[i - 1] : 0));
  });

  it("gives as many results as vertices, follows later poses, and can be taken back", () => {
    const { sketch, parents } = refined();
    const all = 3 * sketch.vertices;
    for (const result of [sketch.positions(), sketch.normals(), sketch.restPositions()]) {
      expect(result).toHaveLength(all);
    }
    expect(sketch.parameters()).toHaveLength(sketch.vertices);
    sketch.twist(60);
    sketch.reset();
    expect(doubles(sketch)).toEqual(sketch.restPositions(new Float64Array(all)));
    const { rest, parents: rows } = sketch.state() as unknown as { rest: number[][]; parents: number[][] };
    expect(rows.flat()).toEqual(Array.from(parents));
    expect(rest).toHaveLength(parents.length / 2);
    sketch.unrefine();
    expect(sketch.refinement).toBeUndefined();
    expect(sketch.positions()).toHaveLength(3 * count);
  });
});

describe("a seed", () => {
  it("holds what is static, moves what is rigid, and lets a solver finish", async () => {
    const sketch = make();
    sketch.bend(arc);
    const [labels, positions] = [sketch.labels(), doubles(sketch)];
    const { fixed, vertices, targets } = sketch.seed({ spacing: 0.1 });
    expect(Array.from(fixed)).toEqual(Array.from(labels.keys()).filter((v) => labels[v] === 0));
    expect(Array.from(labels.keys()).filter((v) => labels[v] >= 2).every((v) => vertices.includes(v))).toBe(true);
    const spread = Array.from(vertices).filter((v) => labels[v] === 1);
    expect(spread.length).toBeGreaterThan(4);
    spread.forEach((a, i) =>
      spread
        .slice(i + 1)
        .forEach((b) =>
          expect(Math.hypot(...minus(vertex(mesh.positions, a), vertex(mesh.positions, b)))).toBeGreaterThan(
            0.1 * shape.diagonal * (1 - 1e-9),
          ),
        ),
    );
    vertices.forEach((v, i) => expect(vertex(targets, i)).toEqual(vertex(positions, v)));
    const deformer = pliant.deformer(shape, { method: "embedded-graph", nodeCount: 80 });
    deformer.setFixed(fixed);
    deformer.addHandle(vertices).moveTo(targets);
    await deformer.solve();
    const solved = deformer.positions();
    for (let v = 0; v < n; ++v) expect(difference(vertex(solved, v), vertex(positions, v))).toBeLessThan(0.05);
  });
});

describe("results", () => {
  it("are copies, in the precision asked for", () => {
    const sketch = make();
    sketch.bend(arc);
    const out = new Float64Array(3 * n);
    expect(sketch.positions(out)).toBe(out);
    expect(sketch.positions()).toEqual(Float32Array.from(out));
    sketch.positions().fill(0);
    expect(sketch.positions()).toEqual(Float32Array.from(out));
    const normals = sketch.normals();
    for (let v = 0; v < n; ++v) expect(Math.hypot(...vertex(normals, v))).toBeCloseTo(1, 5);
    expect(sketch.reference()).toHaveLength(sketch.target().length);
  });

  it("come back from a state, written as JSON too, and a state of another sketch changes nothing", () => {
    const sketch = make();
    sketch.bend(arc);
    sketch.scale([[0, 1], [1, 1.5]]);
    sketch.morph(0.6);
    const [saved, posed] = [JSON.parse(JSON.stringify(sketch.state())), doubles(sketch)];
    expect(saved.pose).toEqual(sketch.pose());
    sketch.reset();
    sketch.restore(saved);
    expect(doubles(sketch)).toEqual(posed);
    const other = make({ reference: curved(0.01, 0.22, 0.55, () => 0.1) });
    expect(() => other.restore(saved)).toThrow(/(labels|reference) of the state/);
    expect(() => sketch.restore({ ...saved, morph: 2 })).toThrow(/no morph from 0 to 1/);
    expect(() => sketch.restore({ ...saved, colour: 2 })).toThrow(/state.colour is not a known field/);
    expect(doubles(sketch)).toEqual(posed);
    expect(() => sketch.transformPoints([0, 0, 0])).toThrow(/moves a surface/);
  });

  it("outlive the shape, and end with dispose", () => {
    const own = pliant.shape(mesh);
    const sketch = pliant.sketch(own, { camera, reference: straight });
    own.dispose();
    sketch.bend(arc);
    expect(sketch.positions()).toHaveLength(3 * n);
    sketch.dispose();
    sketch.dispose();
    expect(() => sketch.positions()).toThrow(/this sketch is disposed/);
  });
});
