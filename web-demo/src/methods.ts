// The table of deformation methods: the page's menus, sliders and scripts are made from it.

/** An option of a method, as the edit script names it: a number on a slider, or a switch. */
export type MethodOption = { key: string; label: string; /** One sentence for the tooltip. */ help: string } &
  ({ min: number; max: number; step: number; value: number } | { value: boolean });

export interface Method {
  id: string;
  label: string;
  help: string;
  options: MethodOption[];
}

export type Options = Readonly<Record<string, number | boolean>>;

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
  },
];

export function methodOf(id: string): Method {
  const method = methods.find((m) => m.id === id);
  if (!method) throw new Error(`There is no method "${id}".`);
  return method;
}

export function defaultOptions(method: Method): Options {
  return Object.fromEntries(method.options.map((o) => [o.key, o.value]));
}

/** The options a shape of so many vertices can take: never more nodes than vertices. */
export function fittingOptions(options: Options, vertices: number): Options {
  if (options["nodeCount"] === undefined) return options;
  const nodeCount = Math.min(Number(options["nodeCount"]), vertices);
  const neighbours = Math.min(Number(options["neighbours"] ?? 4), Math.max(1, nodeCount - 1));
  return { ...options, nodeCount, neighbours };
}
