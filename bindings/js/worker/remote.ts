// An object of pliant/worker, seen from the page.

import { type Line, split } from "./line.js";
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
    return this.#line.call(this.#object, method, args.map((arg) => (arg instanceof Remote ? { object: arg.#object } : arg)));
  }

  /** A call whose last argument holds options with functions or a signal. @internal */
  callWith<T>(method: string, options: unknown, ...args: unknown[]): Promise<T> {
    const { sent, local } = split(options);
    const values = [...args, sent].map((arg) => (arg instanceof Remote ? { object: arg.#object } : arg));
    return this.#line.call(this.#object, method, values, local);
  }

  /** @internal */
  get line(): Line {
    return this.#line;
  }
}
