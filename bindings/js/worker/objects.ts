// The objects of pliant/worker: as those of the package, but every call is a promise. What they can do stands in
// surface.ts; types and documentation are those of the package's own classes.

import type { FloatArray } from "../boundary/check.js";
import { disposeSymbol } from "../boundary/core.js";
import { PliantError } from "../boundary/errors.js";
import type { Deformer } from "../deform/deformer.js";
import type { Handle } from "../deform/handle.js";
import type { Sketch } from "../deform/sketch.js";
import type { Edit } from "../edit/living.js";
import { shared } from "../edit/same.js";
import type { Files } from "../io/files.js";
import type { ShapeFile, WritableShape } from "../io/shape_file.js";
import type { DeformerOptions, MethodName } from "../methods/index.js";
import type { Picture } from "../picture/picture.js";
import type { Pliant } from "../pliant.js";
import type { Shape } from "../shape/shape.js";
import type { InitOptions } from "../boundary/wasm.js";
import type { Line } from "./line.js";
import type { Reference } from "./protocol.js";
import { type Origin, Remote } from "./remote.js";
import { type Calls, type ClassName, type Constants, rowOf } from "./surface.js";

// -- Types, from those of the package. --------------------------------------------------------------

/** What a page holds in place of a value of the package. */
type OnPage<T> =
  T extends Picture ? WorkerPicture :
  T extends Shape ? WorkerShape :
  T extends Deformer<infer M> ? WorkerDeformer<M> :
  T extends Handle ? WorkerHandle :
  T extends Sketch ? WorkerSketch :
  T extends Edit ? WorkerEdit :
  T;

/** Results in a new array, or in the caller's. */
interface Results {
  (): Promise<Float32Array>;
  <T extends FloatArray>(out: T): Promise<T>;
}

/** Points in the precision they came in, or in the caller's array. */
interface CarriedPoints {
  (points: Float32Array): Promise<Float32Array>;
  (points: ArrayLike<number>): Promise<Float64Array>;
  <T extends FloatArray>(points: ArrayLike<number>, out: T): Promise<T>;
}

/** Normals in the precision they came in, or in the caller's array. */
interface TurnedNormals {
  (points: ArrayLike<number>, normals: Float32Array): Promise<Float32Array>;
  (points: ArrayLike<number>, normals: ArrayLike<number>): Promise<Float64Array>;
  <T extends FloatArray>(points: ArrayLike<number>, normals: ArrayLike<number>, out: T): Promise<T>;
}

/** A call of the package as a promise. */
type Promised<Call, How> =
  How extends { into: 0 } ? Results :
  How extends { into: 1 } ? CarriedPoints :
  How extends { into: 2 } ? TurnedNormals :
  Call extends (...args: infer Args) => infer Result
    ? (...args: { [I in keyof Args]: OnPage<Args[I]> }) => Promise<OnPage<Awaited<Result>>>
    : never;

/** A class of the package as a page sees it. */
type Seen<T, Name extends ClassName> = {
  [Key in keyof T as Key extends Constants<Name> ? Key : never]: T[Key];
} & {
  [Key in keyof T as Key extends keyof Calls<Name> ? Key : never]:
    Key extends keyof Calls<Name> ? Promised<T[Key], Calls<Name>[Key]> : never;
};

// -- Objects. ---------------------------------------------------------------------------------------

/** A class with the calls that its row of the table lists. */
function remote(name: ClassName): typeof Remote {
  class Listed extends Remote {}
  for (const [method, travel] of Object.entries(rowOf(name).calls)) {
    const value = function (this: Remote, ...args: unknown[]) {
      return this.send(method, travel, args, (reference) =>
        made(travel.gives as keyof typeof classes, this.line, reference, { asked: this, args }),
      );
    };
    Object.defineProperty(Listed.prototype, method, { value, writable: true, configurable: true });
  }
  return Listed;
}

/** See {@link Pliant}. */
export interface WorkerPliant extends Omit<Seen<Pliant, "Pliant">, "deformer"> {
  /** Builds a deformer over a shape. Errors: invalid-option, too-large. */
  deformer<M extends MethodName>(
    shape: WorkerShape, options: { method: M } & DeformerOptions<M>,
  ): Promise<WorkerDeformer<M>>;
}
export class WorkerPliant extends remote("Pliant") {
  readonly #wasm: () => Promise<InitOptions>;
  #files: Promise<WorkerFiles> | undefined;

  /** `wasm`: where the worker finds pliant-io.wasm. @internal */
  constructor(line: Line, reference: Reference, wasm: () => Promise<InitOptions>) {
    super(line, reference);
    this.#wasm = wasm;
  }

