// `npm test`: sets up, builds and runs every test.  npm test -- [native|sanitize|wasm|js|page]...
// The last line is `N passed, N failed`, over all suites. Nothing is skipped silently: a suite that
// cannot be built, crashes, runs no test or skips one counts as failed.

import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { build, buildTargets } from "./build.mjs";
import { attempt, Failure, heading, main, root } from "./run.mjs";
import { setup } from "./setup.mjs";

/** Each runs one suite and resolves to { passed, failed, skipped, broken }; `broken` says what else went wrong. */
const suites = {
  native: async () => {
    await buildTargets("release", ["pliant_tests"]);
    return runDoctest(join(root, "build/release/tests/pliant_tests"), []);
  },
  // The same tests with asserts, and with sanitizers that stop at an access out of bounds or undefined behaviour.
  sanitize: async () => {
    await buildTargets("sanitize", ["pliant_tests"]);
    return runDoctest(join(root, "build/sanitize/tests/pliant_tests"), []);
  },
  wasm: async () => {
    await buildTargets("wasm", ["pliant_tests"]);
    // With fetch about, the generated code would load the module as from the web.
    return runDoctest(process.execPath, ["--no-experimental-fetch", "build/wasm/tests/pliant_tests.cjs"]);
  },
  js: async () => {
    await build();
    return runVitest("js");
  },
  page: async () => {
    await build();
    return runVitest("page");
  },
};

async function runDoctest(command, args) {
  const { code, signal, output } = await attempt(command, [...args, "--no-colors=true"]);
  const line = /^\[doctest\] test cases:\s*\d+ \|\s*(\d+) passed \|\s*(\d+) failed \|\s*(\d+) skipped/m.exec(output);
  if (!line) return { passed: 0, failed: 0, skipped: 0, broken: `no summary (${ending(code, signal)})` };
  const [passed, failed, skipped] = line.slice(1).map(Number);
  return { passed, failed, skipped, broken: code !== 0 && failed === 0 ? ending(code, signal) : "" };
}

async function runVitest(name) {
  const results = join(root, `build/results/${name}.json`);
  mkdirSync(join(root, "build/results"), { recursive: true });
  rmSync(results, { force: true });
  const { code, signal } = await attempt(process.execPath, ["node_modules/vitest/vitest.mjs", "run",
    "--config", `tests/${name}/vitest.config.ts`,
    "--reporter=default", "--reporter=json", `--outputFile.json=${results}`]);
  let report;
  try {
    report = JSON.parse(readFileSync(results, "utf8"));
  } catch {
    return { passed: 0, failed: 0, skipped: 0, broken: `no results (${ending(code, signal)})` };
  }
  const failed = report.numFailedTests;
  return {
    passed: report.numPassedTests, failed, skipped: report.numPendingTests + report.numTodoTests,
    broken: code !== 0 && failed === 0 ? ending(code, signal) : "",
  };
}

const ending = (code, signal) => (signal ? `ended by ${signal}` : `exit code ${code}`);

/** What a suite counts for in the total: whatever is not a pass is a failure, of one at least. */
function judge({ passed, failed, skipped, broken }) {
  const wrong = failed + skipped + (broken ? 1 : 0);
  const none = passed + failed + skipped === 0 && !broken;
  const notes = [skipped > 0 && `${skipped} skipped`, broken, none && "no test ran"].filter(Boolean);
  return { passed, failed: wrong + (none ? 1 : 0), notes: notes.join(", ") };
}

async function runSuite(name) {
  const begin = performance.now();
  heading(`Suite ${name}`);
  let outcome;
  try {
    outcome = judge(await suites[name]());
  } catch (error) {
    if (!(error instanceof Failure)) console.error(error);
    outcome = { passed: 0, failed: 1, notes: error.message };
  }
  return { name, ...outcome, seconds: (performance.now() - begin) / 1000 };
}

await main(async (args) => {
  const unknown = args.find((name) => !Object.hasOwn(suites, name));
  if (unknown !== undefined) {
    throw new Failure(`test: unknown suite "${unknown}": expected ${Object.keys(suites).join(", ")}`);
  }
  await setup("test");
  const outcomes = [];
  for (const name of args.length > 0 ? new Set(args) : Object.keys(suites)) outcomes.push(await runSuite(name));

  heading("Summary");
  for (const { name, passed, failed, notes, seconds } of outcomes) {
    console.log(`${name.padEnd(9)}${String(passed).padStart(5)} passed ${String(failed).padStart(4)} failed ` +
      `${seconds.toFixed(0).padStart(5)} s${notes ? `   ${notes}` : ""}`);
  }
  const total = (key) => outcomes.reduce((sum, outcome) => sum + outcome[key], 0);
  if (total("failed") > 0) process.exitCode = 1;
  console.log(`${total("passed")} passed, ${total("failed")} failed`);
});
