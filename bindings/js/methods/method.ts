// What a method tells the rest of the package about itself: its options and how it is built. All
// else goes through the one Deformer.

import { fields, type Place } from "../check.js";
import type { Core } from "../core.js";
import type { RawDeformer, RawStatus } from "../raw.js";
import type { Extent } from "../selection.js";
import type { Shape } from "../shape.js";

/** A checked option, whatever it is; `build` knows. */
export type Options = Readonly<Record<string, unknown>>;

/** Reads one option; `extent` is of the shape it is for. */
export type OptionReader = (place: Place, value: unknown, extent: Extent) => unknown;

export interface Method {
  readonly name: string;
  readonly options: Readonly<Record<string, OptionReader>>;
  /** Options that may change while a handle is dragged. */
  readonly live: readonly string[];
  /** What has to hold between options. */
  check(place: Place, options: Options): void;
  /** Builds over a shape. `place`: the options, for errors that only the shape brings out. */
  build(core: Core, raw: RawDeformer, shape: Shape, options: Options, place: Place): RawStatus;
  /** Improves a converged model where it falls short, once, if the options ask for it: whether there is more to solve. */
  refine(raw: RawDeformer, shape: Shape, options: Options): { status: RawStatus; added: number } | undefined;
}

/** Reads the options of a method, and `more` that the caller has beside them. */
export function readOptions(place: Place, value: unknown, method: Method, extent: Extent, more: readonly string[] = []): Options {
  const known = [...Object.keys(method.options), ...more];
  const given = fields(place, value, known, `option of ${method.name}`);
  const read = Object.entries(given)
    .filter(([name, option]) => option !== undefined && !more.includes(name))
    .map(([name, option]) => [name, method.options[name](place.at(name), option, extent)] as const);
  const options: Options = Object.fromEntries(read);
  method.check(place, options);
  return options;
}
