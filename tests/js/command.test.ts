// The `pliant` command, end to end: files in, files out.

import { cpSync, mkdirSync, readFileSync, rmSync } from "node:fs";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { Folder, objPositions } from "./support/command.js";
import { half } from "./support/edit_script.js";
import { carried, type GraphState, weights } from "./support/oracle.js";
import { consumer, installed, pliant } from "./support/package.js";
import { barObj, cloud } from "./support/shapes.js";

const folder = new Folder();
afterAll(() => folder.remove());

const bar = barObj(24);
const step = {
  method: "embedded-graph",
  options: { nodeCount: 40 },
  fixed: [half([-1, 0, 0], -0.5)],
  handles: [
    {
      name: "tip",
      select: half([1, 0, 0], 7.5),
      move: { translate: [0, 0, 2], rotate: { axis: [0, 1, 0], degrees: -40 } },
    },
  ],
};
const edit = { format: "pliant-edit", version: 1, steps: [step] };
/** Deforms any shape by holding one half of its box and lifting the far end. */
const anyEdit = {
  ...edit,
  steps: [
    {
      method: "embedded-graph",
      options: { nodeCount: 12 },
      handles: [{ select: { all: true }, move: { translate: [0, 0, 1], scale: 1.5 } }],
    },
  ],
};

const quad = (i: number) =>
  bar
    .split("\n")
    .filter((line) => line.startsWith("f "))
    .map((line) =>
      line
        .slice(2)
        .split(" ")
        .map((corner) => Number(corner.split("/")[0]) - 1),
    )[i];
/** The bar for the library: quads as pairs of triangles. */
const barTriangles = Array.from({ length: 96 }, (_, i) => quad(i)).flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);

beforeAll(() => {
  folder.write("bar.obj", bar);
  folder.write("edit.json", edit);
  folder.write("any.json", anyEdit);
});

describe("pliant", () => {
  it("tells its version and its use", () => {
    const { version } = JSON.parse(readFileSync(join(installed, "package.json"), "utf8"));
    expect(folder.run("--version")).toEqual({ status: 0, out: `${version}\n`, err: "" });
    for (const args of [["--help"], ["deform", "--help"]]) {
      const { status, out } = folder.run(...args);
      expect(status).toBe(0);
      for (const word of ["deform", "inspect", "compare", "--script", "--carry", "--quiet"]) {
        expect(out).toContain(word);
      }
    }
  });

  it("calls what is its own fault so", () => {
    const broken = join(folder.path, "broken");
    mkdirSync(broken);
    cpSync(join(installed, "dist/cli.js"), join(broken, "cli.mjs"));
    const { status, stderr } = spawnSync(process.execPath, [join(broken, "cli.mjs"), "inspect", "bar.obj"], {
      cwd: folder.path, encoding: "utf8",
    });
    rmSync(broken, { recursive: true });
    expect(status).toBe(1);
    expect(stderr).toContain("a defect of pliant");
  });
});

describe("pliant inspect", () => {
  it("says what a shape is made of", () => {
    const { status, out, err } = folder.run("inspect", "bar.obj");
    expect([status, err]).toEqual([0, ""]);
    const words = ["vertices", "100", "components", "boundary edges", "faces", "96", "texture coordinates", "yes"];
    for (const word of words) expect(out).toContain(word);
  });

  it("says it in JSON", () => {
    expect(JSON.parse(folder.run("inspect", "bar.obj", "--json").out)).toEqual({
      format: "obj", vertices: 100, triangles: 192, components: 1, boundaryEdges: 8, nonManifoldEdges: 0,
      degenerateTriangles: 0, weldedVertices: 0, faces: 96, textureCoordinates: true, colors: false,
      diagonal: Math.hypot(8, 1, 1), min: [0, 0, 0], max: [8, 1, 1],
    });
  });
});

