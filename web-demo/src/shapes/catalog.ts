// The table of shapes a visitor can choose from.
import { shapes } from "#shapes";
import { bumpyPlane } from "./bumpy_plane.ts";
import { decodeMesh } from "./decode.ts";
import { cloth, tube } from "./sheets.ts";
import { gingerbread } from "./gingerbread.ts";
import { puppet } from "./puppet.ts";
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
    id: "creature", name: "Pip", dimension: 3, ...mesh, viewFrom: [0.42, 0.22, 1], mirrorAt: 0,
    start: {
      strokes: [
        [[-0.34, 1.04, 0.14], [-0.56, 0.98, 0.16], [-0.82, 1.05, 0.22], [-1.06, 1.14, 0.24]],
        [[-0.34, 1.04, 0.14], [-0.62, 1, 0.16], [-0.85, 1.12, 0.2], [-0.98, 1.42, 0.24]],
      ],
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

/** The bunny once more, of a material that its own weight bends. */
async function rubber(): Promise<ShapeData> {
  const shape = await bunny();
  return {
    ...shape,
    id: "rubber",
    name: "Rubber",
    start: { ...shape.start!, method: "edge-material", options: { stretch: 20, bend: 0.3, gravity: 0.3 } },
  };
}

export const catalog: CatalogEntry[] = [
  { id: "creature", name: "Pip", make: creature },
  { id: "bunny", name: "Bunny", make: bunny },
  { id: "plane", name: "Sheet", make: async () => bumpyPlane() },
  { id: "tree", name: "Tree", make: async () => tree() },
  { id: "cloth", name: "Cloth", make: async () => cloth() },
  { id: "tube", name: "Tube", make: async () => tube() },
  { id: "rubber", name: "Rubber", make: rubber },
  { id: "gingerbread", name: "Gingerbread", make: gingerbread },
  { id: "puppet", name: "Scout", make: puppet },
];

export const entryOf = (id: string): CatalogEntry => catalog.find((entry) => entry.id === id)!;
