// What a method tells the rest of the package about itself. All else goes through the one Deformer.

import { type Fields, fields, type Place } from "../boundary/check.js";
import type { RawValues } from "../boundary/raw.js";
import type { StateHatch } from "../boundary/state.js";
import type { Extent } from "../shape/selection.js";
import type { Shape } from "../shape/shape.js";
import type { Option, OptionInfo } from "./option.js";

/** Checked options, whatever they are; those left out are not there. */
export type Options = Readonly<Record<string, unknown>>;

/**
 * What can be drawn of a method over the shape: the `nodes` and `edges` of its state, or the directions of `field()`.
 */
export type Drawn = "graph" | "field";

/** What a method's file declares. */
export interface Declaration {
  readonly name: string;
  readonly title: string;
  /** A word for small menus. */
  readonly short: string;
  readonly paper: string;
  /** A sentence. */
  readonly help: string;
  /** Whether it deforms space, so that other points can be carried. */
  readonly carries: boolean;
  /** Whether curves may move the shape beside handles. */
  readonly curves: boolean;
  readonly draws: readonly Drawn[];
  readonly options: Readonly<Record<string, Option>>;
  /** Options that may change while a deformer lives: all, none, or these. */
  readonly live: boolean | readonly string[];
  /** Options that move the shape by themselves, without a handle, where they are not all 0. */
  readonly loads: readonly string[];
  /** What has to hold between options, beside what stands for what. */
  check?(place: Place, options: Options): void;
  /** Where its state holds words, or fields that are not always of one kind. */
  readonly state?: StateHatch;
}

/** What `pliant.methods` says of a method. */
export interface MethodInfo {
  name: string;
  title: string;
  short: string;
  help: string;
  /** Who it is by, and where. */
  paper: string;
  /** Whether it deforms space: `transformPoints`, `--carry`. */
  carries: boolean;
  /** Whether an option can move the shape without a handle. */
  loads: boolean;
  curves: boolean;
  draws: readonly Drawn[];
  options: Readonly<Record<string, OptionInfo>>;
}

export interface Method extends Omit<Declaration, "live" | "loads"> {
  readonly live: readonly string[];
  readonly info: MethodInfo;
  /** What has to hold between options. */
  check(place: Place, options: Options): void;
  /** Options after a change: what is given replaces what was, and what that stood for. */
  merge(before: Options, given: Options): Options;
  /** Whether the options alone move the shape; left out: they never do. */
  load?(options: Options): boolean;
  /** Checked options as the WASM side takes them. `place`: the options, for errors that only the shape brings out. */
  pack(options: Options, place: Place, shape: Shape): RawValues;
  /** Back, as callers write them. */
  unpack(values: RawValues, dimension: number): Options;
}

/** What callers may write. */
export type OptionsOf<D extends Declaration> = {
  [Name in keyof D["options"]]?: D["options"][Name] extends Option<infer Given> ? Given : never;
};

/** The same of those that are live. */
export type LiveOf<D extends Declaration> =
  D["live"] extends true ? OptionsOf<D> :
  D["live"] extends readonly (infer Name)[] ? Pick<OptionsOf<D>, Name & keyof OptionsOf<D>> :
  Record<string, never>;

/** A method as the package goes by it; the declaration's own types stay. */
export function method<const D extends Declaration>(
  declared: D,
): Omit<Method, "name"> & { readonly name: D["name"]; readonly declared: D } {
  const { options, live, loads } = declared;
  const names = Object.keys(options);
  const isLive = (name: string) => live === true || (live !== false && live.includes(name));
  return {
    ...declared, declared, live: names.filter(isLive), info: infoOf(declared, isLive),

    check(place, given) {
      for (const name of Object.keys(given)) {
        for (const other of options[name].instead) {
          if (other in given) {
            const both = names.filter((candidate) => candidate === name || candidate === other);
            place.reject(`has ${both.join(" and ")}; expected one or the other`);
          }
        }
      }
      declared.check?.(place, given);
    },

    merge(before, given) {
      const taken = new Set(Object.keys(given).flatMap((name) => standIns(options, name)));
      return { ...Object.fromEntries(Object.entries(before).filter(([name]) => !taken.has(name))), ...given };
    },

    ...(loads.length > 0
      ? {
          load: (given: Options) =>
            loads.some((name) => Array.from((given[name] ?? []) as ArrayLike<number>).some((x) => x !== 0)),
        }
      : {}),

    pack(given, place, shape) {
      const packed = Object.entries(given).map(([name, value]) =>
        options[name].pack?.(name, value as never, place.at(name), shape) ?? { [name]: value as RawValues[string] });
      return Object.assign({}, ...packed);
    },

    unpack(values, dimension) {
      const all = names.map((name) => [name, options[name].unpack(name, values, dimension)] as const);
      const given = Object.fromEntries(all.filter(([, value]) => value !== undefined));
      for (const name of Object.keys(given)) for (const other of options[name].instead) delete given[other];
      return given;
    },
  };
}

/** What an option stands for, and what stands for it. */
function standIns(options: Declaration["options"], name: string): string[] {
  return [...options[name].instead, ...Object.keys(options).filter((other) => options[other].instead.includes(name))];
}

function infoOf(
  { name, title, short, help, paper, carries, loads, curves, draws, options }: Declaration,
  isLive: (name: string) => boolean,
): MethodInfo {
  const infos = Object.entries(options).map(([key, { info }]) => [key, Object.freeze({ ...info, live: isLive(key) })]);
  return Object.freeze({
    name, title, short, help, paper, carries, loads: loads.length > 0, curves, draws,
    options: Object.freeze(Object.fromEntries(infos)),
  });
}

/** Reads the options of a method, and `more` that the caller has beside them. */
export function readOptions(
  place: Place, value: unknown, method: Method, extent: Extent, more: readonly string[] = [],
): Options {
  const known = [...Object.keys(method.options), ...more];
  return read(place, fields(place, value, known, `option of ${method.name}`), method, extent, more);
}

/** Reads options for a deformer that is built: only those that may still change. */
export function readLive(place: Place, value: unknown, method: Method, extent: Extent): Options {
  return read(
    place,
    fields(place, value, method.live, `option of ${method.name} that may change during a drag`),
    method,
    extent,
    [],
  );
}

function read(place: Place, given: Fields, method: Method, extent: Extent, others: readonly string[]): Options {
  const options: Options = Object.fromEntries(Object.entries(given)
    .filter(([name, option]) => option !== undefined && !others.includes(name))
    .map(([name, option]) => [name, method.options[name].read(place.at(name), option, extent)]));
  method.check(place, options);
  return options;
}
