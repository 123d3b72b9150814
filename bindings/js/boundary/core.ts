/// <reference lib="esnext.disposable" preserve="true" />
// What every object of the package stands on: the started module, staging memory, and objects in
// WASM memory that know when they are gone.

import { PliantError, type ErrorCode } from "./errors.js";
import { packValues, unpackValues } from "./lists.js";
import type { RawModule, RawNames, RawObject, RawScratch, RawStatus, RawValues } from "./raw.js";

/** Objects that were dropped without dispose(). */
const dropped = new FinalizationRegistry<{ core: Core; raw: RawObject }>(({ core, raw }) => core.free(raw));

/** `Symbol.dispose`, also where the language does not have it yet. */
export const disposeSymbol: typeof Symbol.dispose = Symbol.dispose ?? Symbol.for("Symbol.dispose");

/** A started module. A call that traps ends it: no later call reaches it. */
export class Core {
  #crash: PliantError | undefined;
  readonly #scratch: RawScratch;

  /** `onCrash` is told when the module is of no use any more. */
  constructor(readonly raw: RawModule, readonly onCrash: () => void) {
    this.#scratch = new raw.Scratch();
  }

  /** Staging memory with these numbers in its slots. */
  stage(doubles: ArrayLike<number>, integers: ArrayLike<number> = []): RawScratch {
    fill(this.#scratch, doubles, integers);
    return this.#scratch;
  }

  /** The same for arrays the size of a shape: the memory is given back. */
  stageOnce<T>(doubles: ArrayLike<number>, integers: ArrayLike<number>, use: (scratch: RawScratch) => T): T {
    return this.using(() => new this.raw.Scratch(), (scratch) => {
      fill(scratch, doubles, integers);
      return use(scratch);
    });
  }

  /** Values by name: the names for a call, and the scratch with their numbers. */
  stageValues(values: RawValues): [names: RawNames, scratch: RawScratch] {
    const { names, numbers } = packValues(values);
    return [names, this.stage(numbers)];
  }

  /** Values that a call has staged. */
  stagedValues(stage: (scratch: RawScratch) => RawNames): RawValues {
    const names = stage(this.#scratch);
    return unpackValues(names, (length) => this.#scratch.doubles(length));
  }

  /** Makes an object for one use, and frees it. */
  using<T extends RawObject, R>(make: () => T, use: (raw: T) => R): R {
    const raw = this.call(make);
    try {
      return this.call(() => use(raw));
    } finally {
      this.free(raw);
    }
  }

  /** A call into WASM. Errors: crashed, from the call that trapped on. */
  call<T>(work: () => T): T {
    if (this.#crash) throw this.#crash;
    try {
      return work();
    } catch (error) {
      throw this.#judged(error);
    }
  }

  /** Frees an object; with the module its memory is gone already. */
  free(raw: RawObject): void {
    if (this.#crash) return;
    try {
      raw.delete();
    } catch (error) {
      const judged = this.#judged(error);
      if (judged !== this.#crash) throw judged;
    }
  }

  /** What an error out of a call means: a trap leaves the memory of the module in any state. */
  #judged(error: unknown): unknown {
    if (!isTrap(error) || this.#crash) return this.#crash ?? error;
    const what = error.message === outOfMemory
      ? "the WASM module ran out of memory and has stopped; expected a smaller shape or graph"
      : `the WASM module has stopped (${error.message}), which is a defect of Pliant`;
    this.#crash = new PliantError("crashed", `${what}. Its objects are lost; init() starts another`, { cause: error });
    this.onCrash();
    return this.#crash;
  }
}

/** As bind_scratch.cpp says it. */
const outOfMemory = "out of memory";

/** Whether code of the module was cut off under way, by itself or for want of stack. */
function isTrap(error: unknown): error is Error {
  const noStack = error instanceof Error && /call stack|too much recursion/i.test(error.message);
  return error instanceof WebAssembly.RuntimeError || noStack;
}

function fill(scratch: RawScratch, doubles: ArrayLike<number>, integers: ArrayLike<number>): void {
  put(scratch.doubles(doubles.length), doubles);
  put(scratch.integers(integers.length), integers);
}

/** Fills a view of staging memory, which is empty where memory does not suffice. Errors: too-large. */
export function put(view: Float64Array | Int32Array | Uint8Array, values: ArrayLike<number>): void {
  if (view.length < values.length) {
    throw new PliantError("too-large", `${values.length} numbers do not fit in what is left of WASM memory`);
  }
  view.set(values);
}

/** An object in WASM memory and its life. */
export class Owned<T extends RawObject> {
  #raw: T | undefined;

  /** Takes over `raw`. `owner`: the object of the package that stands for it, called `name` in messages. */
  constructor(readonly core: Core, raw: T, owner: object, readonly name: string) {
    this.#raw = raw;
    dropped.register(owner, { core, raw }, this);
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
    this.core.free(this.#raw);
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
    core.free(raw);
    return accept(status) as never;
  });
}
