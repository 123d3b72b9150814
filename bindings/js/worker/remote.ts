// An object of pliant/worker, seen from the page.

import { type FloatArray, output, Place, vertexIds } from "../boundary/check.js";
import { type Line, type Local, ownCopy } from "./line.js";
import { patchOf } from "./patch.js";
import type { Call, LocalOption, Reference } from "./protocol.js";
import type { Travel } from "./surface.js";

/** What an object came from: the object that was asked, and what it was asked for. */
export interface Origin {
  asked: Remote;
  args: readonly unknown[];
}

/** An object that lives in the worker. */
export class Remote {
  readonly #line: Line;
  readonly #object: number;
  #ended = false;
  /** What the worker was given last, of what changes little. */
  #given: unknown;

  /** @internal */
  constructor(line: Line, { object, constants }: Reference) {
    this.#line = line;
    this.#object = object;
    if (object !== 0) line.keep(this, object);
    for (const [name, value] of Object.entries(constants)) {
      Object.defineProperty(this, name, { ...constant(value), enumerable: true });
    }
  }

  /** Whether it has been disposed of or removed from this side. @internal */
  get ended(): boolean {
    return this.#ended;
  }

  /** @internal */
  get line(): Line {
    return this.#line;
  }

  /** A call as its row of the table says; `make` turns what it gives into an object of this side. @internal */
  async send(
    method: string, travel: Travel, args: readonly unknown[], make: (reference: Reference) => Remote,
  ): Promise<unknown> {
    // An object in a worker that is gone is gone too.
    if (travel.ends && this.#line.closed) return undefined;
    const { call, local, out } = this.#pack(method, travel, args);
    const value = this.received(method, await this.#line.call(call, local));
    if (travel.ends) this.#ended = true;
    if (travel.gives) return make(value as Reference);
    return travel.into !== undefined && out !== undefined ? written(out, value as FloatArray) : value;
  }

  /** What an answer is on this side. @internal */
  protected received(_method: string, value: unknown): unknown {
    return value;
  }

  #pack(method: string, { options, into, ids, changes }: Travel, given: readonly unknown[]) {
    const args = [...given];
    const call: Omit<Call, "id"> = { target: this.#object, method, args };
    if (changes !== undefined) {
      const given = args[changes];
      args[changes] = ownCopy(method, patchOf(this.#given, given));
      this.#given = given;
    }
    if (ids) args[0] = this.#ids(ids, args[0]);
    const out = into === undefined ? undefined : args.splice(into)[0];
    if (out instanceof Float64Array) call.doubles = out.length;
    const local: Local = {};
    if (options !== undefined) [args[options], call.local] = split(args[options], local);
    call.objects = args.flatMap((arg, i) => (arg instanceof Remote ? [[i, arg.#object]] : []));
    for (const [i] of call.objects) args[i] = undefined;
    return { call, local, out };
  }

  /** An iterable does not travel. Errors: invalid-handle. */
  #ids(name: string, vertices: unknown): Int32Array {
    const { shape } = this as { shape?: { report: { vertices: number } } };
    return vertexIds(new Place("invalid-handle", name), vertices, shape!.report.vertices);
  }
}

/** A value that no caller can change: of arrays, and what holds them, each reader gets a copy. */
function constant(value: unknown): PropertyDescriptor {
  const holds = ArrayBuffer.isView(value) || (value instanceof Object && Object.values(value).some(ArrayBuffer.isView));
  return holds ? { get: () => structuredClone(value) } : { value: Object.freeze(value) };
}

/** Results in the caller's array. Errors: invalid-option. */
function written(out: unknown, result: FloatArray): FloatArray {
  const own = output(new Place("invalid-option", "out"), out, result.length, () => result);
  own.set(result);
  return own;
}

/** Options without those that cannot travel, which go to `local`, and the names of these. */
function split(options: unknown, local: Local): [unknown, LocalOption[]] {
  if (typeof options !== "object" || options === null) return [options, []];
  const { signal, onProgress, ...rest } = options as Local;
  const sent: Record<string, unknown> = rest;
  if (typeof onProgress === "function") local.onProgress = onProgress;
  else if (onProgress !== undefined) sent.onProgress = onProgress;
  if (typeof AbortSignal === "function" && signal instanceof AbortSignal) local.signal = signal;
  else if (signal !== undefined) sent.signal = signal;
  return [sent, Object.keys(local) as LocalOption[]];
}
