// The deformed shape as OBJ. One that came from an OBJ keeps everything but its coordinates.
import type { ShapeData } from "../shapes/shape.ts";
import { objNumbers, rewriteObj } from "./read_obj.ts";

export function writeObj(shape: ShapeData, positions: Float32Array): string {
  if (shape.objText !== undefined) return rewriteObj(shape.objText, positions);
  const lines: string[] = [];
  for (let v = 0; v < positions.length / 3; v++) lines.push(`v ${objNumbers(positions, v)}`);
  const { uv } = shape.picture ?? {};
  if (uv) for (let v = 0; v < uv.length / 2; v++) lines.push(`vt ${uv[2 * v]} ${uv[2 * v + 1]}`);
  const corner = (v: number) => (uv ? `${v + 1}/${v + 1}` : `${v + 1}`);
  for (let t = 0; t < shape.triangles.length; t += 3) {
    lines.push(`f ${corner(shape.triangles[t]!)} ${corner(shape.triangles[t + 1]!)} ${corner(shape.triangles[t + 2]!)}`);
  }
  return lines.join("\n") + "\n";
}
