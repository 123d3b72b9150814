// pliant deform: an edit script over a shape, and the files that come of it.

import { readFile } from "node:fs/promises";
import { resolve } from "node:path";
import type { Core } from "../boundary/core.js";
import { PliantError } from "../boundary/errors.js";
import type { Pliant } from "../pliant.js";
import type { ScriptPlan } from "../edit/plan.js";
import { readScript } from "../edit/read.js";
import { type FinishedEdit, reportOf, runFrames } from "../edit/frames.js";
import type { EditProgress, EditReport } from "../edit/types.js";
import { extentOf, type Shape } from "../shape/shape.js";
import { carry, checkCarries, readCarry } from "./carry.js";
import { Failure, onFile } from "./failure.js";
import { writtenFormats } from "../io/format.js";
import type { ShapeFile } from "../io/shape_file.js";
import { parseJson } from "./json.js";
import type { Outputs } from "./outputs.js";
import { Progress } from "./progress.js";
import { animated, formatOf, readShape, written } from "./shapes.js";
import type { Invocation } from "./usage.js";

/** Writes into `outputs`, which the caller keeps or discards. */
export async function deform(
  pliant: Pliant, core: Core, invocation: Invocation, outputs: Outputs, signal: AbortSignal,
): Promise<void> {
  const { operands: [shapePath], files, flags, values } = invocation;
  const big = readCarry(files);
  checkOutputs([files.out, files.report, files.state, big?.to]);
  const format = formatOf(files.out!, writtenFormats);
  if (flags.fit && format !== "png" && format !== "svg") {
    throw new Failure(`--fit is given, and ${files.out} is no picture; expected a .png or .svg`);
  }
  const file = await readShape(shapePath, values);
  const { positions, triangles, dimension } = file;
  const shape = await onFile(shapePath, () => pliant.shape({ positions, triangles, dimension }));
  const plan = await readPlan(files.script!, shape);
  if (big) checkCarries(files.script!, plan);
  const frames = new Frames(file, files.out!, format, plan, outputs, flags.fit ? "fit" : undefined);
  const progress = new Progress(flags.quiet === true);
  try {
    const reports: NonNullable<EditReport["frames"]> = [];
    await onScript(files.script!, async () => {
      for await (const edit of runFrames(core, shape, plan, { signal, onProgress: (p) => showSolve(progress, p) })) {
        reports.push({ time: edit.time, steps: edit.steps, quality: edit.quality });
        await frames.add(edit);
        if (reports.length < (plan.frames ?? 1)) continue;
        if (files.state) await outputs.write(files.state, JSON.stringify(edit.state));
        if (big) await carry(edit, shape.dimension, big, outputs, progress, signal);
      }
    });
    await frames.finish();
    if (files.report) await outputs.write(files.report, `${JSON.stringify(reportOf(shape, reports, plan), null, 2)}\n`);
  } finally {
    progress.clear();
  }
}

/** No output takes the place of another. */
function checkOutputs(paths: (string | undefined)[]): void {
  const named = paths.filter((path) => path !== undefined);
  const twice = named.find((path, i) => named.slice(0, i).some((before) => resolve(before) === resolve(path)));
  if (twice) throw new Failure(`${twice}: is named for two outputs; expected different files`);
}

async function readPlan(path: string, shape: Shape): Promise<ScriptPlan> {
  return onFile(path, async () => {
    const script = parseJson(path, await readFile(path, "utf8"));
    return readScript(script, extentOf(shape));
  });
}

/** Errors of the edit name the script; those of files name theirs already. */
async function onScript(path: string, work: () => Promise<void>): Promise<void> {
  try {
    await work();
  } catch (error) {
    if (!(error instanceof PliantError) || error.code === "aborted") throw error;
    throw new Failure(`${path}: ${error.message}`, { cause: error });
  }
}

function showSolve(progress: Progress, { frame, frames, step, steps, iteration, energy }: EditProgress): void {
  const done = (frame + step / steps) / frames;
  const where = [
    frames > 1 && `frame ${frame + 1}/${frames}`, steps > 1 && `step ${step + 1}/${steps}`, `iteration ${iteration}`,
  ];
  progress.show(done, 1, `${where.filter(Boolean).join(", ")}, energy ${energy.toPrecision(4)}`);
}

/** Where the frames of a script go: one file, numbered files, or one animated .glb. */
class Frames {
  readonly #kept: { positions: Float64Array; time: number }[] = [];
  readonly #animated: boolean;
  #count = 0;

  constructor(
    readonly file: ShapeFile,
    readonly out: string,
    readonly format: string,
    readonly plan: ScriptPlan,
    readonly outputs: Outputs,
    readonly frame: "fit" | undefined,
  ) {
    const numbered = /%0?\d*d/.test(out);
    this.#animated = plan.frames !== undefined && format === "glb" && !numbered;
    if (plan.frames !== undefined && !numbered && !this.#animated) {
      throw new Failure(`${out}: the script has keyframes; expected a pattern as frame_%04d.${format}, or one .glb`);
    }
  }

  async add({ positions, time, refinement, depths }: FinishedEdit): Promise<void> {
    if (this.#animated) this.#kept.push({ positions, time });
    else {
      const result = { positions, refinement, depths, frame: this.frame };
      const encode = () => written(this.file, `shape.${this.format}`, result);
      await this.outputs.write(this.#path(), await this.#encoded(encode));
    }
    ++this.#count;
  }

  async finish(): Promise<void> {
    if (!this.#animated) return;
    const times = this.#kept.map(({ time }) => time - this.#kept[0].time);
    const frames = this.#kept.map(({ positions }) => positions);
    await this.outputs.write(this.out, await this.#encoded(() => animated(this.file, frames, times)));
  }

  /** Printed as in C: %d, %4d, %04d. */
  #path(): string {
    if (this.plan.frames === undefined) return this.out;
    return this.out.replace(/%(0?)(\d*)d/, (_, zero, width) =>
      String(this.#count + 1).padStart(Number(width), zero || " "),
    );
  }

  /** What cannot be written is a fault of the output's format. */
  #encoded(encode: () => Promise<Uint8Array>): Promise<Uint8Array> {
    return onFile(this.out, encode);
  }
}
