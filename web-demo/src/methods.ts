// The table of deformation methods: the page's menus, sliders and scripts are made from it.
import type { Options, OptionValue, Strokes } from "./options.ts";
import { vertexCount, type ShapeData } from "./shapes/shape.ts";

export type { Options, OptionValue, Strokes };

/** A control: a number on a slider, a switch, or one of several. */
export type MethodOption = {
  key: string;
  label: string;
  /** One sentence for the tooltip. */
  help: string;
} & (
  /** `log`: the slider is even in the logarithm, its left end is 0. */
  | { min: number; max: number; step: number; log?: true; value: number }
  | { value: boolean }
  | { choices: readonly (readonly [id: string, label: string])[]; value: string }
);

export interface Method {
  id: string;
  label: string;
  help: string;
  options: MethodOption[];
  /** Options may change while the shape moves; otherwise it starts from rest again. */
  live?: true;
  /** Options of the package, where they are not the controls by the same names. */
  script?(options: Options, shape: ShapeData): Record<string, unknown>;
}

/** Never more nodes than vertices. */
function graphOptions(options: Options, shape: ShapeData) {
  const nodeCount = Math.min(Number(options["nodeCount"]), vertexCount(shape));
  return { ...options, nodeCount, neighbours: Math.min(Number(options["neighbours"]), Math.max(1, nodeCount - 1)) };
}

const axes: Record<string, readonly number[]> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

function fieldOf(grain: string, strokes: Strokes) {
  if (axes[grain]) return { field: { axis: axes[grain] } };
  if (grain === "max" || grain === "min") return { field: { curvature: grain } };
  return { field: grain === "painted" && strokes.length > 0 ? { strokes } : null };
}

function materialOptions({ stretch, bend, pStretch, pBend, gravity, grain, strokes }: Options, shape: ShapeData) {
  const pull = [0, 0 - Number(gravity), 0].slice(0, shape.dimension);
  return { stretch, bend, pStretch, pBend, gravity: pull, ...fieldOf(String(grain), strokes as Strokes) };
}

export const methods: readonly Method[] = [
  {
    id: "embedded-graph",
    label: "Embedded graph",
    help: "A coarse graph of rotating nodes carries the shape (Sumner, Schmid and Pauly 2007).",
    options: [
      { key: "nodeCount", label: "Nodes", help: "How many nodes carry the shape: more follow finer bends.", min: 20, max: 800, step: 10, value: 250 },
      { key: "neighbours", label: "Blend", help: "How many nodes carry each point: more blend more softly.", min: 2, max: 10, step: 1, value: 4 },
      { key: "regularizationWeight", label: "Smoothness", help: "How much neighbouring nodes agree.", min: 1, max: 50, step: 1, value: 10 },
      { key: "rotationWeight", label: "Rigidity", help: "How much each node keeps to a rotation.", min: 0.1, max: 10, step: 0.1, value: 1 },
      { key: "exactHandles", label: "Exact handles", help: "Handles reach their targets exactly, not only nearly.", value: false },
    ],
    script: graphOptions,
  },
  {
    id: "arap",
    label: "As rigid as possible",
    help: "Every vertex turns with its neighbours (Sorkine and Alexa 2007).",
    live: true,
    options: [
      { key: "energy", label: "Energy", help: "Which edges one rotation has to fit.", choices: [["spokes", "Spokes"], ["spokes-and-rims", "Spokes and rims"]], value: "spokes" },
      { key: "smoothness", label: "Smoothness", help: "Keeps bending away from small places: no spike under a small handle.", min: 0, max: 0.3, step: 0.01, value: 0.05 },
    ],
  },
  {
    id: "edge-material",
    label: "Material edges",
    help: "Edges that resist stretching and bending, each as stiff as you like: cloth, rubber, wood.",
    live: true,
    options: [
      { key: "stretch", label: "Stretch", help: "Stiffness against stretching.", min: 0.01, max: 1000, step: 0.1, log: true, value: 1 },
      { key: "bend", label: "Bend", help: "Stiffness against bending.", min: 0.01, max: 100, step: 0.1, log: true, value: 1 },
      { key: "pStretch", label: "Stretch now", help: "The part of the stretch stiffness that acts.", min: 0, max: 1, step: 0.05, value: 1 },
      { key: "pBend", label: "Bend now", help: "The part of the bend stiffness that acts.", min: 0, max: 1, step: 0.05, value: 1 },
      { key: "gravity", label: "Gravity", help: "Pulls everything down that is not fixed.", min: 0, max: 3, step: 0.05, value: 0 },
      {
        key: "grain", label: "Grain", help: "The direction in which it is stiff, as in wood or woven cloth.", value: "none",
        choices: [["none", "None"], ["x", "Along x"], ["y", "Along y"], ["z", "Along z"], ["max", "Most curved"], ["min", "Least curved"], ["painted", "Painted"]],
      },
    ],
    script: materialOptions,
  },
];

export function methodOf(id: string): Method {
  const method = methods.find((m) => m.id === id);
  if (!method) throw new Error(`There is no method "${id}".`);
  return method;
}

export function defaultOptions(method: Method): Options {
  const values = Object.fromEntries(method.options.map((o) => [o.key, o.value]));
  return method.id === "edge-material" ? { ...values, strokes: [] } : values;
}

/** The options as the package takes them, for a shape. */
export function scriptOptions(method: string, options: Options, shape: ShapeData): Record<string, unknown> {
  return methodOf(method).script?.(options, shape) ?? { ...options };
}

/** Something pulls that is no handle. */
export const hasLoad = (method: string, options: Options): boolean =>
  method === "edge-material" && Number(options["gravity"]) > 0;

/** A direction field is painted with strokes. */
export const isPainting = (method: string, options: Options): boolean =>
  method === "edge-material" && options["grain"] === "painted";
