// The page's end of the line to a worker: calls as promises.

import { PliantError } from "../boundary/errors.js";
import type { WorkerPort } from "./ports.js";
import { buffersOf, type Call, type Reply, type Request, unpackError } from "./protocol.js";

/** Options that stay on this side. */
export interface Local {
  signal?: AbortSignal;
  onProgress?: (progress: never) => void;
}

interface Pending extends Local {
  resolve(value: never): void;
  reject(error: Error): void;
}

export class Line {
  readonly #port: WorkerPort;
  readonly #pending = new Map<number, Pending>();
  readonly #dropped = new FinalizationRegistry<number>((object) => this.#post({ release: object }));
  /** What goes with the next message: all that is asked before the page's code comes to rest. */
  #waiting: Request[] = [];
  #last = 0;
  #closed: PliantError | undefined;

  /** `onClose` is told once, when the worker is of no use any more. */
  constructor(port: WorkerPort, readonly onClose: () => void) {
    this.#port = port;
    port.listen((replies: Reply[]) => replies.forEach((reply) => this.#receive(reply)));
    port.onFailure((reason) =>
      this.close(new PliantError("crashed", `the worker stopped: ${reason}; init() starts another`)),
    );
    port.busy(false);
  }

  get closed(): boolean {
    return this.#closed !== undefined;
  }

  /** Calls a method of an object of the worker; arguments are as they are now. */
  call<T>(call: Omit<Call, "id">, local: Local = {}): Promise<T> {
    if (this.#closed) return Promise.reject(this.#closed);
    const { signal } = local;
    if (signal?.aborted) {
      return Promise.reject(new PliantError("aborted", "the signal was aborted", { cause: signal.reason }));
    }
    const id = ++this.#last;
    const sent = { ...call, id, args: ownCopy(call.method, call.args) };
    const answer = new Promise<T>((resolve, reject) => this.#pending.set(id, { ...local, resolve, reject }));
    this.#port.busy(true);
    this.#post(sent);
    if (!signal) return answer;
    const abort = () => this.#post({ abort: id });
    signal.addEventListener("abort", abort, { once: true });
    return answer.finally(() => signal.removeEventListener("abort", abort));
  }

  /** Lets the worker forget an object when `holder` is gone. */
  keep(holder: object, object: number): void {
    this.#dropped.register(holder, object);
  }

  /** Ends the worker; calls under way, and every later one, fail with this error. */
  close(error: PliantError): void {
    if (this.#closed) return;
    this.#closed = error;
    for (const { reject } of this.#pending.values()) reject(error);
    this.#pending.clear();
    this.#port.terminate();
    this.onClose();
  }

  #post(request: Request): void {
    if (this.#waiting.push(request) === 1) queueMicrotask(() => this.#flush());
  }

  #flush(): void {
    const requests = this.#waiting;
    this.#waiting = [];
    if (this.#closed) return;
    const args = requests.flatMap((request) => ("args" in request ? request.args : []));
    this.#port.post(requests, [...new Set(args.flatMap(buffersOf))]);
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
    const error = unpackError(reply.error, pending.signal?.reason);
    pending.reject(error);
    if (error instanceof PliantError && error.code === "crashed") this.close(error);
  }

  /** A callback that throws ends its call, as it does without a worker. */
  #progress(id: number, { onProgress, reject }: Pending, progress: unknown): void {
    try {
      onProgress?.(progress as never);
    } catch (error) {
      this.#post({ abort: id });
      this.#settle(id);
      reject(error as Error);
    }
  }

  #settle(id: number): void {
    this.#pending.delete(id);
    if (this.#pending.size === 0) this.#port.busy(false);
  }
}

/** The caller may change what it handed over before the message leaves. Errors: invalid-option. */
export function ownCopy<T>(method: string, value: T): T {
  try {
    return structuredClone(value);
  } catch (error) {
    const reason = `the arguments of ${method} cannot be sent to a worker: ${(error as Error).message}`;
    throw new PliantError("invalid-option", `${reason}; expected plain data`, { cause: error });
  }
}
