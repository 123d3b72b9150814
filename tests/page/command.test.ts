// A session on the page, exported and run by the command: the same shape, and the same file around it.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeEach, describe, expect, test } from "vitest";
import { dist, farthest } from "./support/browser.ts";
import { exported, openFile } from "./support/files.ts";
import { ask, demo, rest, useVisits, visit } from "./support/visit.ts";

useVisits();
beforeEach(async () => {
  await visit("from a file", { tool: "pose" });
});

const folder = mkdtempSync(join(tmpdir(), "pliant-page-"));
afterAll(() => rmSync(folder, { recursive: true }));

const files = async () => (await import(join(dist, "io.js"))) as typeof import("../../bindings/js/io.ts");

interface Polygons {
  points: number[][];
  faces: number[][];
}

/** A sheet of concave pentagons: arrows beside each other, whose notches no fan of triangles respects. */
function arrows(columns = 16, rows = 16): Polygons {
  const points: number[][] = [];
  const faces: number[][] = [];
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const at = points.length;
      // The second lies inside, so that a fan from the first crosses the outline.
      const corners = [[0, 0], [0.3, 0.45], [0, 1], [1, 1], [1, 0]];
      for (const [x, y] of corners) {
        points.push([(column + x!) / columns, (row + y!) / rows, 0.05 * Math.sin(5 * (column + x!))]);
      }
      faces.push(corners.map((_, k) => at + k));
    }
  }
  return { points, faces };
}

/** A closed post, two units high, of the same arrows with a triangle in each notch. */
function post(around = 16, along = 24): Polygons {
  const at = (column: number, row: number) => {
    const angle = (2 * Math.PI * column) / around;
    return [0.2 * Math.cos(angle), (2 * row) / along, -0.2 * Math.sin(angle)];
  };
  const points: number[][] = [];
  const faces: number[][] = [];
  for (let row = 0; row <= along; row++) for (let column = 0; column < around; column++) points.push(at(column, row));
  for (let row = 0; row < along; row++) {
    for (let column = 0; column < around; column++) {
      const [a, b] = [row * around + column, row * around + ((column + 1) % around)];
      const notch = points.push(at(column + 0.4, row + 0.5)) - 1;
      faces.push([a, b, b + around, a + around, notch], [a, notch, a + around]);
    }
  }
  const ring = Array.from({ length: around }, (_, column) => column);
  faces.push(ring.toReversed(), ring.map((v) => v + around * along));
  return { points, faces };
}

const text = (lines: readonly string[]) => `${lines.join("\n")}\n`;

const obj = ({ points, faces }: Polygons) => text([
  ...points.map((p) => `v ${p.join(" ")}`), ...faces.map((f) => `f ${f.map((v) => v + 1).join(" ")}`),
]);

const colorOf = (v: number) => [v % 251, (3 * v) % 241, 128];

function texturedObj(): string {
  const { points, faces } = arrows();
  return text([
    "# keeps its words", ...points.flatMap((p) => [`v ${p.join(" ")}`, `vt ${p[0]} ${p[1]}`]),
    "usemtl red", ...faces.map((f) => `f ${f.map((v) => `${v + 1}/${v + 1}`).join(" ")}`),
  ]);
}

function coloredPly({ points, faces }: Polygons): string {
  return text([
    "ply", "format ascii 1.0", `element vertex ${points.length}`,
    ...["x", "y", "z"].map((name) => `property double ${name}`),
    ...["red", "green", "blue"].map((name) => `property uchar ${name}`),
    `element face ${faces.length}`, "property list uchar int vertex_indices", "end_header",
    ...points.map((p, v) => [...p, ...colorOf(v)].join(" ")), ...faces.map((f) => [f.length, ...f].join(" ")),
  ]);
}

/** A .glb of the same sheet, made by the library. */
async function glbSheet(): Promise<Uint8Array> {
  const { read, write } = await files();
  return write(await read(new TextEncoder().encode(coloredPly(arrows())), "sheet.ply"), "sheet.glb");
}

/** Exports the session and has the command make it of the file: what is on the screen, and all else alike. */
async function sameByCommand(name: string, content: string | Uint8Array, kind: "obj" | "glb" = "obj") {
  const { diagonal } = await ask((hook) => hook.shape());
  const [positions, script, page] = [await demo.positions(), await exported("script"), await exported(kind)];
  expect(farthest(await rest(), positions, Array((await rest()).length / 3).keys())).toBeGreaterThan(0.05 * diagonal);
  const path = (file: string) => join(folder, file);
  writeFileSync(path(name), content);
  writeFileSync(path("edit.json"), script.bytes);
  const out = `out.${kind}`;
  const args = ["deform", path(name), "--script", path("edit.json"), "--out", path(out), "--quiet"];
  execFileSync(process.execPath, [join(dist, "cli.js"), ...args]);
  const { read } = await files();
  const [ours, theirs] = [await read(page.bytes, page.name), await read(readFileSync(path(out)), out)];
  for (const { positions: written } of [ours, theirs]) {
    expect(written).toHaveLength(positions.length);
    expect(farthest(written, positions)).toBeLessThan(1e-6 * diagonal);
  }
  const faces = ["faceVertices", "faceOffsets", "texcoords", "colors"] as const;
  for (const key of faces) expect(ours[key]).toEqual(theirs[key]);
  return { script: JSON.parse(script.bytes.toString()) as { steps: { method: string; refine?: boolean }[] }, ours };
}

