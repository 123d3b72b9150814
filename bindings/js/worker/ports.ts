// Workers of the platforms, behind one face.

import type { Port } from "./protocol.js";

/** A worker seen from the page. */
export interface WorkerPort extends Port {
  onFailure(tell: (reason: string) => void): void;
  /** Whether calls are under way: an idle worker does not keep Node alive. */
  busy(value: boolean): void;
  terminate(): void;
}

export function webPort(worker: Worker): WorkerPort {
  return {
    post: (message, transfer) => worker.postMessage(message, transfer),
    listen: (receive) => worker.addEventListener("message", ({ data }) => receive(data)),
    onFailure(tell) {
      worker.addEventListener("error", (event) => tell(event.message || "its script could not be loaded"));
      worker.addEventListener("messageerror", () => tell("a message could not be read"));
    },
    busy() {},
    terminate: () => worker.terminate(),
  };
}

/** @internal */
export function nodePort(worker: import("node:worker_threads").Worker): WorkerPort {
  return {
    post: (message, transfer) => worker.postMessage(message, transfer),
    listen: (receive) => worker.on("message", receive),
    onFailure: (tell) => worker.on("error", (error) => tell(error.message)),
    busy: (value) => (value ? worker.ref() : worker.unref()),
    terminate: () => void worker.terminate(),
  };
}
