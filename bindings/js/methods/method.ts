// What a method tells the rest of the package about itself: its options and how it is built. All
// else goes through the one Deformer.

import { type Fields, fields, type Place } from "../boundary/check.js";
import type { Core } from "../boundary/core.js";
import type { RawDeformer, RawStatus } from "../boundary/raw.js";
import type { Extent } from "../shape/selection.js";
import type { Shape } from "../shape/shape.js";

/** A checked option, whatever it is; `build` knows. */
export type Options = Readonly<Record<string, unknown>>;

/** Reads one option; `extent` is of the shape it is for. */
export type OptionReader = (place: Place, value: unknown, extent: Extent) => unknown;

export interface Method {
  readonly name: string;
  readonly options: Readonly<Record<string, OptionReader>>;
  /** Options that may change while a deformer lives. */
  readonly live: readonly string[];
  /** Whether it deforms space, so that other points can be carried. */
  readonly carries: boolean;
  /** What has to hold between options. */
  check(place: Place, options: Options): void;
  /** Builds over a shape. `place`: the options, for errors that only the shape brings out. */
  build(core: Core, raw: RawDeformer, shape: Shape, options: Options, place: Place): RawStatus;
  /** Options after a change; left out: what is given replaces what was. */
  merge?(before: Options, given: Options): Options;
  /** Replaces the options of a built deformer, where some are live. */
  update?(core: Core, raw: RawDeformer, shape: Shape, options: Options, place: Place): RawStatus;
  /** Whether the options alone move the shape, without a handle. */
  load?(options: Options): boolean;
  /** Directions the material has, 3 a vertex. */
  field?(raw: RawDeformer): Float64Array;
  /** Improves a converged model where it falls short, once, if the options ask for it: whether there is more to solve. */
  refine?(raw: RawDeformer, shape: Shape, options: Options): { status: RawStatus; added: number } | undefined;
}

/** Reads the options of a method, and `more` that the caller has beside them. */
export function readOptions(place: Place, value: unknown, method: Method, extent: Extent, more: readonly string[] = []): Options {
  const known = [...Object.keys(method.options), ...more];
  return read(place, fields(place, value, known, `option of ${method.name}`), method, extent, more);
}

/** Reads options for a deformer that is built: only those that may still change. */
export function readLive(place: Place, value: unknown, method: Method, extent: Extent): Options {
  return read(place, fields(place, value, method.live, `option of ${method.name} that may change during a drag`), method, extent, []);
}

function read(place: Place, given: Fields, method: Method, extent: Extent, others: readonly string[]): Options {
  const options: Options = Object.fromEntries(Object.entries(given)
    .filter(([name, option]) => option !== undefined && !others.includes(name))
    .map(([name, option]) => [name, method.options[name](place.at(name), option, extent)]));
  method.check(place, options);
  return options;
}
