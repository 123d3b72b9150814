// The table of shapes a visitor can choose from.
import { shapes } from "#shapes";
import { bumpyPlane } from "./bumpy_plane.ts";
import { decodeMesh } from "./decode.ts";
import { gingerbread } from "./gingerbread.ts";
import type { ShapeData } from "./shape.ts";
import { subdivide } from "./subdivide.ts";
import { tree } from "./tree.ts";

export interface CatalogEntry {
  id: string;
  name: string;
  make(): Promise<ShapeData>;
}

async function creature(): Promise<ShapeData> {
  const mesh = subdivide(await decodeMesh(shapes.creature));
  return {
    id: "creature", name: "Pip", dimension: 3, ...mesh, viewFrom: [0.42, 0.22, 1],
    start: {
      fixed: ([x, y, z]) => y < 0.2 && Math.abs(x) < 0.5 && z > -0.25,
      handles: [{ name: "paw", center: [-0.98, 1.11, 0.14], radius: 0.17 }],
    },
  };
}

async function bunny(): Promise<ShapeData> {
  const mesh = subdivide(subdivide(await decodeMesh(shapes.bunny)));
  return {
    id: "bunny", name: "Bunny (scan)", dimension: 3, ...mesh, viewFrom: [0.1, 0.2, 1],
    start: {
      fixed: ([, y]) => y < 0.9,
      handles: [{ name: "ears", center: [0, 9.1, -1.1], radius: 1.1 }],
    },
  };
}

export const catalog: CatalogEntry[] = [
  { id: "creature", name: "Pip", make: creature },
  { id: "bunny", name: "Bunny", make: bunny },
  { id: "plane", name: "Bumpy sheet", make: async () => bumpyPlane() },
  { id: "tree", name: "Tree", make: async () => tree() },
  { id: "gingerbread", name: "Gingerbread", make: async () => gingerbread() },
];
