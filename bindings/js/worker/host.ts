// The worker's side of pliant/worker: runs the calls and answers. The page says which WASM to take.

import { PliantError } from "../boundary/errors.js";
import { type InitOptions, nodeModule } from "../boundary/wasm.js";
import { Deformer } from "../deform/deformer.js";
import { Handle } from "../deform/handle.js";
import { Sketch } from "../deform/sketch.js";
import { Edit } from "../edit/living.js";
import { makeInit } from "../init.js";
import { Files } from "../io/files.js";
import { IoModule } from "../io/module.js";
import { Picture } from "../picture/picture.js";
import { Pliant } from "../pliant.js";
import { Shape } from "../shape/shape.js";
import { patched, type Patch } from "./patch.js";
import { buffersOf, type Call, packError, type Port, type Reference, type Reply, type Request } from "./protocol.js";
import { type ClassName, rowOf, type Travel } from "./surface.js";

const unnamed = () => Promise.reject(new Error("none was named"));
const init = makeInit(unnamed);

const classes = { Pliant, Shape, Picture, Deformer, Handle, Sketch, Edit, Files } satisfies Record<ClassName, unknown>;
const names = new Map<unknown, ClassName>(Object.entries(classes).map(([name, its]) => [its, name as ClassName]));

type Callable = (...args: unknown[]) => unknown;

class Host {
  readonly #objects = new Map<number, object>();
  /** Values that what is given next is told apart from. */
  readonly #given = new Map<number, unknown>();
  readonly #running = new Map<number, AbortController>();
  #last = 0;

  constructor(readonly port: Port) {}

  /** Answers that take their time follow by themselves; all others go back in one message. */
  receive(requests: readonly Request[]): void {
    const replies: Reply[] = [];
    for (const request of requests) {
      if ("abort" in request) this.#running.get(request.abort)?.abort();
      else if ("release" in request) this.#release(request.release);
      else {
        const reply = this.#answer(request);
        if (reply instanceof Promise) void reply.then((late) => this.#post([late]));
        else replies.push(reply);
      }
    }
    if (replies.length > 0) this.#post(replies);
  }

  #release(object: number): void {
    this.#objects.delete(object);
    this.#given.delete(object);
  }

  #answer(call: Call): Reply | Promise<Reply> {
    const { id } = call;
    const accepted = (value: unknown): Reply => ({ id, value: this.#refer(value) });
    const refused = (error: unknown): Reply => ({ id, error: packError(error) });
    try {
      const value = this.#run(call);
      if (!(value instanceof Promise)) return accepted(value);
      return value.then(accepted).catch(refused).finally(() => this.#running.delete(id));
    } catch (error) {
      return refused(error);
    }
  }

  #run(call: Call): unknown {
    const { target, method, args } = call;
    if (target === 0 && method === "init") return this.#start(args[0] as Parameters<typeof init>[0]);
    if (target === 0 && method === "files") return new Files(new IoModule(args[0] as InitOptions, unnamed));
    const object = this.#objects.get(target);
    if (!object) throw new PliantError("disposed", "the object is disposed; expected a live one");
    const { calls } = rowOf(names.get(object.constructor)!);
    if (!Object.hasOwn(calls, method)) throw new Error(`there is no method ${method}`);
    return (object as Record<string, Callable>)[method](...this.#arguments(call, calls[method]));
  }

  async #start(options: Parameters<typeof init>[0]): Promise<Pliant> {
    const pliant = await init(options);
    this.#objects.set(0, pliant);
    return pliant;
  }

  #arguments(
    { id, target, args, objects = [], local = [], doubles }: Call, { options = 0, changes }: Travel,
  ): unknown[] {
    if (changes !== undefined) {
      args[changes] = patched(this.#given.get(target), args[changes] as Patch);
      this.#given.set(target, args[changes]);
    }
    for (const [argument, object] of objects) args[argument] = this.#objects.get(object);
    if (doubles !== undefined) args.push(new Float64Array(doubles));
    if (local.length === 0) return args;
    const ours: Record<string, unknown> = {};
    if (local.includes("onProgress")) ours.onProgress = (progress: unknown) => this.#post([{ id, progress }]);
    if (local.includes("signal")) {
      const controller = new AbortController();
      this.#running.set(id, controller);
      ours.signal = controller.signal;
    }
    args[options] = { ...(args[options] as object), ...ours };
    return args;
  }

  /** An object of the package stays here and gets a number. */
  #refer(value: unknown): unknown {
    const name = names.get((value as object | undefined)?.constructor);
    if (!name) return value;
    const object = value === this.#objects.get(0) ? 0 : ++this.#last;
    this.#objects.set(object, value as object);
    const constants = Object.fromEntries(
      rowOf(name).constants.map((key) => [key, (value as Record<string, unknown>)[key]]),
    );
    return { object, constants } satisfies Reference;
  }

  #post(replies: Reply[]): void {
    const values = replies.map((reply) => ("value" in reply ? reply.value : undefined));
    this.port.post(replies, [...new Set(values.flatMap(buffersOf))]);
  }
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
line.listen((requests: Request[]) => host.receive(requests));
