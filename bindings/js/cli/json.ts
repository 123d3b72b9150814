// JSON from a file, with the place of an error: what the engine reports of it differs between versions.

import { Failure } from "./failure.js";

export function parseJson(path: string, text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    const at = errorPosition(text);
    const before = text.slice(0, at).split("\n");
    const found =
      at < text.length ? `unexpected ${JSON.stringify(String.fromCodePoint(text.codePointAt(at)!))}` : "unexpected end";
    throw new Failure(`${path}:${before.length}:${before[before.length - 1].length + 1}: ${found}; expected JSON`);
  }
}

const blanks = /[ \t\n\r]*/;
const string = /"(?:[^"\\\u0000-\u001f]|\\(?:["\\/bfnrt]|u[0-9a-fA-F]{4}))*"/;
const number = /-?(?:0|[1-9]\d*)(?:\.\d+)?(?:[eE][+-]?\d+)?/;
/** Blanks, then a mark (1) or a value (2). */
const token = new RegExp(
  `${blanks.source}(?:([[\\]{},:])|(${string.source}|${number.source}|true|false|null)(?![\\w.+-]))`, "y",
);

/** Where text that is not JSON stops being JSON: the first token that does not fit. */
export function errorPosition(text: string): number {
  const open: string[] = [];
  let expected: readonly string[] = ["value"];
  token.lastIndex = 0;
  for (;;) {
    const begin = token.lastIndex;
    const match = token.exec(text);
    const blank = /[ \t\n\r]*/y;
    blank.lastIndex = begin;
    const at = begin + blank.exec(text)![0].length;
    if (!match) return at;
    const kind = match[1] ?? (match[2].startsWith('"') ? "string" : "value");
    const next = follow(kind, expected, open);
    if (!next) return at;
    expected = next;
  }
}

/** What may follow a token, or undefined where the token may not stand. */
function follow(kind: string, expected: readonly string[], open: string[]): readonly string[] | undefined {
  if (kind === "string" && expected.includes("key")) return [":"];
  const isValue = kind === "string" || kind === "value";
  if (isValue || kind === "[" || kind === "{") {
    if (!expected.includes("value")) return undefined;
    if (isValue) return afterValue(open);
    open.push(kind);
    return kind === "[" ? ["value", "]"] : ["key", "}"];
  }
  if (!expected.includes(kind)) return undefined;
  if (kind === ":") return ["value"];
  if (kind === ",") return open[open.length - 1] === "[" ? ["value"] : ["key"];
  open.pop();
  return afterValue(open);
}

function afterValue(open: string[]): readonly string[] {
  if (open.length === 0) return [];
  return open[open.length - 1] === "[" ? [",", "]"] : [",", "}"];
}