  /** Reads a shape file in the worker: the page goes on meanwhile. See {@link Files.read}. */
  async read(...[source, name, options]: Parameters<Files["read"]>): Promise<ShapeFile> {
    return (await this.#started()).read(source, name, options);
  }

  /** Writes a shape file in the worker. See {@link Files.write}. */
  async write(shape: WritableShape, name: string): Promise<Uint8Array<ArrayBuffer>> {
    const own = structuredClone(shape); // the caller may go on with its arrays at once
    return (await this.#started()).write(own, name);
  }

  #started(): Promise<WorkerFiles> {
    const start = async () => {
      const reference = await this.line.call<Reference>({ target: 0, method: "files", args: [await this.#wasm()] });
      return new WorkerFiles(this.line, reference);
    };
    this.#files ??= start().catch((error) => {
      this.#files = undefined;
      throw error;
    });
    return this.#files;
  }

  /** Ends the worker. Every later call, on any object of it, is a `disposed` error. */
  dispose(): void {
    this.line.close(new PliantError("disposed", "the worker is disposed; expected a live one"));
  }

  [disposeSymbol](): void {
    this.dispose();
  }
}

/** See {@link Shape}. */
export interface WorkerShape extends Seen<Shape, "Shape"> {}
export class WorkerShape extends remote("Shape") {}

/** See {@link Picture}. */
export interface WorkerPicture extends Seen<Picture, "Picture"> {}
export class WorkerPicture extends remote("Picture") {}

/** See {@link Deformer}. */
export interface WorkerDeformer<M extends MethodName = MethodName> extends Seen<Deformer<M>, "Deformer"> {}
export class WorkerDeformer<M extends MethodName = MethodName> extends remote("Deformer") {
  readonly shape: WorkerShape;
  readonly #handles: WorkerHandle[] = [];

  /** @internal */
  constructor(line: Line, reference: Reference, { args }: Origin) {
    super(line, reference);
    this.shape = args[0] as WorkerShape;
  }

  /** The handles there are, oldest first. */
  get handles(): WorkerHandle[] {
    return this.#handles.filter((handle) => !handle.ended);
  }

  /** @internal */
  added(handle: WorkerHandle): void {
    this.#handles.push(handle);
  }
}

/** See {@link Handle}. */
export interface WorkerHandle extends Seen<Handle, "Handle"> {}
export class WorkerHandle extends remote("Handle") {
  readonly #vertices: Uint32Array;

  /** @internal */
  constructor(line: Line, reference: Reference, { asked }: Origin) {
    const { vertices, ...constants } = reference.constants;
    super(line, { ...reference, constants });
    this.#vertices = vertices as Uint32Array;
    (asked as WorkerDeformer).added(this);
  }

  /** Its vertices, in the order they were given. */
  get vertices(): Uint32Array {
    return this.#vertices.slice();
  }
}

/** See {@link Sketch}. */
export interface WorkerSketch extends Seen<Sketch, "Sketch"> {}
export class WorkerSketch extends remote("Sketch") {
  readonly shape: WorkerShape;

  /** @internal */
  constructor(line: Line, reference: Reference, { args }: Origin) {
    super(line, reference);
    this.shape = args[0] as WorkerShape;
  }
}

/** See {@link Edit}. */
export interface WorkerEdit extends Seen<Edit, "Edit"> {}
export class WorkerEdit extends remote("Edit") {
  readonly shape: WorkerShape;
  readonly #last: Record<string, unknown> = {};

  /** @internal */
  constructor(line: Line, reference: Reference, { args }: Origin) {
    super(line, reference);
    this.shape = args[0] as WorkerShape;
  }

  /** Moments share what has not changed between them on this side, too; so does what is to be seen of a limb. */
  protected override received(method: string, value: unknown): unknown {
    return ["moment", "sketch"].includes(method) ? (this.#last[method] = shared(this.#last[method], value)) : value;
  }
}

/** See {@link Files}. */
interface WorkerFiles extends Seen<Files, "Files"> {}
class WorkerFiles extends remote("Files") {}

const classes = {
  Shape: WorkerShape, Picture: WorkerPicture, Deformer: WorkerDeformer, Handle: WorkerHandle, Sketch: WorkerSketch,
  Edit: WorkerEdit,
} satisfies Partial<Record<ClassName, unknown>>;

function made(name: keyof typeof classes, line: Line, reference: Reference, origin: Origin): Remote {
  return new classes[name](line, reference, origin);
}
