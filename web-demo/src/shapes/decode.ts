// Unpacks the meshes made by build-shapes.mjs; shapes/encode.mjs describes the format.

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

export async function decodeMesh(packed: PackedMesh): Promise<PlainMesh> {
  const reader = new Reader(await gunzip(packed.data));
  const triangles = new Uint32Array(3 * packed.triangles);
  for (let i = 0, next = 0; i < triangles.length; i++) {
    const id = next - reader.number();
    triangles[i] = id;
    if (id === next) next++;
  }
  const positions = new Float32Array(3 * packed.points);
  for (let k = 0; k < 3; k++) {
    for (let v = 0, grid = 0; v < packed.points; v++) {
      grid += reader.number();
      positions[3 * v + k] = packed.min[k]! + packed.step * grid;
    }
  }
  if (!packed.colored) return { positions, triangles };
  const colors = new Uint8Array(3 * packed.points);
  for (let k = 0; k < 3; k++) {
    for (let v = 0, value = 0; v < packed.points; v++) {
      value = (value + reader.byte()) & 255;
      colors[3 * v + k] = value;
    }
  }
  return { positions, triangles, colors };
}
