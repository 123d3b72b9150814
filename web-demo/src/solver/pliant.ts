// The package, in its worker, with the WASM inside the page: nothing is fetched.
import { init, type WorkerPliant } from "pliant/worker";
import { learnMethods } from "../methods.ts";

export type {
  EditDocument, EditMoment, EditRun, Quality, Refinement, RigidTransform, ScriptAnyStep as DocumentStep, ShapeReport,
  SketchView, Spot, State, WorkerEdit, WorkerPliant, WorkerShape,
} from "pliant/worker";

/** Every call gives the same worker. */
export async function connect(): Promise<WorkerPliant> {
  const pliant = await init({ inline: true });
  learnMethods(pliant.methods);
  return pliant;
}
