// The page's end of the line to a worker: calls as promises.

import { PliantError } from "../boundary/errors.js";
import type { WorkerPort } from "./ports.js";
import { provided, type Reference, type Reply } from "./protocol.js";

interface Pending {
  resolve(value: never): void;
  reject(error: Error): void;
  onProgress: ((progress: never) => void) | undefined;
}

/** Options that stay on this side. */
export interface Local {
  signal?: AbortSignal;
  onProgress?: (progress: never) => void;
}

export class Line {
  readonly #port: WorkerPort;
  readonly #pending = new Map<number, Pending>();
  readonly #dropped = new FinalizationRegistry<number>((object) => this.#port.post({ release: object }, []));
  #last = 0;
  #closed: PliantError | undefined;

  /** `onClose` is told once, when the worker is of no use any more. */
  constructor(port: WorkerPort, readonly onClose: () => void) {
    this.#port = port;
    port.listen((reply: Reply) => this.#receive(reply));
    port.onFailure((reason) => this.close(`the worker stopped: ${reason}`));
    port.busy(false);
  }

  /** Calls a method of an object of the worker. Functions and signals of `local` are honoured. */
  call<T>(target: number, method: string, args: unknown[], local: Local = {}): Promise<T> {
    if (this.#closed) return Promise.reject(this.#closed);
    const { signal, onProgress } = local;
    if (signal?.aborted) return Promise.reject(new PliantError("aborted", "the signal was aborted", { cause: signal.reason }));
    const id = ++this.#last;
    const abort = () => this.#port.post({ abort: id }, []);
    const answer = new Promise<T>((resolve, reject) => {
      this.#pending.set(id, { resolve, reject, onProgress });
      try {
        this.#port.post({ id, target, method, args }, []);
        this.#port.busy(true);
      } catch (error) {
        this.#settle(id);
        reject(new PliantError("invalid-option", `the arguments of ${method} cannot be sent to a worker: ${(error as Error).message}; expected plain data`, { cause: error }));
      }
    });
    if (!signal) return answer;
    signal.addEventListener("abort", abort, { once: true });
    return answer.finally(() => signal.removeEventListener("abort", abort));
  }

  /** Lets the worker forget an object when `holder` is gone. */
  keep(holder: object, { object }: Reference): void {
    this.#dropped.register(holder, object);
  }

  /** Ends the worker; calls under way fail. */
  close(reason: string): void {
    if (this.#closed) return;
    this.#closed = new PliantError("disposed", reason);
    for (const { reject } of this.#pending.values()) reject(this.#closed);
    this.#pending.clear();
    this.#port.terminate();
    this.onClose();
  }

  #receive(reply: Reply): void {
    const pending = this.#pending.get(reply.id);
    if (!pending) return;
    if ("progress" in reply) {
      this.#progress(reply.id, pending, reply.progress);
      return;
    }
    this.#settle(reply.id);
    if ("value" in reply) {
      pending.resolve(reply.value as never);
      return;
    }
    const { code, message } = reply.error;
    pending.reject(code ? new PliantError(code, message) : new Error(message));
  }

  /** A callback that throws ends its call, as it does without a worker. */
  #progress(id: number, { onProgress, reject }: Pending, progress: unknown): void {
    try {
      onProgress?.(progress as never);
    } catch (error) {
      this.#port.post({ abort: id }, []);
      this.#settle(id);
      reject(error as Error);
    }
  }

  #settle(id: number): void {
    this.#pending.delete(id);
    if (this.#pending.size === 0) this.#port.busy(false);
  }
}

/** Options for the other side: what cannot travel is left here. */
export function split(options: unknown): { sent: unknown; local: Local } {
  if (typeof options !== "object" || options === null) return { sent: options, local: {} };
  const { signal, onProgress } = options as Local;
  const sent: Record<string, unknown> = { ...options };
  const local: Local = {};
  if (typeof onProgress === "function") [sent.onProgress, local.onProgress] = [provided, onProgress];
  if (typeof AbortSignal === "function" && signal instanceof AbortSignal) [sent.signal, local.signal] = [provided, signal];
  return { sent, local };
}

