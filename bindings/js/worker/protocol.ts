// What the page and its worker say to each other. Objects live in the worker and are known by number.

import type { ErrorCode } from "../boundary/errors.js";
import type { ShapeReport } from "../shape/shape.js";

/** `target` 0 is the library itself. */
export interface Call {
  id: number;
  target: number;
  method: string;
  args: unknown[];
}

export type Request = Call | { abort: number } | { release: number };

export type Reply =
  | { id: number; value: unknown }
  | { id: number; error: { code: ErrorCode | undefined; message: string } }
  | { id: number; progress: unknown };

/** An object made in the worker, and what does not change about it. */
export interface Reference {
  object: number;
  shape?: { report: ShapeReport; dimension: 2 | 3; diagonal: number };
  method?: string;
}

/** Stands for an object of the worker among the arguments of a call. */
export interface Argument {
  object: number;
}

/** Stands for a fresh array to write results to, in double. */
export interface Fresh {
  doubles: number;
}

/** Stands for functions and signals in options: the other side provides its own. */
export const provided = "provided";

/** One end of the line between page and worker, in browsers and in Node alike. */
export interface Port {
  post(message: unknown, transfer: ArrayBuffer[]): void;
  /** Messages are of the types above. */
  listen(receive: (message: any) => void): void;
}
