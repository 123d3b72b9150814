// Deformation methods as the page shows them: its menus and sliders are made from what the package says
// (`pliant.methods`).
import type { Options, OptionValue, Strokes } from "./options.ts";
import { vertexCount, type ShapeData } from "./shapes/shape.ts";
import type { WorkerPliant } from "pliant/worker";

type MethodInfo = WorkerPliant["methods"][number];
type OptionInfo = MethodInfo["options"][string];

export type { Options, OptionValue, Strokes };

/** A control: a number on a slider, a switch, or one of several. */
type Control =
  /** `log`: the slider is even in the logarithm, its left end is 0. */
  | { min: number; max: number; step: number; log?: true; value: number }
  | { value: boolean }
  | { choices: readonly (readonly [id: string, label: string])[]; value: string };

export type MethodOption = { key: string; label: string; help: string; info: OptionInfo } & Control;

export interface Method extends Omit<MethodInfo, "name" | "title" | "options"> {
  id: string;
  label: string;
  options: MethodOption[];
  /** Options may change while the shape moves; otherwise it starts from rest again. */
  live: boolean;
}

type Kind = {
  control(info: OptionInfo): Control;
  /** What a control says, as the package takes it; left out: as it is. */
  script?(value: OptionValue, options: Options, shape: ShapeData): unknown;
};

const axes: Record<string, readonly number[]> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

function fieldOf(grain: OptionValue, { strokes }: Options): unknown {
  const axis = axes[String(grain)];
  if (axis) return { axis };
  if (grain === "max" || grain === "min") return { curvature: grain };
  return grain === "painted" && (strokes as Strokes).length > 0 ? { strokes } : null;
}

const slider = ({ min, max, step, log }: OptionInfo, value: unknown): Control =>
  ({ min: min!, max: max!, step: step ?? 1, ...(log ? { log } : {}), value: Number(value) });

const inWords = (name: string): string => name.charAt(0).toUpperCase() + name.slice(1).replaceAll("-", " ");

/** How the page shows a type of option; one that is not here has no control. */
const kinds: Record<string, Kind> = {
  number: { control: (info) => slider(info, info.start ?? info.default) },
  integer: { control: (info) => slider(info, info.start ?? info.default) },
  boolean: { control: (info) => ({ value: Boolean(info.default) }) },
  choice: {
    control: (info) => ({
      choices: info.choices!.map((name) => [name, inWords(name)] as const), value: String(info.default),
    }),
  },
  /** How far down. */
  vector: {
    control: (info) => slider(info, 0),
    script: (value, _, { dimension }) => [0, 0 - Number(value), 0].slice(0, dimension),
  },
  field: {
    control: () => ({
      value: "none",
      choices: [
        ["none", "None"], ["x", "Along x"], ["y", "Along y"], ["z", "Along z"], ["max", "Most curved"],
        ["min", "Least curved"], ["painted", "Painted"],
      ],
    }),
    script: fieldOf,
  },
};

/** In the order of menus; there once the package has started. */
export const methods: Method[] = [];

/** Takes what the package says, the first time. */
export function learnMethods(infos: readonly MethodInfo[]): void {
  if (methods.length > 0) return;
  methods.push(
    ...infos.map(({ name, title, options, ...info }) => {
      const shown = Object.entries(options).filter(([, option]) => !option.advanced && kinds[option.type]);
      return {
        ...info,
        id: name,
        label: title,
        help: `${info.help} ${info.paper}.`,
        options: shown.map(([key, option]) => ({
          key, label: option.title, help: option.help, info: option, ...kinds[option.type]!.control(option),
        })),
        live: shown.every(([, { live }]) => live),
      };
    }),
  );
}

export function methodOf(id: string): Method {
  const method = methods.find((m) => m.id === id);
  if (!method) throw new Error(`There is no method "${id}".`);
  return method;
}

const ofType = (method: Method, type: string): MethodOption[] =>
  method.options.filter(({ info }) => info.type === type);

/** Where there is a field, `strokes` holds what is painted of it. */
export function defaultOptions(method: Method): Options {
  const values = Object.fromEntries(method.options.map((o) => [o.key, o.value]));
  return ofType(method, "field").length > 0 ? { ...values, strokes: [] } : values;
}

/** The options as the package takes them, for a shape: no more of anything than there is. */
export function scriptOptions(method: string, options: Options, shape: ShapeData): Record<string, unknown> {
  const values: Record<string, unknown> = {};
  for (const { key, info: { type, limit } } of methodOf(method).options) {
    const { script } = kinds[type]!;
    const value = script ? script(options[key]!, options, shape) : options[key];
    const most = limit === "vertices" ? vertexCount(shape) : limit ? Number(values[limit]) : Infinity;
    values[key] = typeof value === "number" ? Math.min(value, most) : value;
  }
  return values;
}

/** Something pulls that is no handle. */
export const hasLoad = (id: string, options: Options): boolean => {
  const method = methodOf(id);
  return method.loads && ofType(method, "vector").some(({ key }) => Number(options[key]) > 0);
};

/** A direction field is painted with strokes. */
export const isPainting = (id: string, options: Options): boolean =>
  ofType(methodOf(id), "field").some(({ key }) => options[key] === "painted");

/** Loose parts follow what they lie on, unless the method carries all of space; "": a sketch alone. */
export const followOf = (id: string, { loose = [] }: ShapeData): { follow?: NonNullable<ShapeData["loose"]> } =>
  (loose.length === 0 || (id !== "" && methodOf(id).carries) ? {} : { follow: loose });
