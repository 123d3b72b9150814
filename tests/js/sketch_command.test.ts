// Sketch steps through the command: files in, files out, texture coordinates through a refinement.

import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { Folder, objPositions } from "./support/command.js";
import { script } from "./support/edit_script.js";
import { arc, camera, curved, limb, longArc, pixel, straight } from "./support/limb.js";
import { pliant } from "./support/package.js";

const folder = new Folder();
afterAll(() => folder.remove());

const around = 8;
const rings = 13;
const bend = { method: "sketch", camera, reference: straight, bend: { target: arc } };
const stretch = { ...bend, bend: { target: longArc }, refine: true };
const edit = (...steps: object[]) => script(steps);

/**
 * The limb as quads and two caps of `around` corners; u runs once around it, v along, and a seam lies where u is 0 and
 * 1.
 */
function quads(): string {
  const { positions } = limb(around, rings);
  const lines = ["mtllib skin.mtl"];
  for (let v = 0; v < around * rings; ++v) lines.push(`v ${positions.slice(3 * v, 3 * v + 3).join(" ")}`);
  for (let j = 0; j < rings; ++j) for (let i = 0; i <= around; ++i) lines.push(`vt ${i / around} ${j / (rings - 1)}`);
  const corner = (i: number, j: number) => `${j * around + (i % around) + 1}/${j * (around + 1) + i + 1}`;
  for (let j = 0; j + 1 < rings; ++j) {
    for (let i = 0; i < around; ++i) {
      lines.push(`f ${corner(i, j)} ${corner(i + 1, j)} ${corner(i + 1, j + 1)} ${corner(i, j + 1)}`);
    }
  }
  const cap = Array.from({ length: around }, (_, i) => i);
  lines.push(
    `f ${cap.map((i) => corner(around - 1 - i, 0)).join(" ")}`, `f ${cap.map((i) => corner(i, rings - 1)).join(" ")}`,
  );
  return `${lines.join("\n")}\n`;
}

interface Face {
  vertices: number[];
  uv: number[][];
}

function facesOf(obj: string): Face[] {
  const lines = obj.split("\n");
  const texcoords = lines
    .filter((line) => line.startsWith("vt "))
    .map((line) => line.split(" ").slice(1, 3).map(Number));
  return lines
    .filter((line) => line.startsWith("f "))
    .map((line) => {
      const corners = line
        .trim()
        .split(" ")
        .slice(1)
        .map((corner) => corner.split("/").map(Number));
      return { vertices: corners.map(([v]) => v - 1), uv: corners.map(([, t]) => texcoords[t - 1]) };
    });
}

const run = (script: object, out = "out.obj", ...more: string[]) => {
  folder.write("edit.json", script);
  return folder.run(
    "deform", "limb.obj", "--script", "edit.json", "--out", out, "--state", "state.json", "--report", "report.json",
    ...more,
  );
};

beforeAll(() => void folder.write("limb.obj", quads()));

/** The limb of the file for the library: polygons as the state's results need no faces, ids are the same. */
const positions = objPositions(quads());
const triangles = facesOf(quads()).flatMap(({ vertices }) =>
  vertices.slice(2).flatMap((v, i) => [vertices[0], vertices[i + 1], v]),
);

