// What every long call shares: a signal that stops it, a callback that is told how far it is, turns of the event loop.

import type { Place } from "./check.js";
import { PliantError } from "./errors.js";

export function readSignal(place: Place, value: unknown): AbortSignal | undefined {
  const fits = value === undefined || (typeof value === "object" && value !== null && "aborted" in value);
  return fits ? (value as AbortSignal | undefined) : place.fail(value, "an AbortSignal");
}

export function readCallback<T>(place: Place, value: unknown): T | undefined {
  return value === undefined || typeof value === "function"
    ? (value as T | undefined)
    : place.fail(value, "a function");
}

export function throwIfAborted(signal: AbortSignal | undefined): void {
  if (signal?.aborted) throw new PliantError("aborted", "the signal was aborted", { cause: signal.reason });
}

/** Lets timers, messages and input in. A message, where there is one, is not delayed as timers are. */
export function eventLoopTurn(): Promise<void> {
  return new Promise((resolve) => {
    if (typeof setImmediate === "function") {
      setImmediate(resolve);
      return;
    }
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(null);
  });
}
