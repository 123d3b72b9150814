// OBJ: vertices in the file's order, polygons as fans. The text is kept for the export.
import type { ShapeData } from "../shapes/shape.ts";

export type Loaded = Pick<ShapeData, "positions" | "triangles" | "colors" | "picture" | "objText">;

/** Corner "7/1/3" or "-2" -> vertex id. */
function vertexId(corner: string, count: number, line: number): number {
  const index = parseInt(corner, 10);
  const id = index < 0 ? count + index : index - 1;
  if (!Number.isInteger(id) || id < 0 || id >= count) {
    throw new Error(`line ${line}: the face names vertex "${corner}", but ${count} vertices stand before it`);
  }
  return id;
}

export function readObj(text: string): Loaded {
  const positions: number[] = [];
  const triangles: number[] = [];
  text.split("\n").forEach((content, i) => {
    const [keyword, ...rest] = content.trim().split(/\s+/);
    if (keyword === "v") {
      const point = rest.slice(0, 3).map(Number);
      if (point.length < 3 || !point.every(Number.isFinite)) throw new Error(`line ${i + 1}: "${content.trim()}" is not a vertex`);
      positions.push(...point);
    } else if (keyword === "f") {
      const ids = rest.map((corner) => vertexId(corner, positions.length / 3, i + 1));
      for (let k = 1; k + 1 < ids.length; k++) triangles.push(ids[0]!, ids[k]!, ids[k + 1]!);
    }
  });
  return { positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles), objText: text };
}

/** The same OBJ with other coordinates: every line but the vertices stays as it is. */
export function rewriteObj(text: string, positions: Float32Array): string {
  let v = 0;
  return text.replace(/^([ \t]*v[ \t]+)\S+[ \t]+\S+[ \t]+[^\s]+/gm, (_, keyword: string) => keyword + objNumbers(positions, v++));
}

/** Three single-precision numbers, each as short as it can be without loss. */
export const objNumbers = (positions: Float32Array, v: number): string =>
  [0, 1, 2].map((k) => shortest(positions[3 * v + k]!)).join(" ");

function shortest(single: number): string {
  for (let digits = 6; digits < 9; digits++) {
    const rounded = Number(single.toPrecision(digits));
    if (Math.fround(rounded) === single) return String(rounded);
  }
  return String(Number(single.toPrecision(9)));
}
