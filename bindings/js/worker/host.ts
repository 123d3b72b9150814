// The worker's side of pliant/worker: runs the calls and answers. The page says which WASM to take.

import { PliantError } from "../boundary/errors.js";
import { Deformer } from "../deform/deformer.js";
import { Handle } from "../deform/handle.js";
import { makeInit } from "../init.js";
import { Pliant } from "../pliant.js";
import { Shape } from "../shape/shape.js";
import { Sketch } from "../deform/sketch.js";
import { nodeModule } from "../boundary/wasm.js";
import { type Argument, type Call, type Fresh, type Port, provided, type Reference, type Reply, type Request } from "./protocol.js";

const init = makeInit(() => Promise.reject(new Error("none was named")));

/** What a page may call. */
const methods = new Map<Function, readonly string[]>([
  [Pliant, ["shape", "deformer", "sketch", "measure", "edit"]],
  [Shape, ["select", "dispose"]],
  [Deformer, ["setFixed", "addHandle", "setOptions", "step", "solve", "energy", "counters", "positions", "normals",
    "field", "transformPoints", "state", "restore", "reset", "dispose"]],
  [Handle, ["move", "moveTo", "remove"]],
  [Sketch, ["redraw", "bend", "unbend", "twist", "scale", "turning", "twistSpeed", "setSmooth", "morph", "pose", "setPose", "reset",
    "refine", "unrefine", "labels", "parameters", "reference", "target", "positions", "restPositions", "normals", "seed", "state", "dispose"]],
]);

class Host {
  readonly #objects = new Map<number, object>();
  readonly #running = new Map<number, AbortController>();
  #last = 0;

  constructor(readonly port: Port) {}

  receive(request: Request): void {
    if ("abort" in request) this.#running.get(request.abort)?.abort();
    else if ("release" in request) this.#objects.delete(request.release);
    else void this.#answer(request);
  }

  async #answer(call: Call): Promise<void> {
    try {
      const value = await this.#run(call);
      this.#reply({ id: call.id, value: this.#encode(value) }, buffersOf(value));
    } catch (error) {
      const code = error instanceof PliantError ? error.code : undefined;
      this.#reply({ id: call.id, error: { code, message: error instanceof Error ? error.message : String(error) } });
    } finally {
      this.#running.delete(call.id);
    }
  }

  async #run({ id, target, method, args }: Call): Promise<unknown> {
    if (method === "init") {
      this.#objects.set(0, await init(args[0] as Parameters<typeof init>[0]));
      return undefined;
    }
    const object = this.#objects.get(target);
    if (!object) throw new PliantError("disposed", "the object is disposed; expected a live one");
    if (!methods.get(object.constructor)?.includes(method)) throw new Error(`there is no method ${method}`);
    const call = (object as Record<string, (...args: unknown[]) => unknown>)[method];
    return call.apply(object, args.map((arg) => this.#decode(id, arg)));
  }

  #decode(id: number, arg: unknown): unknown {
    if (typeof arg !== "object" || arg === null) return arg;
    if (Object.hasOwn(arg, "object")) return this.#objects.get((arg as Argument).object);
    if (Object.hasOwn(arg, "doubles")) return new Float64Array((arg as Fresh).doubles);
    const options: Record<string, unknown> = { ...arg };
    if (options.onProgress !== provided && options.signal !== provided) return arg;
    if (options.onProgress === provided) options.onProgress = (progress: unknown) => this.#reply({ id, progress });
    if (options.signal === provided) {
      const controller = new AbortController();
      this.#running.set(id, controller);
      options.signal = controller.signal;
    }
    return options;
  }

  #encode(value: unknown): unknown {
    if (value instanceof Shape) {
      const { report, dimension, diagonal } = value;
      return this.#refer(value, { shape: { report, dimension, diagonal } });
    }
    if (value instanceof Deformer) return this.#refer(value, { method: value.method });
    return value instanceof Handle || value instanceof Sketch ? this.#refer(value, {}) : value;
  }

  #refer(object: object, about: Omit<Reference, "object">): Reference {
    this.#objects.set(++this.#last, object);
    return { object: this.#last, ...about };
  }

  #reply(reply: Reply, transfer: ArrayBuffer[] = []): void {
    this.port.post(reply, transfer);
  }
}

/** Result arrays move to the page instead of being copied. */
function buffersOf(value: unknown): ArrayBuffer[] {
  const arrays = ArrayBuffer.isView(value) ? [value] : Object.values((value ?? {}) as object).flat().filter(ArrayBuffer.isView);
  return [...new Set(arrays.map((array) => array.buffer as ArrayBuffer))];
}

/** The line to the page. */
function port(): Port {
  const parent = nodeModule("node:worker_threads")?.parentPort;
  if (parent) {
    return {
      post: (message, transfer) => parent.postMessage(message, transfer),
      listen: (receive) => parent.on("message", receive),
    };
  }
  return {
    post: (message, transfer) => self.postMessage(message, { transfer }),
    listen: (receive) => self.addEventListener("message", ({ data }) => receive(data)),
  };
}

const line = port();
const host = new Host(line);
line.listen((request: Request) => host.receive(request));
