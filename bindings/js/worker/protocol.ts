// What the page and its worker say to each other. Objects live in the worker and are known by number. Calls that are
// made together travel in one message, and so do the answers that are there at once: a frame that steps and asks for
// positions and normals costs one message each way.

import { PliantError, type ErrorCode } from "../boundary/errors.js";

/** Names of options that stay on the page; the worker provides its own in their place. */
export type LocalOption = "signal" | "onProgress";

/** `target` 0 is the library itself. */
export interface Call {
  id: number;
  target: number;
  method: string;
  args: unknown[];
  /** Objects of the worker among the arguments: which argument, which object. */
  objects?: [argument: number, object: number][];
  /** Options that the page keeps. */
  local?: LocalOption[];
  /** The results go to a fresh array of so many doubles. */
  doubles?: number;
}

export type Request = Call | { abort: number } | { release: number };

export type Reply =
  | { id: number; value: unknown }
  | { id: number; error: Failure }
  | { id: number; progress: unknown };

/** An object made in the worker, and what does not change about it. */
export interface Reference {
  object: number;
  constants: Record<string, unknown>;
}

/** An error on its way. */
export interface Failure {
  code: ErrorCode | undefined;
  message: string;
  cause?: Failure;
}

export function packError(error: unknown): Failure {
  const code = error instanceof PliantError ? error.code : undefined;
  if (!(error instanceof Error)) return { code, message: String(error) };
  return { code, message: error.message, ...(error.cause === undefined ? {} : { cause: packError(error.cause) }) };
}

/** `reason`: the cause of an abort, which the page knows better. */
export function unpackError({ code, message, cause }: Failure, reason?: unknown): Error {
  const options = code === "aborted" ? { cause: reason } : cause ? { cause: unpackError(cause) } : undefined;
  return code ? new PliantError(code, message, options) : new Error(message, options);
}

/** The memory of typed arrays in a value, up to two levels deep: it moves to the other side instead of being copied. */
export function buffersOf(value: unknown): ArrayBuffer[] {
  const found = new Set<ArrayBuffer>();
  const visit = (item: unknown, levels: number) => {
    if (typeof item !== "object" || item === null) return;
    if (!ArrayBuffer.isView(item)) Object.values(levels > 0 ? item : {}).forEach((inner) => visit(inner, levels - 1));
    else if (item.buffer instanceof ArrayBuffer) found.add(item.buffer);
  };
  visit(value, 2);
  return [...found];
}

/** One end of the line between page and worker, in browsers and in Node alike. */
export interface Port {
  post(message: Request[] | Reply[], transfer: ArrayBuffer[]): void;
  /** Messages are lists of the types above. */
  listen(receive: (message: any) => void): void;
}
