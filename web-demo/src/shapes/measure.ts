// The two figures of the readout that need every vertex: stretch and volume, as `pliant compare`
// defines them.
import type { ShapeData } from "./shape.ts";
import { distinctEdges, type Topology } from "./topology.ts";

export interface Measures {
  /** Mean |l'/l - 1| over the edges; undefined for points. */
  stretch?: number;
  /** Signed volume over that at rest; undefined unless closed. */
  volume?: number;
}

function signedVolume(positions: Float32Array, triangles: Uint32Array): number {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t]!, 3 * triangles[t + 1]!, 3 * triangles[t + 2]!];
    const [ax, ay, az] = [positions[a]!, positions[a + 1]!, positions[a + 2]!];
    const [bx, by, bz] = [positions[b]!, positions[b + 1]!, positions[b + 2]!];
    const [cx, cy, cz] = [positions[c]!, positions[c + 1]!, positions[c + 2]!];
    sum += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return sum / 6;
}

/** Measures deformed positions against the rest, again and again. */
export class Meter {
  private readonly edges: Uint32Array;
  private readonly lengths: Float64Array;
  /** At rest; undefined unless closed. */
  readonly volume: number | undefined;

  constructor(private readonly shape: ShapeData, topology: Topology, closed: boolean) {
    this.edges = distinctEdges(shape, topology);
    this.lengths = new Float64Array(this.edges.length / 2);
    for (let e = 0; e < this.lengths.length; e++) this.lengths[e] = this.edgeLength(shape.positions, e);
    const volume = signedVolume(shape.positions, shape.triangles);
    if (closed && volume !== 0) this.volume = volume;
  }

  private edgeLength(p: Float32Array, e: number): number {
    const [a, b] = [3 * this.edges[2 * e]!, 3 * this.edges[2 * e + 1]!];
    const [x, y, z] = [p[a]! - p[b]!, p[a + 1]! - p[b + 1]!, p[a + 2]! - p[b + 2]!];
    return Math.sqrt(x * x + y * y + z * z);
  }

  measure(positions: Float32Array): Measures {
    let [sum, count] = [0, 0];
    for (let e = 0; e < this.lengths.length; e++) {
      if (this.lengths[e] === 0) continue;
      sum += Math.abs(this.edgeLength(positions, e) / this.lengths[e]! - 1);
      count++;
    }
    const measures: Measures = {};
    if (count > 0) measures.stretch = sum / count;
    if (this.volume !== undefined) measures.volume = signedVolume(positions, this.shape.triangles) / this.volume;
    return measures;
  }
}
