// --carry: another file of any size, streamed through a finished edit.

import { open } from "node:fs/promises";
import { PliantError } from "../boundary/errors.js";
import { requireCarries } from "../edit/carry.js";
import type { FinishedEdit } from "../edit/frames.js";
import type { ScriptPlan } from "../edit/plan.js";
import { textFormats } from "../io/format.js";
import type { Move } from "../io/text.js";
import { Failure, onFile } from "./failure.js";
import type { Outputs } from "./outputs.js";
import type { Progress } from "./progress.js";
import { files, formatOf } from "./shapes.js";

const pieceSize = 4 << 20;

/** Where from and where to. */
export interface Carry {
  from: string;
  to: string;
}

/** What is asked for, if anything. Errors: a Failure. */
export function readCarry({ carry: from, "carry-out": to }: Record<string, string | undefined>): Carry | undefined {
  if (from === undefined && to === undefined) return undefined;
  if (from === undefined || to === undefined) {
    throw new Failure("--carry and --carry-out go together; see pliant --help");
  }
  const format = formatOf(from, textFormats);
  if (formatOf(to, textFormats) !== format) {
    throw new Failure(`${to}: the extension is not that of ${from}; expected .${format}`);
  }
  return { from, to };
}

/** What moves a surface only has no other points to carry. The steps of all keyframes are alike. */
export function checkCarries(path: string, { keyframes: [{ steps }] }: ScriptPlan): void {
  try {
    steps.forEach(requireCarries);
  } catch (error) {
    throw error instanceof PliantError ? new Failure(`${path}: --carry: ${error.message}`, { cause: error }) : error;
  }
}

/** Passes the file through, in memory bounded by the size of a piece. */
export async function carry(
  edit: FinishedEdit, dimension: 2 | 3, { from, to }: Carry, outputs: Outputs, progress: Progress, signal: AbortSignal,
): Promise<void> {
  const target = await outputs.open(to);
  try {
    const show = (done: number, total: number) => progress.show(done, total, `carrying ${from}`);
    for await (const piece of files.rewrite(piecesOf(from, signal, show), from, moveOf(edit, dimension))) {
      await onFile(to, () => target.writeFile(piece));
    }
  } catch (error) {
    // Those of reading begin with the path.
    throw error instanceof PliantError ? new Failure(error.message, { cause: error }) : error;
  } finally {
    await target.close();
  }
}

/** In the plane the third coordinate of a file stays, and so do its normals. */
function moveOf(edit: FinishedEdit, dimension: 2 | 3): Move {
  if (dimension === 3) return edit.carry;
  return (points) => {
    const plane = points.filter((_, i) => i % 3 < 2);
    edit.carry(plane);
    plane.forEach((x, i) => (points[3 * (i >> 1) + (i % 2)] = x));
  };
}

async function* piecesOf(
  path: string, signal: AbortSignal, show: (done: number, total: number) => void,
): AsyncGenerator<Uint8Array> {
  const source = await onFile(path, () => open(path));
  try {
    const { size } = await onFile(path, () => source.stat());
    const buffer = new Uint8Array(pieceSize);
    for (let done = 0; ; show(done, size)) {
      signal.throwIfAborted();
      const { bytesRead } = await onFile(path, () => source.read(buffer));
      if (bytesRead === 0) return;
      done += bytesRead;
      yield buffer.subarray(0, bytesRead);
    }
  } finally {
    await source.close();
  }
}
