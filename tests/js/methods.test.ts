// pliant.methods: one table for menus, sliders and documentation, held against C++ and against the README.

import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { entries, pliant } from "./support/package.js";
import { sheet } from "./support/shapes.js";

const shape = pliant.shape(sheet(20));
const { vertices } = shape.report;

type Method = (typeof pliant.methods)[number];
type Option = Method["options"][string];

const build = (method: string, options: object) => pliant.deformer(shape, { method, ...options } as never);
const read = (deformer: ReturnType<typeof build>) => deformer.options() as Record<string, unknown>;

/** Values of compound options, none of them the default. */
const compound: Record<string, unknown[]> = {
  points: [[[0, 0, 0], [0.5, 0.5, 0], [1, 1, 0], [1, 0, 0], [0, 1, 0]]],
  stiffness: [[{ select: { vertices: [0, 1, 40] }, factor: 0.25 }, { select: { vertices: [7] }, factor: 8 }]],
  cuts: [[[{ vertices: [0, 1] }, { vertices: [40] }], [{ vertices: [2] }, { vertices: [50, 51, 52] }]]],
  field: [
    { axis: [0, 1, 0] }, { curvature: "max" }, { curvature: "min" }, { geodesic: [3, 4] },
    { strokes: [[[0, 0, 0], [0.5, 0, 0]], [[0, 1, 0], [0.5, 1, 0], [1, 1, 0]]] },
  ],
};

/** Values that are not the default, of every kind that an option takes. */
function otherValues({ type, default: usual, min, max, choices, step }: Option): unknown[] {
  if (type === "boolean") return [!usual];
  if (type === "choice") return choices!.filter((name) => name !== usual);
  if (type === "integer") return [usual === min ? max! : min!];
  if (type === "number") return [min!, max!, min! + step!].filter((value) => value !== usual);
  if (type === "vector") return [[0, 0.25, -2]];
  return compound[type]!;
}

const rows = pliant.methods.flatMap((method) =>
  Object.entries(method.options).map(([name, option]) => ({ method, name, option })),
);

describe("pliant.methods", () => {
  it.each(pliant.methods.map((method) => [method.name, method] as const))(
    "tells the defaults of %s as C++ has them",
    (name, { options }) => {
      const inUse = read(build(name, {}));
      const told = Object.fromEntries(
        Object.entries(options)
          .filter(([, option]) => option.default !== null)
          .map(([key, option]) => [key, option.default]),
      );
      expect(inUse).toEqual(told);
    },
  );

  it.each(rows.map((row) => [row.method.name, row.name, row] as const))(
    "%s takes %s to C++ and back, whatever its value",
    (method, name, { option }) => {
      for (const value of otherValues(option)) {
        const options = read(build(method, { [name]: value }));
        expect(options[name]).toEqual(value);
        expect(options[name]).not.toEqual(option.default);
        expect(read(build(method, options))).toEqual(options);
      }
    },
  );

  it.each(rows.filter(({ option }) => option.live).map((row) => [row.method.name, row.name, row] as const))(
    "%s changes %s alone while it lives, and nothing for a bad one",
    (method, name, { option }) => {
      for (const value of otherValues(option)) {
        const deformer = build(method, {});
        const before = read(deformer);
        deformer.setOptions({ [name]: value } as never);
        const after = read(deformer);
        expect(after[name]).toEqual(value);
        const stays = Object.keys(before).filter((key) => key !== name && key in after);
        for (const key of stays) expect(after[key]).toEqual(before[key]);
        expect(() => deformer.setOptions({ [name]: Number.NaN } as never)).toThrow(`options.${name}`);
        expect(read(deformer)).toEqual(after);
      }
    },
  );

  it("gives back what it said before where an option of its own stands for another", () => {
    const material = build("edge-material", { stretch: 3 });
    material.setOptions({ lambda: 0.5 } as never);
    expect(read(material)).toMatchObject({ lambda: 0.5 });
    expect(read(material)).not.toHaveProperty("stretch");
    material.setOptions({ stretch: 2 } as never);
    expect(read(material)).toMatchObject({ stretch: 2 });
    expect(read(material)).not.toHaveProperty("lambda");
    material.setOptions({ bend: 0 } as never);
    expect(() => material.setOptions({ stretch: 0 } as never)).toThrow(/bend and stretch of 0/);
    expect(read(material)).toMatchObject({ stretch: 2, bend: 0 });
  });

  it("says what is live, what carries, loads and draws as it is", () => {
    for (const { name, carries, loads, draws, options } of pliant.methods) {
      const deformer = build(name, {});
      const attempt = (action: () => unknown) => { try { action(); return true; } catch { return false; } };
      expect(attempt(() => deformer.transformPoints([0, 0, 0]))).toBe(carries);
      expect(attempt(() => deformer.field())).toBe(draws.includes("field"));
      expect("nodes" in deformer.state() && "edges" in deformer.state()).toBe(draws.includes("graph"));
      expect(Object.values(options).some(({ type }) => type === "vector")).toBe(loads);
      for (const [key, option] of Object.entries(options)) {
        expect(attempt(() => deformer.setOptions({ [key]: otherValues(option)[0] } as never))).toBe(option.live);
      }
    }
  });

  it("has ranges that hold the default, words for all, and counts below what there is", () => {
    for (const { option } of rows) {
      expect(option.title).toMatch(/^[A-Z]/);
      expect(option.help).toMatch(/\.$/);
      expect(option.min === null).toBe(!["number", "integer", "vector"].includes(option.type));
      if (option.min === null || option.default === null || option.type === "vector") continue;
      expect(option.default).toBeGreaterThanOrEqual(option.min);
      expect(option.default).toBeLessThanOrEqual(option.max!);
    }
    const counts = rows.filter(({ option }) => option.limit === "vertices");
    expect(counts.map(({ name }) => name)).toContain("nodeCount");
    for (const { method, name } of counts) {
      expect(() => build(method.name, { [name]: vertices + 1 })).toThrow(`to ${vertices}`);
    }
  });

  it("is the same in a worker", async () => {
    const worker = await entries.worker.init();
    expect(worker.methods).toEqual(pliant.methods);
    worker.dispose();
  });
});

