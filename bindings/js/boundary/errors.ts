// Errors of the package: one class, stable codes.

/** The codes of {@link PliantError}; they do not change between versions. What each says stands in docs/errors.md. */
export type ErrorCode =
  | "invalid-shape"
  | "invalid-option"
  | "invalid-handle"
  | "invalid-script"
  | "parse-error"
  | "not-solvable"
  | "too-large"
  | "load-failed"
  | "disposed"
  | "crashed"
  | "aborted";

/** Everything Pliant throws. The message names the argument, its value and what was expected. */
export class PliantError extends Error {
  readonly code: ErrorCode;

  constructor(code: ErrorCode, message: string, options?: ErrorOptions) {
    super(message, options);
    this.name = "PliantError";
    this.code = code;
  }
}
