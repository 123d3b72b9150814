// Long work in slices: between them the event loop turns, progress is told and a signal is heeded.

import { eventLoopTurn, throwIfAborted } from "../boundary/task.js";
import type { ReadOptions } from "./shape_file.js";

/** To be awaited between pieces of work, with how much is done. Errors: aborted. */
export type Pause = (fraction: number) => Promise<void>;

/** Milliseconds of work between two turns of the event loop: less than a frame of the screen. */
const slice = 12;

export function pauses({ signal, onProgress }: ReadOptions): Pause {
  let begun = performance.now();
  return async (fraction) => {
    if (performance.now() - begun < slice) return;
    onProgress?.({ fraction });
    await eventLoopTurn();
    throwIfAborted(signal);
    begun = performance.now();
  };
}