describe("the words about states", () => {
  const text = readFileSync(new URL("../../docs/state-and-report.md", import.meta.url), "utf8");
  const words = (part: string) => new Set(part.match(/\w+/g));
  const ofAll = /- All solvers:[^]*?(?=\n- )/.exec(text)![0];

  it.each(pliant.methods.map(({ name }) => name))("name the fields of %s", (name) => {
    const own = new RegExp(`\\n- \`${name}\`:[^]*?(?=\\n- |$)`).exec(text)?.[0] ?? "";
    const known = words(ofAll + own);
    for (const field of Object.keys(build(name, {}).state())) expect(known).toContain(field);
  });
});

describe("the README's words about methods", () => {
  const text = readFileSync(new URL("../../README.md", import.meta.url), "utf8");
  const words = (value: unknown) => {
    if (Array.isArray(value)) return ` \`[${value.join(", ")}]\``;
    return value === null ? "" : typeof value === "string" ? ` \`"${value}"\`` : ` ${value}`;
  };

  it.each(pliant.methods.map((method) => [method.name, method] as const))(
    "name %s in the table and all its options with their defaults",
    (name, { options, paper }) => {
      const row = text.split("\n").find((line) => line.startsWith(`| \`${name}\` |`));
      expect(row).toContain("| done");
      for (const author of paper.split(":")[0]!.split(", ")) expect(row).toContain(author);
      const start = text.indexOf(`Options of \`${name}\``);
      expect(start).toBeGreaterThan(0);
      const paragraph = text.slice(start, text.indexOf("\n\n", start)).replaceAll("\n", " ");
      for (const [key, { default: usual, choices }] of Object.entries(options)) {
        expect(paragraph).toContain(`\`${key}\`${words(usual)}`);
        for (const choice of choices ?? []) expect(paragraph).toContain(`"${choice}"`);
      }
      const known = new Set(Object.keys(options));
      for (const [, word] of paragraph.matchAll(/`([a-z]+[A-Z]\w*)`/g)) {
        expect(known, `${word} of ${name}`).toContain(word);
      }
    },
  );

  it("have a row only for methods that are there or planned", () => {
    const table = [...text.matchAll(/^\| `([a-z-]+)` \|.*\| (\w+)/gm)].map(([, name, state]) => ({ name, state }));
    const done = table.filter(({ name, state }) => state === "done" && name !== "sketch").map(({ name }) => name);
    expect(new Set(done)).toEqual(new Set(pliant.methods.map(({ name }) => name)));
  });
});
