// Errors that a script's values bring out in the library, as errors of the script.

import type { Place } from "../boundary/check.js";
import { PliantError } from "../boundary/errors.js";

const ofValues = ["invalid-option", "invalid-handle", "invalid-shape"];

export function located<T>(place: Place, work: () => T): T {
  try {
    return work();
  } catch (error) {
    throw inScript(place, error);
  }
}

export async function locatedAsync<T>(place: Place, work: () => Promise<T>): Promise<T> {
  try {
    return await work();
  } catch (error) {
    throw inScript(place, error);
  }
}

function inScript(place: Place, error: unknown): unknown {
  if (!(error instanceof PliantError) || !ofValues.includes(error.code)) return error;
  return new PliantError("invalid-script", `${place.path}: ${error.message}`, { cause: error });
}
