// Laws of the page's parts that need no browser.
import { Quaternion, Vector3 } from "three";
import { describe, expect, test } from "vitest";
// @ts-expect-error: a script of the build, without types
import { encodeMesh } from "../../web-demo/shapes/encode.mjs";
// @ts-expect-error: the same
import { remesh } from "../../web-demo/shapes/remesh.mjs";
// @ts-expect-error: the same
import { ball, tube } from "../../web-demo/shapes/parts.mjs";
import { History } from "../../web-demo/src/edit/history.ts";
import {
  asTransform, atRest, motionOf, quaternionOf, rotated, rotationVector, type Vec3,
} from "../../web-demo/src/edit/motion.ts";
import { shared } from "../../bindings/js/edit/same.ts";
import { decodeMesh, type PlainMesh } from "../../web-demo/src/shapes/decode.ts";
import { subdivide } from "../../web-demo/src/shapes/subdivide.ts";

interface Mesh {
  points: number[][];
  triangles: number[][];
}

const flat = ({ points, triangles }: Mesh): PlainMesh =>
  ({ positions: Float32Array.from(points.flat()), triangles: Uint32Array.from(triangles.flat()) });

/** Signed volume; a closed mesh that looks outwards has a positive one. */
function volume({ positions, triangles }: PlainMesh): number {
  const at = (v: number) => new Vector3().fromArray(positions, 3 * v);
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    sum += at(triangles[t]!).dot(at(triangles[t + 1]!).cross(at(triangles[t + 2]!))) / 6;
  }
  return sum;
}

describe("motions", () => {
  test("a handle that is turned further and further counts its turns", () => {
    let motion = atRest;
    for (let i = 0; i < 45; i++) motion = rotated(motion, [0, 0, 1], Math.PI / 18);
    expect(motion.rotation[2]).toBeCloseTo(2.5 * Math.PI, 9);
    expect(asTransform(motion, [1, 2, 3], 3).rotate).toMatchObject({
      degrees: expect.closeTo(450, 6), about: [1, 2, 3],
    });
    for (let i = 0; i < 45; i++) motion = rotated(motion, [0, 0, 1], -Math.PI / 18);
    expect(Math.hypot(...motion.rotation)).toBeLessThan(1e-9);
  });

  test("the library's rigid motion of what stays is none", () => {
    const turn = (axis: number[], degrees: number) => ({ axis, degrees, about: [1, 2, 3] });
    expect(motionOf({ rotate: turn([0, 0, 1], 0), translate: [0, 0, 0] })).toEqual(atRest);
    const { rotation, translate } = motionOf({ rotate: turn([0, 1, 0], 90), translate: [1, 2, 3] });
    expect([rotation, translate]).toEqual([[0, Math.PI / 2, 0], [1, 2, 3]]);
  });

  test("a rotation vector stands for its quaternion", () => {
    for (const near of [[0, 0, 0], [7, 1, -2], [-4, 9, 0]] as Vec3[]) {
      const q = new Quaternion(0.3, -0.5, 0.2, 0.4).normalize();
      expect(Math.abs(quaternionOf(rotationVector(q, near)).dot(q))).toBeCloseTo(1, 12);
    }
  });
});

test("history: what was undone is gone after a new step; equal labels are one step; the oldest are forgotten", () => {
  const history = new History(0, 4);
  [1, 2].forEach((x) => history.push(x));
  expect(history.undo()).toBe(1);
  history.push(3, "nudge");
  history.push(4, "nudge");
  expect([history.canRedo, history.current, history.undo(), history.redo()]).toEqual([false, 4, 1, 4]);
  [5, 6, 7].forEach((x) => history.push(x));
  while (history.canUndo) history.undo();
  expect(history.current).toBe(4);
});

