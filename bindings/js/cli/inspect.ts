// pliant inspect and pliant compare: what a shape is made of, and what a deformation did to it.

import type { Pliant } from "../pliant.js";
import type { Quality } from "../shape/quality.js";
import { Failure, onFile } from "./failure.js";
import { readShape } from "./shapes.js";
import type { Invocation } from "./usage.js";

export async function inspect(pliant: Pliant, { operands: [path], flags, values }: Invocation): Promise<string> {
  const file = await readShape(path, values);
  const { positions, triangles, dimension, faceOffsets, texcoords, colors } = file;
  const shape = await onFile(path, () => pliant.shape({ positions, triangles, dimension }));
  const bounds = boundsOf(positions, dimension);
  const found = {
    format: file.format, ...shape.report, faces: faceOffsets.length - 1,
    textureCoordinates: texcoords.length > 0, colors: colors.length > 0, diagonal: shape.diagonal, ...bounds,
  };
  return flags.json ? JSON.stringify(found, null, 2) : table(found);
}

function boundsOf(positions: Float64Array, dimension: number): { min: number[]; max: number[] } {
  const min = Array.from({ length: dimension }, () => Infinity);
  const max = Array.from({ length: dimension }, () => -Infinity);
  positions.forEach((x, i) => {
    min[i % dimension] = Math.min(min[i % dimension], x);
    max[i % dimension] = Math.max(max[i % dimension], x);
  });
  return { min, max };
}

export async function compare(
  pliant: Pliant, { operands: [restPath, deformedPath], flags }: Invocation,
): Promise<string> {
  const [rest, deformed] = [await readShape(restPath), await readShape(deformedPath)];
  const [from, to] = [rest, deformed].map((file) => file.positions.length / file.dimension);
  if (from !== to) throw new Failure(`${deformedPath}: has ${to} vertices; expected ${from}, as ${restPath}`);
  if (rest.dimension !== deformed.dimension) {
    const [found, expected] = [deformed.dimension, rest.dimension];
    throw new Failure(`${deformedPath}: has ${found} coordinates a vertex; expected ${expected}, as ${restPath}`);
  }
  const { positions, triangles, dimension } = rest;
  const shape = await onFile(restPath, () => pliant.shape({ positions, triangles, dimension }));
  const quality = await onFile(deformedPath, () => pliant.measure(shape, deformed.positions));
  return flags.json ? JSON.stringify(quality, null, 2) : table(flat(quality));
}

function flat({ stretch, ...others }: Quality): Record<string, unknown> {
  return { "stretch mean": stretch.mean, "stretch p95": stretch.p95, "stretch max": stretch.max, ...others };
}

/** Names in words, one value a line. */
function table(values: Record<string, unknown>): string {
  const rows = Object.entries(values).map(([name, value]) => [
    name.replace(/([A-Z])/g, " $1").toLowerCase(), text(value),
  ]);
  const width = Math.max(...rows.map(([name]) => name.length));
  return rows.map(([name, value]) => `${name.padEnd(width)}  ${value}`).join("\n");
}

function text(value: unknown): string {
  if (Array.isArray(value)) return value.map(text).join(" ");
  if (typeof value === "number") return String(Number(value.toPrecision(6)));
  if (typeof value === "boolean") return value ? "yes" : "no";
  return value === null ? "not defined" : String(value);
}
