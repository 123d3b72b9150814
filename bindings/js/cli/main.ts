// The `pliant` command.

import { readFile } from "node:fs/promises";
import createModule from "#wasm/pliant.mjs";
import version from "#version";
import { Core } from "../boundary/core.js";
import { Pliant } from "../pliant.js";
import { instantiate } from "../boundary/wasm.js";
import { deform } from "./deform.js";
import { Failure } from "./failure.js";
import { compare, inspect } from "./inspect.js";
import { Outputs } from "./outputs.js";
import { help, readArguments } from "./usage.js";

async function start(): Promise<Core> {
  const binary = await readFile(new URL("./pliant.wasm", import.meta.url));
  return new Core(await instantiate(createModule, await WebAssembly.compile(binary)), () => {});
}

async function run(argv: string[], signal: AbortSignal): Promise<void> {
  if (argv.includes("--help") || argv.includes("-h")) return print(help);
  if (argv.includes("--version")) return print(version);
  const invocation = readArguments(argv);
  const core = await start();
  const pliant = new Pliant(core);
  if (invocation.command === "inspect") return print(await inspect(pliant, invocation));
  if (invocation.command === "compare") return print(await compare(pliant, invocation));
  const outputs = new Outputs();
  try {
    await deform(pliant, core, invocation, outputs, signal);
    await outputs.keep();
  } finally {
    await outputs.discard();
  }
}

function print(text: string): void {
  process.stdout.write(`${text}\n`);
}

const interrupted = new AbortController();
for (const name of ["SIGINT", "SIGTERM"] as const) process.once(name, () => interrupted.abort());

try {
  await run(process.argv.slice(2), interrupted.signal);
} catch (error) {
  if (interrupted.signal.aborted) {
    process.exitCode = 130;
  } else if (error instanceof Failure) {
    console.error(`pliant: ${error.message.replaceAll(/\s*\n\s*/g, " ")}`);
    process.exitCode = 2;
  } else {
    console.error("pliant: a defect of pliant, please report it:", error);
    process.exitCode = 1;
  }
}
