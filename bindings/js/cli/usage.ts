// The arguments of the command.

import { parseArgs } from "node:util";
import { Failure } from "./failure.js";

export const help = `Usage: pliant <command> ...

  pliant deform SHAPE --script EDIT.json --out OUT [--report R.json] [--state S.json]
                [--carry BIG --carry-out BIG_OUT] [--background COLOR] [--spacing PIXELS] [--fit]
      Runs an edit script over a shape. With keyframes in the script, OUT is a pattern
      (frame_%04d.obj) or one animated .glb. --carry takes another file of any size along
      (.ply .obj .xyz .off .stl), where all steps deform space.
  pliant inspect SHAPE [--json] [--background COLOR] [--spacing PIXELS]
      What the shape is made of.
  pliant compare REST DEFORMED [--json]
      How far a deformation stretches, shears, folds and roughens a shape.

Shapes: .obj .ply .off .stl .glb; points: .xyz, or .ply and .obj without faces.
Pictures: .png, a shape in the plane: coordinates are pixels from the bottom left corner, y up.
  OUT is a .png of the same frame, an .svg or any shape. Transparent pixels are not part of it, nor are
  those of --background: a colour (#ffffff); border, the one that most of the border has; or auto, that
  where the picture is opaque, as far as it hangs together.
  --spacing: distance of neighbouring vertices; --fit: OUT shows all of the shape, not the frame.
Options everywhere: --quiet (no progress), --help, --version.
Exit code: 0 done; 2 bad usage, script or input; 1 a defect of pliant.`;

interface Command {
  operands: readonly string[];
  /** Options that take a file; those with ! must be given. */
  files: readonly string[];
  /** Options that take a value. */
  values: readonly string[];
  flags: readonly string[];
}

const commands: Record<string, Command> = {
  deform: {
    operands: ["SHAPE"], files: ["script!", "out!", "report", "state", "carry", "carry-out"],
    values: ["background", "spacing"], flags: ["fit"],
  },
  inspect: { operands: ["SHAPE"], files: [], values: ["background", "spacing"], flags: ["json"] },
  compare: { operands: ["REST", "DEFORMED"], files: [], values: [], flags: ["json"] },
};

export interface Invocation {
  command: string;
  operands: string[];
  files: Record<string, string | undefined>;
  values: Record<string, string | undefined>;
  flags: Record<string, boolean | undefined>;
}

/** Errors: a Failure that says what is wrong. */
export function readArguments(argv: string[]): Invocation {
  const [name, ...rest] = argv;
  if (name === undefined) fail("no command");
  if (name === "animate") fail('"animate" is not in this build yet');
  const command = Object.hasOwn(commands, name) ? commands[name] : fail(`unknown command ${JSON.stringify(name)}`);
  const names = command.files.map((file) => file.replace("!", ""));
  const options = Object.fromEntries([
    ...[...names, ...command.values].map((file) => [file, { type: "string" as const }]),
    ...[...command.flags, "quiet"].map((flag) => [flag, { type: "boolean" as const }]),
  ]);
  const { values, positionals } = parse(rest, options);
  if (positionals.length !== command.operands.length) {
    fail(`${name} takes ${command.operands.join(" ")}, but ${positionals.length} files are given`);
  }
  const missing = command.files.find((file) => file.endsWith("!") && values[file.slice(0, -1)] === undefined);
  if (missing) fail(`${name} needs --${missing.slice(0, -1)}`);
  const pick = <T>(keys: readonly string[]) =>
    Object.fromEntries(keys.map((key) => [key, values[key] as T | undefined]));
  return {
    command: name, operands: positionals, files: pick<string>(names), values: pick<string>(command.values),
    flags: pick<boolean>([...command.flags, "quiet"]),
  };
}

function parse(args: string[], options: Record<string, { type: "string" | "boolean" }>) {
  try {
    return parseArgs({ args, options, allowPositionals: true });
  } catch (error) {
    return fail((error as Error).message.split("\n")[0].split(". To specify")[0]);
  }
}

function fail(reason: string): never {
  throw new Failure(`${reason}; see pliant --help`);
}