test("states share what has not changed, and only that", () => {
  const before = { nodes: [[1, 2], [3, 4]], handles: [{ targets: [[0]] }], count: 2 };
  const after = shared(before, { nodes: [[1, 2], [3, 5]], handles: [{ targets: [[0]] }], count: 2 });
  expect(after).toEqual({ nodes: [[1, 2], [3, 5]], handles: [{ targets: [[0]] }], count: 2 });
  expect(after.handles).toBe(before.handles);
  expect(after.nodes[0]).toBe(before.nodes[0]);
  expect(after.nodes).not.toBe(before.nodes);
  expect(shared(before, structuredClone(before))).toBe(before);
});

describe("shapes", () => {
  const sphere = (p: number[]) => Math.hypot(...p) - 1;

  test("a packed mesh unpacks to the same one, to half a step of its grid", async () => {
    const mesh: Mesh = ball([1, 2, 3], 0.5, 2);
    const other: Mesh = tube([[0, 0, 0], [1, 0, 0], [2, 1, 0], [3, 1, 0.5]], 0.2, 5);
    const points = [...mesh.points, ...other.points];
    const triangles = [...mesh.triangles, ...other.triangles.map((t) => t.map((v) => v + mesh.points.length))];
    const colors = points.map((_, v) => [v / points.length, 0.5, 1]);
    const packed = encodeMesh({ points, triangles, colors });
    const { positions, triangles: unpacked, colors: shades } = await decodeMesh(packed);
    // The order of points is the packer's: each is found again by its place.
    const source = Array.from({ length: packed.points }, (_, v) => {
      const distances = points.map((p) => Math.max(...p.map((x, k) => Math.abs(x - positions[3 * v + k]!))));
      const nearest = Math.min(...distances);
      expect(nearest).toBeLessThan(0.51 * packed.step);
      return distances.indexOf(nearest);
    });
    const key = (t: number[]) => {
      const first = t.indexOf(Math.min(...t));
      return [...t.slice(first), ...t.slice(0, first)].join();
    };
    const found = Array.from({ length: unpacked.length / 3 }, (_, t) =>
      key([0, 1, 2].map((k) => source[unpacked[3 * t + k]!]!)),
    );
    expect(found.toSorted()).toEqual(triangles.map(key).toSorted());
    expect(new Set(shades!.filter((_, i) => i % 3 === 2))).toEqual(new Set([255]));
  });

  test("an open mesh is not packed", () => {
    expect(() =>
      encodeMesh({ points: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles: [[0, 1, 2]] }),
    ).toThrow("no triangle on its other side");
  });

  test("subdivision keeps a closed mesh closed and a ball round", () => {
    const fine = subdivide(flat(ball([0, 0, 0], 1, 2)));
    expect(fine.positions.length / 3 - fine.triangles.length / 3 / 2).toBe(2); // Euler: V - F / 2 = 2
    for (let v = 0; v < fine.positions.length; v += 3) {
      expect(Math.hypot(fine.positions[v]!, fine.positions[v + 1]!, fine.positions[v + 2]!)).toBeCloseTo(1, 1);
    }
    expect(volume(fine)).toBeGreaterThan(3.8);
    expect(volume(flat(tube([[0, 0, 0], [1, 0, 0], [2, 1, 0], [3, 1, 0.5]], 0.2, 5)))).toBeGreaterThan(0);
  });

  test("remeshing leaves a closed surface of even triangles", () => {
    const coarse: Mesh = ball([0, 0, 0], 1, 2);
    const { points, triangles }: Mesh = remesh(coarse.points, coarse.triangles, sphere, 0.2);
    expect(points.length - triangles.length / 2).toBe(2);
    const lengths = triangles.flatMap((t) =>
      t.map((a, i) => Math.hypot(...points[a]!.map((x, k) => x - points[t[(i + 1) % 3]!]![k]!))),
    );
    expect(Math.min(...lengths)).toBeGreaterThan(0.1);
    expect(Math.max(...lengths)).toBeLessThan(0.3);
    for (const p of points) expect(sphere(p)).toBeCloseTo(0, 6);
  });
});