/** A handle on a vertex, dragged twice; left out: four fifths of the way through them. */
async function pull(vertex?: number): Promise<void> {
  await demo.page.keyboard.press("3");
  const { vertices } = await ask((hook) => hook.shape());
  const near = await demo.page.evaluate((v) => window.pliantDemo.vertexAt(v), vertex ?? Math.floor(vertices * 0.8));
  await demo.drag(near, { x: near.x + 20, y: near.y - 60 });
  const handle = await demo.handle(-1);
  await demo.drag(handle, { x: handle.x - 30, y: handle.y - 20 });
}

describe("what is done on the page is what the command makes of", () => {
  const kinds: Record<string, () => string | Promise<Uint8Array>> = {
    "polygons.obj": () => obj(arrows()),
    "textured.obj": texturedObj,
    "colored.ply": () => coloredPly(arrows()),
    "sheet.glb": glbSheet,
  };
  test.each(Object.keys(kinds))("%s", async (name) => {
    const content = await kinds[name]!();
    await openFile(name, content);
    await pull();
    await sameByCommand(name, content, name.endsWith("glb") ? "glb" : "obj");
    const bytes = typeof content === "string" ? new TextEncoder().encode(content) : content;
    const opened = await (await files()).read(bytes, name);
    expect(await ask((hook) => hook.triangles())).toEqual(Array.from(opened.triangles));
  });

  test.each(["embedded-graph", "arap"])("concave polygons under %s", async (method) => {
    await openFile("polygons.obj", obj(arrows()));
    await demo.page.locator("#method-choice").selectOption(method);
    await demo.idle();
    await pull();
    const { script } = await sameByCommand("polygons.obj", obj(arrows()));
    expect(script.steps.map((step) => step.method)).toEqual([method]);
  });
});

describe("a sketch on a post of concave polygons", () => {
  const content = coloredPly(post());
  const strokes = async (...lines: [number, number, number][][]) => {
    for (const line of lines) {
      const places = await demo.page.evaluate((list) => list.map((p) => window.pliantDemo.project(p)), line);
      await demo.drag(places[0]!, ...places.slice(1));
    }
  };
  const along: [number, number, number][] = [[0, 0.6, 0], [0, 1, 0], [0, 1.4, 0], [0, 1.7, 0]];
  const over: [number, number, number][] = [[0, 0.6, 0], [0, 1, 0], [0.25, 1.3, 0], [0.7, 1.45, 0]];
  const far: [number, number, number][] = [[0, 0.6, 0], [0, 1.2, 0], [0.5, 1.7, 0], [1.4, 1.75, 0]];

  test("comes to the same by the command, a handle after it too", async () => {
    await openFile("post.ply", content);
    await demo.page.locator("#tool-sketch").click();
    await strokes(along, over);
    await sameByCommand("post.ply", content);
    await demo.page.locator("#tool-pose").click();
    await demo.idle();
    await pull();
    const { script, ours } = await sameByCommand("post.ply", content);
    expect(script.steps.map((step) => step.method)).toEqual(["sketch", "embedded-graph"]);
    expect(ours.faceOffsets).toHaveLength(post().faces.length + 1);
  });

  test("keeps the polygons that refinement has not split, and the colours of all", async () => {
    await openFile("post.ply", content);
    const { vertices } = await ask((hook) => hook.shape());
    await demo.page.locator("#tool-sketch").click();
    await strokes(along);
    await demo.page.locator("#keep-length").uncheck();
    await strokes(far);
    await demo.page.locator("#refine").check();
    await demo.idle();
    expect((await ask((hook) => hook.shape())).vertices).toBeGreaterThan(vertices);
    const { script, ours } = await sameByCommand("post.ply", content);
    expect(script.steps[0]).toMatchObject({ method: "sketch", refine: true });
    const [, ...ends] = ours.faceOffsets;
    const corners = ends.map((end, face) => end - ours.faceOffsets[face]!);
    expect(corners.filter((count) => count === 5).length).toBeGreaterThan(50);
    expect(corners.length).toBeGreaterThan(post().faces.length);
    expect([...ours.colors.subarray(0, 300)]).toEqual(Array.from({ length: 100 }, (_, v) => colorOf(v)).flat());

    // Also once the refined limb is the rest of another step.
    await demo.page.locator("#tool-pose").click();
    await demo.idle();
    await pull(16 * 6);
    await sameByCommand("post.ply", content);
  });
});
