// The package, in its worker, with the WASM inside the page: nothing is fetched.
import { init, type WorkerPliant } from "pliant/worker";

export type {
  EditDocument, EditMoment, EditRun, ScriptAnyStep as DocumentStep, ShapeReport, SketchView, State, WorkerEdit, WorkerPliant, WorkerShape,
} from "pliant/worker";

/** Every call gives the same worker. */
export const connect = (): Promise<WorkerPliant> => init({ inline: true });
