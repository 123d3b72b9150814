// The package, in its worker, with the WASM inside the page: nothing is fetched.
import { init, type WorkerPliant } from "pliant/worker";

export type {
  DeformerOptions, ShapeReport, State, Step as StepReport, WorkerDeformer as Deformer, WorkerHandle as Handle, WorkerPliant as Pliant,
} from "pliant/worker";

export const connect = (): Promise<WorkerPliant> => init({ inline: true });
