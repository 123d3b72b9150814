// Unpacks the meshes made by build-shapes.mjs; web-demo/shapes/encode.mjs describes the format.
import { symbols, walk } from "../../shapes/walk.mjs";

export interface PackedMesh {
  points: number;
  triangles: number;
  colored: boolean;
  min: number[];
  step: number;
  data: string;
}

export interface PlainMesh {
  positions: Float32Array;
  triangles: Uint32Array;
  colors?: Uint8Array;
}

async function gunzip(base64: string): Promise<Uint8Array> {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Reads zigzag varints one after another. */
class Reader {
  private at = 0;
  constructor(private readonly bytes: Uint8Array) {}
  number(): number {
    let z = 0;
    let scale = 1;
    for (let b = 128; b > 127; scale *= 128) {
      b = this.bytes[this.at++]!;
      z += (b & 127) * scale;
    }
    return z % 2 === 1 ? -(z + 1) / 2 : z / 2;
  }
  byte(): number {
    return this.bytes[this.at++]!;
  }
}

/** Triangles and, on a grid, positions: both follow the walk. */
function readSurface(reader: Reader, { points, triangles: count }: PackedMesh) {
  const triangles: number[] = [];
  const predictors: number[][] = [];
  const meet = (predictor: number[]): number => predictors.push(predictor) - 1;
  const first = (): [number, number, number] => {
    const a = meet([]);
    return [a, meet([a]), meet([a + 1])];
  };
  const across = (x: number, y: number, opposite: number, after: number, before: number): number => {
    switch (reader.number()) {
      case symbols.fresh: return meet([x, y, opposite]);
      case symbols.after: return after;
      case symbols.before: return before;
      default: return predictors.length - reader.number();
    }
  };
  walk(count, first, across, (a, b, c) => triangles.push(a, b, c));
  const grid = new Int32Array(3 * points);
  predictors.forEach(([x, y, opposite], v) => {
    for (let k = 0; k < 3; k++) {
      let predicted = x === undefined ? 0 : grid[3 * x + k]!;
      if (y !== undefined) predicted += grid[3 * y + k]! - grid[3 * opposite! + k]!;
      grid[3 * v + k] = predicted + reader.number();
    }
  });
  return { triangles: Uint32Array.from(triangles), grid };
}

export async function decodeMesh(packed: PackedMesh): Promise<PlainMesh> {
  const reader = new Reader(await gunzip(packed.data));
  const { triangles, grid } = readSurface(reader, packed);
  const positions = Float32Array.from(grid, (steps, i) => packed.min[i % 3]! + packed.step * steps);
  if (!packed.colored) return { positions, triangles };
  const colors = new Uint8Array(3 * packed.points);
  for (let k = 0; k < 3; k++) {
    for (let v = 0, level = 0; v < packed.points; v++) {
      level = (level + reader.byte()) & 63;
      colors[3 * v + k] = Math.round((level * 255) / 63);
    }
  }
  return { positions, triangles, colors };
}
