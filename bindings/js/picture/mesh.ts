// A picture as a mesh in the plane: its outline, evenly triangulated.

import Constrainautor from "@kninnug/constrainautor";
import Delaunator from "delaunator";
import { PliantError } from "../boundary/errors.js";
import { type Image, type PicturePlan, readPicture } from "./image.js";
import { cutOut } from "./matte.js";
import { outwardOrder } from "./order.js";
import { areaOf, type Loop, traceOutline } from "./outline.js";
import { Region } from "./region.js";
import { simplified } from "./simplify.js";

/** Vertices that fill a shape whose spacing is left open. */
const fill = 1500;
/** Most of them, whatever the spacing. */
const most = 2_000_000;

export interface PictureMesh {
  /** The picture on it: with what is background made transparent. */
  image: Image;
  /** Two numbers a vertex: pixels from the bottom left corner, y up. Those of the outline come first. */
  positions: Float64Array;
  /** Counterclockwise, from what lies in the middle of the shape to what lies far out. */
  triangles: Uint32Array;
  /** Two a vertex, from 0 to 1 over the picture and a little beyond where it fills its frame; v up. */
  texcoords: Float32Array;
}

/** Errors: invalid-shape, invalid-option, too-large. */
export function meshOf(input: unknown): PictureMesh {
  const plan = readPicture(input);
  const image = cutOut(plan.image, plan.background, plan.backgroundRange);
  const { width, height } = image;
  const traced = visibleParts(traceOutline(image, plan.threshold, plan.margin), plan);
  const area = traced.reduce((sum, loop) => sum + areaOf(loop), 0);
  const spacing = Math.max(plan.spacing ?? Math.sqrt((area / fill) * (2 / Math.sqrt(3))), 1);
  if (area / spacing ** 2 > most)
    throw new PliantError(
      "too-large",
      `spacing is ${spacing}, which would make more than ${most} vertices; expected a larger one`,
    );
  const { positions, triangles } = triangulated(simplified(traced, plan.tolerance, spacing), spacing);
  const texcoords = Float32Array.from(positions, (x, i) => x / (i % 2 ? height : width));
  return { image, positions, triangles: outwardOrder(positions, triangles), texcoords };
}

/** Without specks, and without holes where they are unwanted. Errors: invalid-shape, where nothing is left. */
function visibleParts(loops: readonly Loop[], { speck, holes, threshold, background }: PicturePlan): Loop[] {
  const areas = loops.map(areaOf);
  const outer = loops.filter((_, i) => areas[i] > 0 && areas[i] >= speck);
  if (outer.length === 0) {
    const cause = background === undefined ? `more opaque than alpha ${threshold}` : "unlike the background";
    throw new PliantError(
      "invalid-shape",
      `data shows nothing; expected a part of at least ${Math.ceil(speck)} square pixels ${cause}`,
    );
  }
  const within = new Region(outer, 64);
  const open = loops.filter((loop, i) => holes && -areas[i] >= Math.max(speck, 1) && within.contains(loop[0], loop[1]));
  return [...outer, ...open];
}

/** Errors: invalid-shape. */
function triangulated(loops: readonly Loop[], spacing: number): { positions: Float64Array; triangles: Uint32Array } {
  const region = new Region(loops, spacing);
  const positions = Float64Array.from([...loops.flatMap((loop) => [...loop]), ...interior(loops, region, spacing)]);
  const delaunay = new Delaunator(positions);
  try {
    new Constrainautor(delaunay, sidesOf(loops));
  } catch (error) {
    const cause = (error as Error).message;
    const reason = `data has an outline that cannot be triangulated at a spacing of ${spacing} (${cause})`;
    throw new PliantError("invalid-shape", `${reason}; expected another spacing or tolerance`, { cause: error });
  }
  return { positions, triangles: inner(positions, delaunay.triangles, region) };
}

/** Points of a triangular grid inside, well off the outline. */
function interior(loops: readonly Loop[], region: Region, spacing: number): number[] {
  const [least, top] = [
    [Infinity, Infinity],
    [-Infinity, -Infinity],
  ];
  for (const loop of loops) {
    for (let i = 0; i < loop.length; ++i) {
      least[i % 2] = Math.min(least[i % 2], loop[i]);
      top[i % 2] = Math.max(top[i % 2], loop[i]);
    }
  }
  const points: number[] = [];
  const rise = (spacing * Math.sqrt(3)) / 2;
  for (let row = 1, y = least[1] + rise; y < top[1]; ++row, y += rise) {
    for (let x = least[0] + (row % 2 ? 0.5 : 1) * spacing; x < top[0]; x += spacing) {
      if (region.contains(x, y) && region.clear(x, y, 0.6 * spacing)) points.push(x, y);
    }
  }
  return points;
}

function sidesOf(loops: readonly Loop[]): [number, number][] {
  const sides: [number, number][] = [];
  let first = 0;
  for (const { length } of loops) {
    const count = length / 2;
    for (let i = 0; i < count; ++i) sides.push([first + i, first + ((i + 1) % count)]);
    first += count;
  }
  return sides;
}

/** The triangles within the outline, counterclockwise. */
function inner(positions: Float64Array, triangles: Uint32Array | Int32Array, region: Region): Uint32Array {
  const found: number[] = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = triangles.subarray(t, t + 3);
    const [ax, ay, bx, by, cx, cy] = [a, b, c].flatMap((v) => [positions[2 * v], positions[2 * v + 1]]);
    if (!region.contains((ax + bx + cx) / 3, (ay + by + cy) / 3)) continue;
    const turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (turn > 0) found.push(a, b, c);
    else if (turn < 0) found.push(a, c, b);
  }
  return Uint32Array.from(found);
}
