// What the page knows about a shape at rest, wherever it came from.

import type { ScriptFollow as Follow, WritableShape } from "pliant/worker";
import type { Options } from "../options.ts";

export interface ShapeData {
  /** Key of the catalog, or "file" for the user's own. */
  id: string;
  name: string;
  /** 3 n coordinates, vertex by vertex; z = 0 throughout where `dimension` is 2. */
  positions: Float32Array;
  /** The same in double, where they come from a file or an earlier step: scripts go on from those. */
  exact?: Float64Array;
  /** 3 m vertex ids; empty: points. */
  triangles: Uint32Array;
  dimension: 2 | 3;
  /** 3 n sRGB bytes. */
  colors?: Uint8Array;
  /** A picture that lies on the shape: 2 n texture coordinates, v up. */
  picture?: PictureOn;
  /** The file it came from, with what refinement made of it: exports keep everything in it but the coordinates. */
  file?: WritableShape;
  /** Small parts that nothing joins to the rest, and what each goes along with; there once it has been shown. */
  loose?: readonly Follow[];
  /** The pose a visitor finds: regions in rest coordinates. */
  start?: StartPose;
  /** Where the camera looks from, a direction; default: from the front, right and above. */
  viewFrom?: readonly [number, number, number];
  /** How far below the middle the camera looks, as a share of the diagonal: it will hang. */
  hangs?: number;
  /** Mirrored gestures are reflected at this x; default: the middle. */
  mirrorAt?: number;
  /** Vertices with no triangle are drawn as dots of this share of the diagonal. */
  dotSize?: number;
}

export interface PictureOn {
  image: TexImageSource & { width: number; height: number };
  uv: Float32Array;
}

export interface StartPose {
  fixed: (p: readonly [number, number, number]) => boolean;
  handles: { name: string; center: readonly [number, number, number]; radius: number }[];
  /** A method that shows it best, with options that are not its defaults. */
  method?: string;
  options?: Options;
  /** Where a first stroke could go, and a second: points in space that the page hints at. */
  strokes?: readonly [reference: Path, target: Path];
}

type Path = readonly (readonly [number, number, number])[];

/** What a file or picture holds: all that a visitor adds comes later. */
export type LoadedShape = Pick<ShapeData, "positions" | "triangles" | "dimension"> & Partial<ShapeData>;

export const vertexCount = (shape: ShapeData): number => shape.positions.length / 3;

export interface Box {
  min: [number, number, number];
  max: [number, number, number];
  center: [number, number, number];
  diagonal: number;
}

export function boundingBox(positions: ArrayLike<number>): Box {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < 3; k++) {
    let [least, most] = [Infinity, -Infinity];
    for (let i = k; i < positions.length; i += 3) {
      const x = positions[i]!;
      if (x < least) least = x;
      if (x > most) most = x;
    }
    [min[k], max[k]] = [least, most];
  }
  const center: [number, number, number] = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
  return { min, max, center, diagonal: Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]) };
}
