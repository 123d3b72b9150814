// How a deformer is led through what a step asks of it, one iteration after another.

import { type Deformer, drive, type Step } from "../deform/deformer.js";
import type { Progress, StepReport } from "./types.js";

/** A part of it: from `begin` on so many accepted iterations, or until the method's own test holds. */
export interface Phase {
  iterations: number;
  tolerance: number;
  begin(): void;
}

export class Solving {
  readonly progress: Progress[];

  /** `progress`: of the phases that have begun, where they were begun before. */
  constructor(readonly deformer: Deformer, public phases: readonly Phase[], progress: readonly Progress[] = []) {
    this.progress = progress.map((one) => ({ ...one, iterations: [...one.iterations] }));
  }

  /** Whether these phases, for the first ones that have begun, are what has been carried out. */
  fits(phases: readonly Phase[]): boolean {
    if (this.progress.length > phases.length) return false;
    return this.progress.every(({ iterations: { length }, settled }, i) => {
      const { iterations } = phases[i];
      const over = i + 1 < this.progress.length;
      return over && !settled ? iterations === length : iterations >= length;
    });
  }

  get done(): boolean {
    return this.#current === undefined;
  }

  /** One iteration, of the first phase that is not over. */
  advance(): Step {
    const at = this.#current!;
    const phase = this.phases[at];
    const before = this.deformer.counters();
    if (at === this.progress.length) this.#begin(phase);
    const step = this.deformer.step({ tolerance: phase.tolerance });
    const progress = this.progress[at];
    if (step.accepted) progress.iterations.push({ energy: step.energy, ms: step.milliseconds });
    progress.converged = step.converged;
    progress.settled = progress.iterations.length < phase.iterations && drive(this.deformer).settled(step);
    const after = this.deformer.counters();
    progress.factorizations += after.factorizations - before.factorizations;
    progress.analyses += after.analyses - before.analyses;
    return step;
  }

  #begin(phase: Phase): void {
    phase.begin();
    const start = this.deformer.energy().total;
    this.progress.push({ start, iterations: [], converged: false, settled: false, factorizations: 0, analyses: 0 });
  }

  get #current(): number | undefined {
    const at = this.phases.findIndex(({ iterations }, i) => {
      const progress = this.progress[i];
      return !progress || (!progress.settled && progress.iterations.length < iterations);
    });
    return at < 0 ? undefined : at;
  }
}

/** The last may still go on; those before it do not change any more. */
export function copied(progress: readonly Progress[]): Progress[] {
  return progress.map((one, i) => (i + 1 < progress.length ? one : { ...one, iterations: [...one.iterations] }));
}

/** What a deformer did, as a step of the report: `main` is the step's own part of the progress. */
export function solvedReport(
  { deformer }: Solving, main: Progress | undefined, setupMs: number, past = { factorizations: 0, analyses: 0 },
): StepReport {
  const { unknowns, factorizations, analyses } = deformer.counters();
  const { total, terms } = deformer.energy();
  return {
    method: deformer.method, unknowns, setupMs,
    factorizations: past.factorizations + factorizations, analyses: past.analyses + analyses,
    start: main?.start ?? total, iterations: [...(main?.iterations ?? [])], converged: main?.converged ?? false,
    energy: { total, ...terms },
  };
}