describe("pliant deform", () => {
  beforeAll(() => {
    const { status, err } = folder.run(
      "deform", "bar.obj", "--script", "edit.json", "--out", "out.obj", "--report", "report.json", "--state",
      "state.json",
    );
    expect([status, err]).toEqual([0, ""]);
  });

  it("keeps everything of the file but the coordinates", () => {
    const rest = (text: string) => text.split("\n").filter((line) => !line.startsWith("v "));
    expect(rest(folder.text("out.obj"))).toEqual(rest(bar));
  });

  it("gives what the library gives, to the last bit", async () => {
    const shape = pliant.shape({ positions: objPositions(bar), triangles: barTriangles });
    const { positions, report } = await pliant.edit(shape, edit as never);
    expect(objPositions(folder.text("out.obj"))).toEqual(positions);
    const written = folder.json("report.json");
    expect(written).toMatchObject({
      format: "pliant-report", version: 1, shape: report.shape, quality: report.quality,
    });
    expect(written.steps[0].iterations.map((i: { energy: number }) => i.energy)).toEqual(
      report.steps[0].iterations.map((i) => i.energy),
    );
  });

  it("writes a state that leads to the same positions", () => {
    const state = folder.json("state.json") as GraphState;
    const [rest, moved] = [objPositions(bar), objPositions(folder.text("out.obj"))];
    for (let v = 0; v < 100; ++v) {
      const p = Array.from(rest.subarray(3 * v, 3 * v + 3));
      carried(state, p, weights(state, p)).forEach((x, axis) =>
        expect(Math.abs(x - moved[3 * v + axis])).toBeLessThan(1e-6 * 8),
      );
    }
  });

  it.each(["obj", "ply", "off", "xyz", "stl", "glb"])("writes .%s, and reads it again", (format) => {
    expect(folder.run("deform", "bar.obj", "--script", "any.json", "--out", `converted.${format}`).status).toBe(0);
    const found = JSON.parse(folder.run("inspect", `converted.${format}`, "--json").out);
    const direct = JSON.parse(folder.run("inspect", "bar.obj", "--json").out);
    expect(found.format).toBe(format);
    expect(found.vertices - found.weldedVertices).toBe(100);
    expect(found.triangles).toBe(format === "xyz" ? 0 : 192);
    if (format !== "xyz") expect(found.boundaryEdges).toBe(direct.boundaryEdges);
    if (format === "obj" || format === "off" || format === "ply") expect(found.faces).toBe(96);
    expect(found.textureCoordinates).toBe(format === "obj" || format === "ply" || format === "glb");
    const again = folder.run("deform", `converted.${format}`, "--script", "any.json", "--out", `again.${format}`);
    expect([again.status, again.err]).toEqual([0, ""]);
  });

  it("takes points", () => {
    const points = cloud(300);
    const lines = Array.from({ length: 300 }, (_, i) => points.slice(3 * i, 3 * i + 3).join(" "));
    folder.write("points.xyz", `${lines.join("\n")}\n`);
    const properties = ["x", "y", "z"].map((name) => `property double ${name}`);
    const header = ["ply", "format ascii 1.0", "element vertex 300", ...properties, "end_header"];
    folder.write("points.ply", `${[...header, ...lines].join("\n")}\n`);
    for (const name of ["points.xyz", "points.ply"]) {
      const { status, err } = folder.run("deform", name, "--script", "any.json", "--out", `moved-${name}`);
      expect([status, err]).toEqual([0, ""]);
      expect(JSON.parse(folder.run("inspect", `moved-${name}`, "--json").out)).toMatchObject({
        vertices: 300, triangles: 0,
      });
    }
    const numbers = (name: string) => folder.text(name).trim().split("\n").slice(-300);
    expect(numbers("moved-points.ply").map((line) => line.split(" ").map(Number))).toEqual(
      numbers("moved-points.xyz").map((line) => line.split(" ").map(Number)),
    );
  });

  it("is silent where there is no terminal", () => {
    expect(folder.run("deform", "bar.obj", "--script", "edit.json", "--out", "quiet.obj")).toEqual({
      status: 0, out: "", err: "",
    });
    expect(folder.run("deform", "bar.obj", "--script", "edit.json", "--out", "quiet.obj", "--quiet")).toEqual({
      status: 0, out: "", err: "",
    });
  });

  it("shows its progress on a terminal, unless told not to", () => {
    // script(1) gives the command a terminal.
    const bin = join(consumer, "node_modules/.bin/pliant");
    const command = `node ${bin} deform bar.obj --script edit.json --out quiet.obj`;
    const shown = (line: string) =>
      spawnSync("script", ["-qec", line, "/dev/null"], { cwd: folder.path, encoding: "utf8" });
    const { status, stdout } = shown(command);
    expect(status).toBe(0);
    expect(stdout).toMatch(/\r\[#*\.*\] iteration \d+, energy/);
    expect(stdout.endsWith("\r\x1b[K")).toBe(true);
    expect(shown(`${command} --quiet`).stdout).toBe("");
  });

  it("may write over its input", () => {
    folder.write("own.obj", bar);
    expect(folder.run("deform", "own.obj", "--script", "edit.json", "--out", "own.obj").status).toBe(0);
    expect(folder.text("own.obj")).toBe(folder.text("out.obj"));
  });
});

describe("pliant deform --carry", () => {
  const args = ["deform", "bar.obj", "--script", "edit.json", "--out", "out2.obj", "--carry"];

  it("carries the shape's own vertices to where they went", () => {
    expect(folder.run(...args, "bar.obj", "--carry-out", "carried.obj")).toEqual({ status: 0, out: "", err: "" });
    const [a, b] = [objPositions(folder.text("carried.obj")), objPositions(folder.text("out2.obj"))];
    a.forEach((x, i) => expect(Math.abs(x - b[i])).toBeLessThan(1e-12));
  });

  it("keeps every other byte of the file", () => {
    const fancy =
      "# carried along\r\n\to big\nv 1 0.5 0.5 # a corner\nv 2.5e0   0.25 0.75\n" +
      "vt 0.5 0.5\n\nl 1 2\nusemtl none\n";
    folder.write("fancy.obj", fancy);
    expect(folder.run(...args, "fancy.obj", "--carry-out", "fancy-out.obj").status).toBe(0);
    const rest = (text: string) => text.split("\n").filter((line) => !line.startsWith("v "));
    expect(rest(folder.text("fancy-out.obj"))).toEqual(rest(fancy));
    expect(objPositions(folder.text("fancy-out.obj"))).not.toEqual(objPositions(fancy));
  });

  it("takes a file in several pieces", async () => {
    const points = cloud(150_000).map((x, i) => (i % 3 === 0 ? 8 * x : x));
    const lines = Array.from(
      { length: 150_000 }, (_, i) => `${points[3 * i]} ${points[3 * i + 1]} ${points[3 * i + 2]}`,
    );
    folder.write("many.xyz", `${lines.join("\n")}\n`);
    expect(folder.bytes("many.xyz").length).toBeGreaterThan(5e6); // more than one piece
    expect(folder.run(...args, "many.xyz", "--carry-out", "many-out.xyz").status).toBe(0);
    const deformer = pliant.deformer(pliant.shape({ positions: objPositions(bar), triangles: barTriangles }), {
      method: "embedded-graph", nodeCount: 12,
    });
    deformer.restore(folder.json("state.json"));
    const expected = deformer.transformPoints(points);
    const found = Float64Array.from(folder.text("many-out.xyz").trim().split(/\s+/), Number);
    expect(found).toHaveLength(expected.length);
    expect(found.every((x, i) => Math.abs(x - expected[i]) < 1e-9)).toBe(true);
  });

  it("goes through every step of a script", () => {
    folder.write("two.json", {
      ...edit, steps: [step, { ...step, handles: [{ ...step.handles[0], select: { vertices: [96, 97, 98, 99] } }] }],
    });
    expect(
      folder.run(
        "deform", "bar.obj", "--script", "two.json", "--out", "two.obj", "--carry", "bar.obj", "--carry-out",
        "two-carried.obj",
      ).status,
    ).toBe(0);
    const [a, b] = [objPositions(folder.text("two-carried.obj")), objPositions(folder.text("two.obj"))];
    a.forEach((x, i) => expect(Math.abs(x - b[i])).toBeLessThan(1e-12));
  });
});

describe("pliant deform with keyframes", () => {
  const at = (z: number) => [{ ...step, handles: [{ ...step.handles[0], move: { translate: [0, 0, z] } }] }];
  const animation = {
    format: "pliant-edit", version: 1, frames: 3, keyframes: [{ time: 0, steps: at(0) }, { time: 2, steps: at(2) }],
  };

  it("numbers its frames by the pattern", () => {
    folder.write("animation.json", animation);
    expect(
      folder.run(
        "deform", "bar.obj", "--script", "animation.json", "--out", "frame_%04d.obj", "--report", "frames.json",
      ),
    ).toEqual({ status: 0, out: "", err: "" });
    const names = ["frame_0001.obj", "frame_0002.obj", "frame_0003.obj"];
    expect(folder.list().filter((name) => name.startsWith("frame_"))).toEqual(names);
    expect(objPositions(folder.text(names[0]))).toEqual(objPositions(bar));
    folder.write("last.json", { ...edit, steps: at(2) });
    folder.run("deform", "bar.obj", "--script", "last.json", "--out", "last.obj");
    expect(folder.text(names[2])).toBe(folder.text("last.obj"));
    expect(folder.json("frames.json").frames.map((frame: { time: number }) => frame.time)).toEqual([0, 1, 2]);
  });

  it("wants a pattern", () => {
    const { status, err } = folder.run("deform", "bar.obj", "--script", "animation.json", "--out", "frames.obj");
    expect(status).toBe(2);
    expect(err).toContain("frame_%04d.obj");
  });
});

describe("pliant compare", () => {
  it("measures one file against another", () => {
    expect(JSON.parse(folder.run("compare", "bar.obj", "bar.obj", "--json").out)).toMatchObject({
      stretch: { mean: 0, p95: 0, max: 0 }, shear: 0, area: 1, folds: 0, intersections: 0,
    });
    const quality = JSON.parse(folder.run("compare", "bar.obj", "out.obj", "--json").out);
    const { constraintError, ...others } = folder.json("report.json").quality;
    expect(quality).toEqual(others);
    expect(constraintError).toBeGreaterThan(0);
    expect(folder.run("compare", "bar.obj", "out.obj").out).toContain("stretch mean");
  });
});

describe("pliant refuses", () => {
  const good = ["--script", "edit.json", "--out", "never.obj"];
  beforeAll(() => {
    folder.write("broken.obj", "v 0 0 0\nv 1 zero 0\n");
    folder.write("empty.obj", "# nothing\n");
    folder.write("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    folder.write("nan.obj", "v 0 0 nan\n");
    folder.write("broken.glb", "not a glb at all");
    folder.write("comma.json", '{ "format": "pliant-edit",\n  "version": 1,,\n}');
    folder.write("cut.json", '{ "format": ');
    folder.write("typo.json", { ...edit, steps: [{ ...step, handles: [step.handles[0], { mvoe: 1 }] }] });
    folder.write("nothing.json", { ...edit, steps: [{ ...step, handles: [{ select: half([1, 0, 0], 99) }] }] });
    folder.write("surface.json", { ...edit, steps: [step, { ...step, method: "arap", options: {} }] });
    folder.write("unasked.json", { ...edit, steps: [{ method: "edge-material", options: { gravity: [0, 0, 0] } }] });
    mkdirSync(join(folder.path, "folder.obj"));
  });

  it.each<[what: string, args: string[], ...says: string[]]>([
    ["no command", [], "no command"],
    ["an unknown command", ["bend", "bar.obj"], '"bend"'],
    ["animate, which is not here yet", ["animate", "bar.obj"], "animate", "not in this build yet"],
    ["no shape", ["inspect"], "inspect takes SHAPE"],
    ["two shapes", ["inspect", "bar.obj", "bar.obj"], "2 files"],
    ["no script", ["deform", "bar.obj", "--out", "never.obj"], "--script"],
    ["no output", ["deform", "bar.obj", "--script", "edit.json"], "--out"],
    ["an unknown option", ["deform", "bar.obj", ...good, "--fast"], "--fast"],
    ["an option without its value", ["deform", "bar.obj", "--script"], "--script"],
    ["--carry alone", ["deform", "bar.obj", ...good, "--carry", "bar.obj"], "--carry-out"],
    ["a carried file of another format", ["deform", "bar.obj", ...good, "--carry", "bar.obj", "--carry-out", "x.ply"],
      "x.ply", ".obj"],
    ["a carried .glb", ["deform", "bar.obj", ...good, "--carry", "x.glb", "--carry-out", "y.glb"], "x.glb", ".ply"],
    ["an unknown extension", ["deform", "bar.obj", "--script", "edit.json", "--out", "never.fbx"],
      "never.fbx", ".fbx", ".obj"],
    ["no extension", ["inspect", "bar"], "bar", "missing"],
    ["a file that is not there", ["deform", "gone.obj", ...good], "gone.obj", "no such file"],
    ["a script that is not there", ["deform", "bar.obj", "--script", "gone.json", "--out", "never.obj"],
      "gone.json", "no such file"],
    ["a folder for a shape", ["inspect", "folder.obj"], "folder.obj", "folder"],
    ["a broken file", ["deform", "broken.obj", ...good], "broken.obj", "line 2"],
    ["an empty file", ["inspect", "empty.obj"], "empty.obj"],
    ["a face of vertices that are not there", ["inspect", "far.obj"], "far.obj", "line 4", "4"],
    ["a coordinate that is not finite", ["inspect", "nan.obj"], "nan.obj"],
    ["a broken .glb", ["inspect", "broken.glb"], "broken.glb", ".glb"],
    ["a script that is not JSON", ["deform", "bar.obj", "--script", "comma.json", "--out", "never.obj"],
      "comma.json:2:16", '","'],
    ["a script cut short", ["deform", "bar.obj", "--script", "cut.json", "--out", "never.obj"], "cut.json:1:13", "end"],
    ["an unknown key in a script", ["deform", "bar.obj", "--script", "typo.json", "--out", "never.obj"],
      "typo.json", "steps[0].handles[1].mvoe"],
    ["a selection of nothing", ["deform", "bar.obj", "--script", "nothing.json", "--out", "never.obj"],
      "nothing.json", "steps[0].handles[0].select", "no vertex"],
    ["a folder that is not there for output", ["deform", "bar.obj", "--script", "edit.json", "--out", "gone/never.obj"],
      "gone/never.obj", "no such file"],
    ["a report that cannot be written", ["deform", "bar.obj", ...good, "--report", "gone/report.json"],
      "gone/report.json"],
    ["a carried file that is not there",
      ["deform", "bar.obj", ...good, "--carry", "gone.obj", "--carry-out", "never2.obj"], "gone.obj", "no such file"],
    ["a broken carried file", ["deform", "bar.obj", ...good, "--carry", "broken.obj", "--carry-out", "never2.obj"],
      "broken.obj", "line 2"],
    [
      "a method that carries nothing",
      ["deform", "bar.obj",
        "--script", "surface.json", "--out", "never.obj", "--carry", "bar.obj", "--carry-out", "never2.obj"],
      "surface.json",
      "steps[1].method",
      "arap",
      "--carry",
    ],
    ["a method for surfaces over points", ["deform", "points.xyz", "--script", "unasked.json", "--out", "never.obj"],
      "unasked.json", "steps[0]", "or a load"],
    ["faces where there are none to write", ["deform", "points.xyz", "--script", "any.json", "--out", "never.stl"],
      "never.stl"],
    ["a comparison of different vertices", ["compare", "bar.obj", "points.xyz"], "points.xyz", "300 vertices", "100"],
  ])("%s", (_, args, ...says) => {
    const before = folder.list();
    const { status, out, err } = folder.run(...args);
    expect(status).toBe(2);
    expect(out).toBe("");
    expect(err).toMatch(/^pliant: [^\n]+\n$/);
    for (const words of says) expect(err).toContain(words);
    expect(folder.list()).toEqual(before);
  });
});
