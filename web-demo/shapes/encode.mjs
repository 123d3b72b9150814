// Packs triangle meshes for the page; src/shapes/decode.ts is the other end. A packed mesh is
//   { points, triangles, min: [3], step, data }   data: base64 of gzip of the streams, one after another:
//   triangles: 3 m numbers, (highest vertex so far + 1) - vertex, vertices numbered as they appear;
//   positions: 3 n numbers, x of all points then y then z, as steps of the grid, differences to the last;
//   colours:   3 n bytes, r of all points then g then b, differences modulo 256 (absent: none).
// Numbers are zigzag varints: 7 bits a byte, the top bit says that more follow.
import { gzipSync } from "node:zlib";

const gridSteps = 1 << 13;

function varints(values) {
  const bytes = [];
  for (const v of values) {
    let z = v < 0 ? -2 * v - 1 : 2 * v;
    for (; z > 127; z = Math.floor(z / 128)) bytes.push(128 + (z % 128));
    bytes.push(z);
  }
  return Uint8Array.from(bytes);
}

/** Triangles in an order where neighbours follow each other (depth first over shared edges). */
function walkOrder(triangles) {
  const at = new Map();
  const key = (a, b) => (a < b ? `${a},${b}` : `${b},${a}`);
  triangles.forEach((t, id) => t.forEach((a, i) => {
    const k = key(a, t[(i + 1) % 3]);
    at.set(k, [...(at.get(k) ?? []), id]);
  }));
  const [seen, order] = [new Set(), []];
  for (let start = 0; start < triangles.length; start++) {
    const stack = [start];
    while (stack.length > 0) {
      const id = stack.pop();
      if (seen.has(id)) continue;
      seen.add(id);
      order.push(triangles[id]);
      const t = triangles[id];
      t.forEach((a, i) => stack.push(...at.get(key(a, t[(i + 1) % 3])).filter((n) => !seen.has(n))));
    }
  }
  return order;
}

const deltas = (values) => values.map((v, i) => v - (i === 0 ? 0 : values[i - 1]));

/** points: [[x, y, z]], triangles: [[a, b, c]], colors: [[r, g, b]] in 0..1 or undefined. */
export function encodeMesh({ points, triangles, colors }) {
  const ids = new Map();
  const indices = [];
  for (const t of walkOrder(triangles)) {
    for (const v of t) {
      const next = ids.size;
      if (!ids.has(v)) ids.set(v, next);
      indices.push(next - ids.get(v));
    }
  }
  const order = [...ids.keys()];
  const axes = [0, 1, 2].map((k) => order.map((v) => points[v][k]));
  const min = axes.map((a) => Math.min(...a));
  const step = Math.max(...axes.map((a, k) => Math.max(...a) - min[k])) / (gridSteps - 1);
  const grid = axes.flatMap((a, k) => deltas(a.map((x) => Math.round((x - min[k]) / step))));
  const bytes = colors
    ? [0, 1, 2].flatMap((k) => deltas(order.map((v) => Math.round(colors[v][k] * 255))).map((d) => d & 255))
    : [];
  const packed = Buffer.concat([varints(indices), varints(grid), Uint8Array.from(bytes)]);
  return {
    points: order.length, triangles: triangles.length, colored: Boolean(colors), min, step,
    data: gzipSync(packed, { level: 9 }).toString("base64"),
  };
}