describe("pliant deform with a sketch", () => {
  it("replays what was drawn, bit for bit", () => {
    const sketch = pliant.sketch(pliant.shape({ positions, triangles }), { camera, reference: straight });
    // As on a page: a preview with every event, then the stroke as it is at the end.
    for (let samples = 10; samples < arc.length; samples += 9) sketch.bend(arc.slice(0, samples), { unfinished: true });
    sketch.bend(arc);
    expect(run(edit(bend))).toEqual({ status: 0, out: "", err: "" });
    expect(objPositions(folder.text("out.obj"))).toEqual(sketch.positions(new Float64Array(positions.length)));
    expect(folder.json("state.json")).toMatchObject(JSON.parse(JSON.stringify(sketch.state())));
    expect(folder.json("report.json").steps).toMatchObject([{ method: "sketch", converged: true }]);
    expect(facesOf(folder.text("out.obj"))).toEqual(facesOf(quads()));
    expect(folder.text("out.obj")).toContain("mtllib skin.mtl");
  });

  it("keeps polygons that a refinement does not split, and gives new corners texture coordinates", () => {
    expect(run(edit(stretch)).status).toBe(0);
    const out = folder.text("out.obj");
    const { parents, rest } = folder.json("state.json") as { parents: number[][]; rest: number[][] };
    expect(parents.length).toBeGreaterThan(10);
    expect(objPositions(out)).toHaveLength(positions.length + 3 * parents.length);
    const [before, after] = [facesOf(quads()), facesOf(out)];
    const kept = after.filter(({ vertices }) => vertices.length > 3);
    expect(kept.length).toBeGreaterThan(10);
    for (const face of kept) expect(before).toContainEqual(face);
    expect(after.some(({ vertices }) => vertices.length === 3)).toBe(true);
    // Along the limb v is z at rest, also of added vertices; u is their angle, and jumps at the seam only.
    const place = (v: number) =>
      v < positions.length / 3 ? Array.from(positions.slice(3 * v, 3 * v + 3)) : rest[v - positions.length / 3];
    for (const { vertices, uv } of after.filter((face) => face.vertices.length === 3)) {
      vertices.forEach((v, i) => {
        const [x, y, z] = place(v);
        expect(uv[i][1]).toBeCloseTo(z, 12);
        const apart = Math.abs(uv[i][0] - (Math.atan2(y, x) / (2 * Math.PI) - 0.5 / around + 1) % 1);
        // Chords for arcs: the middle of an edge around the limb has the middle's angle, others nearly.
        expect(Math.min(apart, 1 - apart)).toBeLessThan(0.1 / around);
      });
      expect(Math.max(...uv.map(([u]) => u)) - Math.min(...uv.map(([u]) => u))).toBeLessThanOrEqual(1 / around + 1e-12);
    }
  });

  it("refines for every format", () => {
    for (const format of ["ply", "off", "stl", "glb"]) {
      expect(run(edit(stretch), `out.${format}`).status).toBe(0);
      const { triangles: count } = JSON.parse(folder.run("inspect", `out.${format}`, "--json").out);
      expect(count).toBeGreaterThan(triangles.length / 3);
    }
  });

  it("goes on after a refinement, by a solver and by another sketch", () => {
    const lift = {
      method: "embedded-graph",
      options: { nodeCount: 30 },
      handles: [{ select: { all: true }, move: { translate: [0, 1, 0] } }],
    };
    expect(
      run(edit(stretch, lift, { ...bend, region: "previous", bend: { target: curved(0, 0.2, 0.8, () => -1) } })).status,
    ).toBe(0);
    const { steps, quality } = folder.json("report.json");
    expect(steps.map(({ method }: { method: string }) => method)).toEqual(["sketch", "embedded-graph", "sketch"]);
    expect(quality.stretch.mean).toBeGreaterThan(0);
    expect(objPositions(folder.text("out.obj"))).toHaveLength(positions.length + 3 * steps[0].added);
  });

  it("makes frames between key poses", () => {
    const script = {
      format: "pliant-edit", version: 1, frames: 3,
      keyframes: [{ time: 0, steps: [{ ...bend, morph: 0 }] }, { time: 1, steps: [{ ...bend, morph: 1 }] }],
    };
    expect(run(script, "frame_%d.obj").status).toBe(0);
    expect(objPositions(folder.text("frame_1.obj"))).toEqual(positions);
    expect(run(edit({ ...bend, morph: 0.5 })).status).toBe(0);
    const apart = objPositions(folder.text("frame_2.obj")).map((x, i) =>
      Math.abs(x - objPositions(folder.text("out.obj"))[i]),
    );
    expect(Math.max(...apart)).toBeLessThan(1e-12);
  });

  it.each([
    ["an unknown key", { ...bend, twirl: 3 }, "steps[0].twirl"],
    ["nothing asked for", { method: "sketch", camera, reference: straight }, "asks for nothing"],
    ["a stroke beside the shape's picture", { ...bend, partitions: [[pixel(0.8, 0.5), pixel(0.9, 0.5)]] },
      "partitions[0] cuts nothing off"],
  ])("says in one line what is wrong: %s", (_, step, says) => {
    folder.write("edit.json", edit(step));
    const { status, out, err } = folder.run("deform", "limb.obj", "--script", "edit.json", "--out", "none.obj");
    expect([status, out]).toEqual([2, ""]);
    expect(err).toMatch(/^pliant: edit\.json: .*\n$/);
    expect(err).toContain(says);
    expect(folder.list().some((name) => name.includes("none"))).toBe(false);
  });

  it("refuses to carry what is not on the surface", () => {
    folder.write("edit.json", edit(bend));
    const { status, err } = folder.run(
      "deform", "limb.obj", "--script", "edit.json", "--out", "none.obj", "--carry", "limb.obj", "--carry-out",
      "carried.obj",
    );
    expect(status).toBe(2);
    expect(err).toContain("sketch");
    expect(folder.list().some((name) => name.includes("none") || name.includes("carried"))).toBe(false);
  });
});
