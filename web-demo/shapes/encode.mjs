// Packs closed triangle meshes for the page; src/shapes/decode.ts is the other end. A packed mesh is
//   { points, triangles, colored, min: [3], step, data }   data: base64 of gzip of the streams, one after another:
//   corners:   for each triangle met by walk.mjs but the first of a component a symbol, as it says;
//   positions: for each point, in the order they are met, x y z in steps of a grid, less what the
//              parallelogram over the edge predicts (in a component's first triangle: the last point);
//   colours:   3 n bytes, r of all points then g then b, each less the last, in 64 levels, modulo 64.
// Numbers are zigzag varints: 7 bits a byte, the top bit says that more follow.
import { gzipSync } from "node:zlib";
import { symbols, walk } from "./walk.mjs";

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

/** Directed edge -> the corner across it. Every edge must have one triangle on either side. */
function cornersAcross(triangles, count) {
  const corners = new Map();
  for (const [a, b, c] of triangles) {
    for (const [x, y, z] of [[a, b, c], [b, c, a], [c, a, b]]) {
      if (corners.has(x * count + y)) throw new Error(`the edge ${x}-${y} has two triangles on one side`);
      corners.set(x * count + y, z);
    }
  }
  const across = (x, y) => {
    const z = corners.get(y * count + x);
    if (z === undefined) throw new Error(`the edge ${x}-${y} has no triangle on its other side`);
    return z;
  };
  return { across, corners };
}

/** Symbols of the third corners, and for each point met its three predictors (x + y - opposite). */
function follow(triangles, count) {
  const { across, corners } = cornersAcross(triangles, count);
  const met = new Map(); // point -> number in the order of meeting
  const predictors = [];
  const stream = [];
  const waiting = triangles.values();
  const meet = (v, predictor) => {
    met.set(v, met.size);
    predictors.push(predictor);
  };
  const first = () => {
    for (const t of waiting) {
      if (met.has(t[0])) continue;
      t.forEach((v, i) => meet(v, i === 0 ? [] : [t[i - 1]]));
      return t;
    }
    throw new Error("there are fewer triangles than expected");
  };
  const third = (x, y, opposite, after, before) => {
    const z = across(x, y);
    if (!met.has(z)) {
      stream.push(symbols.fresh);
      meet(z, [x, y, opposite]);
    } else if (z === after) stream.push(symbols.after);
    else if (z === before) stream.push(symbols.before);
    else stream.push(symbols.known, met.size - met.get(z));
    return z;
  };
  walk(triangles.length, first, third, () => {});
  if (corners.size !== 3 * triangles.length) throw new Error("the mesh is not closed");
  return { order: [...met.keys()], predictors, stream };
}

/** points: [[x, y, z]], triangles: [[a, b, c]], colors: [[r, g, b]] in 0..1 or undefined. */
export function encodeMesh({ points, triangles, colors }) {
  const { order, predictors, stream } = follow(triangles, points.length);
  const min = [0, 1, 2].map((k) => Math.min(...order.map((v) => points[v][k])));
  const size = Math.max(...[0, 1, 2].map((k) => Math.max(...order.map((v) => points[v][k])) - min[k]));
  const step = size / (gridSteps - 1);
  const grid = points.map((p) => p.map((x, k) => Math.round((x - min[k]) / step)));
  const residuals = order.flatMap((v, i) => {
    const [x, y, opposite] = predictors[i];
    return grid[v].map((value, k) => {
      if (x === undefined) return value;
      return value - grid[x][k] - (y === undefined ? 0 : grid[y][k] - grid[opposite][k]);
    });
  });
  const shades = [0, 1, 2].flatMap((k) => {
    const levels = colors ? order.map((v) => Math.round(colors[v][k] * 63)) : [];
    return levels.map((level, i) => (level - (i === 0 ? 0 : levels[i - 1])) & 63);
  });
  const packed = Buffer.concat([varints(stream), varints(residuals), Uint8Array.from(shades)]);
  return {
    points: order.length, triangles: triangles.length, colored: Boolean(colors), min, step,
    data: gzipSync(packed, { level: 9 }).toString("base64"),
  };
}
