// The package, in its worker, with the WASM inside the page: nothing is fetched.
import { init, type WorkerPliant } from "pliant/worker";

export type {
  DeformerOptions, EditScript, ShapeReport, State, Step as StepReport, WorkerDeformer as Deformer, WorkerHandle as Handle, WorkerPliant as Pliant,
  WorkerShape as Shape, WorkerSketch as Sketch,
} from "pliant/worker";

export const connect = (): Promise<WorkerPliant> => init({ inline: true });
