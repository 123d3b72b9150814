// The scout as a puppet: pins in hands, feet, hips and head.
import { pictureShape, pinned } from "../files/picture.ts";
import { inScout, scout } from "./scout.ts";
import type { ShapeData } from "./shape.ts";

/** In the coordinates of the drawing. */
const pins = {
  "right hand": [0.77, 0.2],
  "left hand": [-0.77, 0.2],
  head: [0, 0.55],
  hips: [0, -0.1],
  "right foot": [0.25, -0.82],
  "left foot": [-0.25, -0.82],
} as const;

export async function puppet(): Promise<ShapeData> {
  const handles = Object.entries(pins).map(([name, at]) => ({
    name,
    center: [...inScout(at), 0] as const,
    radius: 22,
  }));
  return { id: "puppet", name: "Scout (2D)", ...(await pictureShape(scout())), start: pinned(handles) };
}
