/// <reference lib="esnext.disposable" preserve="true" />
// What every object of the package stands on: the started module, staging memory, and objects in
// WASM memory that know when they are gone.

import { PliantError, type ErrorCode } from "./errors.js";
import type { RawModule, RawObject, RawScratch, RawStatus } from "./raw.js";

/** Objects that were dropped without dispose(). */
const dropped = new FinalizationRegistry<RawObject>((raw) => raw.delete());

/** `Symbol.dispose`, also where the language does not have it yet. */
export const disposeSymbol: typeof Symbol.dispose = Symbol.dispose ?? Symbol.for("Symbol.dispose");

/** A started module. */
export class Core {
  #trapped: PliantError | undefined;
  readonly #scratch: RawScratch;

  /** `onTrap` is told when the module is of no use any more. */
  constructor(readonly raw: RawModule, readonly onTrap: () => void) {
    this.#scratch = new raw.Scratch();
  }

  /** Staging memory with these numbers in its slots. */
  stage(doubles: ArrayLike<number>, integers: ArrayLike<number> = []): RawScratch {
    fill(this.#scratch, doubles, integers);
    return this.#scratch;
  }

  /** The same for arrays the size of a shape: the memory is given back. */
  stageOnce<T>(doubles: ArrayLike<number>, integers: ArrayLike<number>, use: (scratch: RawScratch) => T): T {
    return this.call(() => {
      const scratch = new this.raw.Scratch();
      try {
        fill(scratch, doubles, integers);
        return use(scratch);
      } finally {
        scratch.delete();
      }
    });
  }

  /** A call into WASM. A trap means that memory ran out; the module is then of no use any more. */
  call<T>(work: () => T): T {
    if (this.#trapped) throw this.#trapped;
    try {
      return work();
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      const message = `the WASM module stopped (${error.message}), most likely out of memory; expected a smaller shape or graph. init() starts anew`;
      this.#trapped = new PliantError("too-large", message, { cause: error });
      this.onTrap();
      throw this.#trapped;
    }
  }
}

function fill(scratch: RawScratch, doubles: ArrayLike<number>, integers: ArrayLike<number>): void {
  put(scratch.doubles(doubles.length), doubles);
  put(scratch.integers(integers.length), integers);
}

/** Fills a view of staging memory, which is empty where memory does not suffice. Errors: too-large. */
export function put(view: Float64Array | Int32Array | Uint8Array, values: ArrayLike<number>): void {
  if (view.length < values.length) throw new PliantError("too-large", `${values.length} numbers do not fit in what is left of WASM memory`);
  view.set(values);
}

/** An object in WASM memory and its life. */
export class Owned<T extends RawObject> {
  #raw: T | undefined;

  /** Takes over `raw`. `owner`: the object of the package that stands for it, called `name` in messages. */
  constructor(readonly core: Core, raw: T, owner: object, readonly name: string) {
    this.#raw = raw;
    dropped.register(owner, raw, this);
  }

  /** A call on the object. Errors: disposed. */
  call<R>(work: (raw: T) => R): R {
    const raw = this.#raw;
    if (!raw) throw new PliantError("disposed", `this ${this.name} is disposed; expected a live one`);
    return this.core.call(() => work(raw));
  }

  /** A call that answers with a status. */
  accept(work: (raw: T) => RawStatus): void {
    accept(this.call(work));
  }

  dispose(): void {
    if (!this.#raw) return;
    dropped.unregister(this);
    this.#raw.delete();
    this.#raw = undefined;
  }
}

/** Throws what a status says. */
export function accept(status: RawStatus): void {
  if (status.code !== "ok") throw new PliantError(status.code as ErrorCode, status.message);
}

/** Builds a raw object in steps that may fail; what is half built is freed. */
export function build<T extends RawObject>(core: Core, create: () => T, steps: (raw: T) => RawStatus): T {
  return core.call(() => {
    const raw = create();
    const status = steps(raw);
    if (status.code === "ok") return raw;
    raw.delete();
    return accept(status) as never;
  });
}
