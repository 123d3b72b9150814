// What the other scripts share: where the checkout is, how to run a command, how to fail plainly.
// Node built-ins only: setup.mjs runs before anything is installed.

import { spawn } from "node:child_process";
import { realpathSync } from "node:fs";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";

export const root = dirname(dirname(fileURLToPath(import.meta.url)));

/** An expected failure: its message is all the reader needs, without a stack. */
export class Failure extends Error {}

export function heading(text) {
  console.log(process.stdout.isTTY ? `\x1b[1m== ${text}\x1b[0m` : `== ${text}`);
}

/**
 * Runs a command in the checkout. Resolves to { code, signal, output } and never rejects for an exit
 * code. `show`: pass the output on as it comes; `output` holds stdout, then stderr in order of arrival.
 */
export function attempt(command, args, { env = {}, show = true, cwd = root } = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(command, args, {
      cwd, env: { ...process.env, ...env }, stdio: ["ignore", "pipe", "pipe"],
    });
    let output = "";
    const take = (stream, sink) => stream.setEncoding("utf8").on("data", (text) => {
      output += text;
      if (show) sink.write(text);
    });
    take(child.stdout, process.stdout);
    take(child.stderr, process.stderr);
    child.on("error", (error) =>
      reject(new Failure(`cannot run ${command}: ${error.code === "ENOENT" ? "not found" : error.message}`)));
    child.on("close", (code, signal) => resolve({ code, signal, output }));
  });
}

/** Runs a command that must succeed; a hidden output is shown when it does not. */
export async function run(command, args, options = {}) {
  const { code, signal, output } = await attempt(command, args, options);
  if (code === 0) return output;
  if (options.show === false) console.error(output.trimEnd().split("\n").slice(-20).join("\n"));
  throw new Failure(`${command} ${args.join(" ")}: ${signal ? `ended by ${signal}` : `exit code ${code}`}`);
}

/** The entry point of a script: a Failure is one line on stderr and exit code 1. */
export async function main(action) {
  try {
    await action(process.argv.slice(2));
  } catch (error) {
    console.error(error instanceof Failure ? `pliant: ${error.message}` : error);
    process.exitCode = 1;
  }
}

/** Whether this module (by its import.meta.url) is the program, not an import. */
export function isProgram(url) {
  return process.argv[1] !== undefined && fileURLToPath(url) === realpathSync(process.argv[1]);
}
