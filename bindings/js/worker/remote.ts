// An object of pliant/worker, seen from the page.

import { type FloatArray, output, Place } from "../boundary/check.js";
import { type Line, type Local, split } from "./line.js";
import type { Reference } from "./protocol.js";

/** An object that lives in the worker. */
export class Remote {
  readonly #line: Line;
  readonly #object: number;

  /** @internal */
  constructor(line: Line, reference: Reference) {
    this.#line = line;
    this.#object = reference.object;
    if (reference.object !== 0) line.keep(this, reference);
  }

  /** @internal */
  call<T>(method: string, ...args: unknown[]): Promise<T> {
    return this.#call(method, args);
  }

  /** A call whose last argument holds options with functions or a signal. @internal */
  callWith<T>(method: string, options: unknown, ...args: unknown[]): Promise<T> {
    const { sent, local } = split(options);
    return this.#call(method, [...args, sent], local);
  }

  /** A call whose results go to the caller's array, which stays on this side. @internal */
  async callInto(out: FloatArray | undefined, method: string, ...args: unknown[]): Promise<FloatArray> {
    const fresh = out instanceof Float64Array ? [{ doubles: out.length }] : [];
    const result = await this.call<FloatArray>(method, ...args, ...fresh);
    if (out === undefined) return result;
    output(new Place("invalid-option", "out"), out, result.length, () => out).set(result);
    return out;
  }

  #call<T>(method: string, args: unknown[], local?: Local): Promise<T> {
    const values = args.map((arg) => (arg instanceof Remote ? { object: arg.#object } : arg));
    return this.#line.call(this.#object, method, values, local);
  }

  /** @internal */
  get line(): Line {
    return this.#line;
  }
}
