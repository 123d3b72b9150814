// `npm run bench`: the benches natively and in WASM, one table, and build/bench.json.
//   npm run bench -- [name...]    only the benches whose names contain one of the words

import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { buildTargets } from "./build.mjs";
import { Failure, heading, main, root, run } from "./run.mjs";
import { setup } from "./setup.mjs";

/** The results a bench program prints, one JSON object a line, by name. */
async function measure(title, command, args) {
  heading(`Measuring ${title}`);
  const output = await run(command, args, { show: false });
  const lines = output.split("\n").filter((line) => line.startsWith("{"));
  const results = new Map(lines.map((line) => JSON.parse(line)).map((result) => [result.name, result]));
  if (results.size === 0) throw new Failure(`bench: ${title} measured nothing`);
  return results;
}

/** Names in the order of the native run, then what only WASM measured. */
function merge(native, wasm) {
  return [...new Set([...native.keys(), ...wasm.keys()])].map((name) => {
    const [n, w] = [native.get(name), wasm.get(name)];
    return { name, native: n, wasm: w, wasmOverNative: w?.ms / n?.ms, wasmOverNativeYardstick: w?.ms / n?.yardstick };
  });
}

const show = (value, digits) => (Number.isFinite(value) ? value.toFixed(digits) : "-");

function printTable(rows) {
  const columns = [
    ["bench", (row) => row.name],
    ["native ms", (row) => show(row.native?.ms, 3)],
    ["WASM ms", (row) => show(row.wasm?.ms, 3)],
    ["WASM / native", (row) => show(row.wasmOverNative, 2)],
    ["native / yardstick", (row) => show(row.native?.ratio, 3)],
    ["WASM / yardstick", (row) => show(row.wasm?.ratio, 3)],
    ["WASM / native yardstick", (row) => show(row.wasmOverNativeYardstick, 3)],
  ];
  const cells = [columns.map(([title]) => title), ...rows.map((row) => columns.map(([, cell]) => cell(row)))];
  const widths = columns.map((_, c) => Math.max(...cells.map((row) => row[c].length)));
  for (const row of cells) {
    console.log(
      row
        .map((cell, c) => (c === 0 ? cell.padEnd(widths[c]) : cell.padStart(widths[c])))
        .join("  ")
        .trimEnd(),
    );
  }
}

await main(async (words) => {
  await setup("bench");
  await buildTargets("release", ["pliant_bench"]);
  await buildTargets("wasm", ["pliant_bench"]);
  const native = await measure("native", join(root, "build/release/bench/pliant_bench"), words);
  const wasm = await measure("WASM", process.execPath,
    ["--no-experimental-fetch", "build/wasm/bench/pliant_bench.cjs", ...words]);
  const rows = merge(native, wasm);
  printTable(rows);
  mkdirSync(join(root, "build"), { recursive: true });
  writeFileSync(
    join(root, "build/bench.json"), `${JSON.stringify({ node: process.version, benches: rows }, null, 2)}\n`,
  );
  console.log("\nbuild/bench.json holds these figures.");
});
