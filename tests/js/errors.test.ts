// Every bad argument of the calls: its code, what the message names, and that the next correct call works.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, describe, expect, it } from "vitest";
import { entries, errorOf, pliant, PliantError } from "./support/package.js";
import { sheet, where } from "./support/shapes.js";

const mesh = sheet(11);
const shape = pliant.shape(mesh);
const options = { method: "embedded-graph", nodeCount: 20 };
const left = where(mesh.positions, (x) => x < 0.15);
const right = where(mesh.positions, (x) => x > 0.9);
const deformer = pliant.deformer(shape, options as never);
deformer.setFixed(left);
const hand = deformer.addHandle(right);

type Row = [what: string, action: () => unknown, code: string, ...says: string[]];

/** Calls with arguments that the types refuse too. */
const make = (input: unknown) => () => pliant.shape(input as never);
const build = (more: object) => () => pliant.deformer(shape, { ...options, ...more } as never);
const surface = (options: object) => () => pliant.deformer(shape, { method: "arap", ...options } as never);
const material = (options: object) => () => pliant.deformer(shape, { method: "edge-material", ...options } as never);
const move = (transform: unknown) => () => hand.move(transform as never);
const fix = (vertices: unknown) => () => deformer.setFixed(vertices as never);
const grab = (vertices: unknown) => () => deformer.addHandle(vertices as never);
const solve = (more: unknown) => () => deformer.solve(more as never);
const select = (selection: unknown) => () => shape.select(selection as never);
const restore = (state: unknown) => () => deformer.restore(state as never);

const triangle = [0, 0, 0, 1, 0, 0, 0, 1, 0];
const endless = function* () { for (let i = 0; ; ++i) yield i; };

/** As an array is left that was transferred to a worker. */
function gone<T extends Float32Array | Int32Array>(array: T): T {
  structuredClone(array, { transfer: [array.buffer as ArrayBuffer] });
  return array;
}

const shapes: Row[] = [
  ["positions that are gone", make({ positions: gone(Float32Array.from(triangle)) }),
    "invalid-shape", "positions", "Float32Array", "gone"],
  ["nothing", make(undefined), "invalid-shape", "shape", "undefined", "object"],
  ["no positions", make({}), "invalid-shape", "positions", "undefined"],
  ["no vertices", make({ positions: [] }), "invalid-shape", "positions", "empty"],
  ["a length that is not a multiple", make({ positions: [1, 2, 3, 4] }),
    "invalid-shape", "positions", "length 4", "divisible by 3"],
  ["a coordinate that is not a number", make({ positions: [0, 0, NaN] }),
    "invalid-shape", "positions[2]", "NaN", "finite"],
  ["an infinite coordinate", make({ positions: Float32Array.of(0, Infinity, 0) }),
    "invalid-shape", "positions[1]", "Infinity"],
  ["a coordinate as text", make({ positions: [0, "1", 0] }), "invalid-shape", "positions[1]", '"1"'],
  ["coordinates beyond all reason", make({ positions: [0, 0, 1e300] }), "invalid-shape", "1e+300"],
  ["positions as text", make({ positions: "0 0 0" }), "invalid-shape", "positions", '"0 0 0"'],
  ["triangles that are cut short", make({ positions: triangle, triangles: [0, 1] }),
    "invalid-shape", "triangles", "length 2", "divisible by 3"],
  ["a triangle out of range", make({ positions: triangle, triangles: [0, 1, 3] }),
    "invalid-shape", "triangles[2]", "3", "from 0 to 2"],
  ["a negative id", make({ positions: triangle, triangles: [0, -1, 2] }), "invalid-shape", "triangles[1]", "-1"],
  ["half an id", make({ positions: triangle, triangles: [0, 0.5, 2] }), "invalid-shape", "triangles[1]", "0.5"],
  ["an id that is not a number", make({ positions: triangle, triangles: [0, NaN, 2] }),
    "invalid-shape", "triangles[1]", "NaN"],
  ["a fourth dimension", make({ positions: triangle, dimension: 4 }), "invalid-shape", "dimension", "4", "2 or 3"],
  ["an unknown key", make({ positions: triangle, indices: [0, 1, 2] }),
    "invalid-shape", "shape.indices", "positions, triangles, dimension"],
  ["too many vertices", make({ positions: new Float32Array(24_000_003) }),
    "too-large", "positions", "8000001", "8000000"],
];

const deformers: Row[] = [
  ["no shape", () => pliant.deformer(undefined as never, options as never), "invalid-option", "shape", "undefined"],
  ["something else for a shape", () => pliant.deformer({} as never, options as never),
    "invalid-option", "shape", "Shape"],
  ["no options", () => pliant.deformer(shape, undefined as never), "invalid-option", "options"],
  ["no method", () => pliant.deformer(shape, {} as never),
    "invalid-option", "options.method", "undefined", "embedded-graph"],
  ["an unknown method", build({ method: "magic" }), "invalid-option", "options.method", '"magic"'],
  ...["volumetric-graph"].map((method): Row =>
    [`${method}, which is not here yet`, build({ method }), "invalid-option", method, "not in this build yet"]),
  ["sketch as a solver", build({ method: "sketch" }), "invalid-option", "options.method", "pliant.sketch"],
  ["an option of another method", material({ energy: "spokes" }),
    "invalid-option", "options.energy", "option of edge-material", "pStretch"],
  ["an energy that is none", surface({ energy: "membrane" }),
    "invalid-option", "options.energy", '"membrane"', '"spokes" or "spokes-and-rims"'],
  ["a constraintWeight of zero for arap", surface({ constraintWeight: 0 }),
    "invalid-option", "options.constraintWeight", "0", "above 0"],
  ["more smoothness than there is", surface({ smoothness: 1.1 }),
    "invalid-option", "options.smoothness", "1.1", "from 0 to 1"],
  ...["stretch", "lambda", "bend"].map((name): Row => [
    `a ${name} below zero`, material({ [name]: -1 }), "invalid-option", `options.${name}`, "-1", "0 or above",
  ]),
  ...["pStretch", "pBend"].flatMap((name): Row[] => [
    [`a ${name} above 1`, material({ [name]: 2 }), "invalid-option", `options.${name}`, "2", "from 0 to 1"],
    [`a ${name} that is not a number`, material({ [name]: NaN }), "invalid-option", `options.${name}`, "NaN"],
  ]),
  ["stretch and lambda", material({ stretch: 1, lambda: 1 }), "invalid-option", "options", "stretch and lambda"],
  ["a material without stiffness", material({ stretch: 0, bend: 0 }),
    "invalid-option", "options", "bend and stretch of 0"],
  ["gravity in the plane", material({ gravity: [0, -1] }),
    "invalid-option", "options.gravity", "length 2", "3 finite numbers"],
  ["gravity nowhere", material({ gravity: [0, 0, NaN] }), "invalid-option", "options.gravity[2]", "NaN"],
  ["a field that is none", material({ field: "axis" }), "invalid-option", "options.field", '"axis"', "object"],
  ["a field of nothing", material({ field: {} }),
    "invalid-option", "options.field", "0 keys", "strokes, axis, curvature, geodesic"],
  ["a field of two kinds", material({ field: { axis: [1, 0, 0], curvature: "max" } }),
    "invalid-option", "options.field", "2 keys"],
  ["an unknown field", material({ field: { swirl: 1 } }), "invalid-option", "options.field.swirl", "strokes"],
  ["an axis that points nowhere", material({ field: { axis: [0, 0, 0] } }),
    "invalid-option", "options.field.axis", "zero vector"],
  ["an unknown curvature", material({ field: { curvature: "mean" } }),
    "invalid-option", "options.field.curvature", '"mean"', '"max" or "min"'],
  ["no strokes", material({ field: { strokes: [] } }), "invalid-option", "options.field.strokes", "empty"],
  ["a stroke of one point", material({ field: { strokes: [[[0, 0, 0]]] } }),
    "invalid-option", "options.field.strokes[0]", "length 1", "at least 2 points"],
  ["a stroke to nowhere", material({ field: { strokes: [[[0, 0, 0], [0, NaN, 0]]] } }),
    "invalid-option", "options.field.strokes[0][1][1]", "NaN"],
  ["a stroke without length", material({ field: { strokes: [[[0, 0, 0], [0, 0, 0]]] } }),
    "invalid-option", "field.strokes[0]", "no length"],
  ["paths from no vertex", material({ field: { geodesic: [] } }), "invalid-option", "options.field.geodesic", "empty"],
  ["paths from a vertex that is not there", material({ field: { geodesic: [121] } }),
    "invalid-option", "options.field.geodesic[0]", "121", "from 0 to 120"],
  ["paths from an empty region", material({ field: { geodesic: { sphere: { center: [9, 9, 9], radius: 1 } } } }),
    "invalid-option", "options.field.geodesic", "no vertex"],
  ["points for a surface", () => pliant.deformer(pliant.shape({ positions: triangle }), { method: "arap" }),
    "invalid-shape", "no triangles", "arap"],
  ["an unknown option", build({ nodecount: 3 }),
    "invalid-option", "options.nodecount", "option of embedded-graph", "nodeCount"],
  ["no nodes at all", build({ nodeCount: 0 }), "invalid-option", "options.nodeCount", "0", "from 1 to 121"],
  ["more nodes than vertices", build({ nodeCount: 122 }),
    "invalid-option", "options.nodeCount", "122", "from 1 to 121"],
  ["half a node", build({ nodeCount: 1.5 }), "invalid-option", "options.nodeCount", "1.5"],
  ["nodes and a count", build({ nodes: [[0, 0, 0]] }), "invalid-option", "nodes and nodeCount"],
  ["nodes and sampling", build({ nodeCount: undefined, nodes: [[0, 0, 0]], sampling: "surface" }),
    "invalid-option", "nodes and sampling"],
  ["empty nodes", build({ nodeCount: undefined, nodes: [] }), "invalid-option", "options.nodes", "empty"],
  ["a node in the plane", build({ nodeCount: undefined, nodes: [[0, 0]] }),
    "invalid-option", "options.nodes[0]", "length 2", "3 finite numbers"],
  ["a node nowhere", build({ nodeCount: undefined, nodes: [[0, 0, NaN]] }),
    "invalid-option", "options.nodes[0][2]", "NaN"],
  ["an unknown sampling", build({ sampling: "random" }),
    "invalid-option", "options.sampling", '"random"', '"surface" or "simplify"'],
  ["no neighbours", build({ neighbours: 0 }), "invalid-option", "options.neighbours", "0"],
  ["more neighbours than nodes", build({ neighbours: 21 }), "invalid-option", "options.neighbours", "21", "20 nodes"],
  ["more neighbours than the default's nodes", build({ nodeCount: undefined, neighbours: 122 }),
    "invalid-option", "neighbours", "122"],
  ...["rotationWeight", "regularizationWeight", "constraintWeight"].flatMap((name): Row[] => [
    [`a ${name} of zero`, build({ [name]: 0 }), "invalid-option", `options.${name}`, "0", "above 0"],
    [`a ${name} that is not a number`, build({ [name]: NaN }), "invalid-option", `options.${name}`, "NaN"],
  ]),
  ["an unknown solver", build({ solver: "newton" }),
    "invalid-option", "options.solver", '"newton"', '"auto" or "gauss-newton"'],
  ["exactly maybe", build({ exactHandles: "yes" }), "invalid-option", "options.exactHandles", '"yes"', "true or false"],
  ["refine as a number", build({ refine: 1 }), "invalid-option", "options.refine"],
  ["a negative seed", build({ seed: -1 }), "invalid-option", "options.seed", "-1"],
  ["no cuts in cuts", build({ cuts: [] }), "invalid-option", "options.cuts", "empty"],
  ["half a cut", build({ cuts: [[{ all: true }]] }), "invalid-option", "options.cuts[0]", "pair"],
  ["a cut of nothing", build({ cuts: [[{ vertices: [1] }, { sphere: { center: [9, 9, 9], radius: 1 } }]] }),
    "invalid-option", "options.cuts[0][1]", "no vertex"],
  ["a cut through a vertex", build({ cuts: [[{ all: true }, { vertices: [3] }]] }),
    "invalid-option", "cuts", "both sides"],
  [
    "simplification without triangles",
    () => pliant.deformer(pliant.shape({ positions: triangle }), { method: "embedded-graph", sampling: "simplify" }),
    "invalid-option",
    "sampling",
    "no triangles",
  ],
];

const handles: Row[] = [
  ["a fixed region that is gone", fix(gone(Int32Array.of(1, 2))), "invalid-handle", "fixed", "Int32Array", "gone"],
  ["a handle that is gone", grab(gone(Int32Array.of(1, 2))), "invalid-handle", "vertices", "Int32Array", "gone"],
  ["targets that are gone", () => hand.moveTo(gone(new Float32Array(3 * right.length))),
    "invalid-handle", "targets", "gone"],
  ["an output that is gone", () => deformer.positions(gone(new Float32Array(mesh.positions.length))),
    "invalid-option", "out", "gone"],
  ["fixed ids that are no list", fix(5), "invalid-handle", "fixed", "5", "vertex ids"],
  ["fixed ids as text", fix("12"), "invalid-handle", "fixed", '"12"'],
  ["a fixed id out of range", fix([121]), "invalid-handle", "fixed[0]", "121", "from 0 to 120"],
  ["a fixed id twice", fix([1, 2, 1]), "invalid-handle", "fixed[2]", "listed before"],
  ["a fixed vertex of a handle", fix(right), "invalid-handle", "fixed", "handle"],
  ["no vertices", grab([]), "invalid-handle", "vertices", "empty"],
  ["no list", grab(null), "invalid-handle", "vertices", "null"],
  ["a negative id", grab([-1]), "invalid-handle", "vertices[0]", "-1"],
  ["half an id", grab([0, 2.5]), "invalid-handle", "vertices[1]", "2.5"],
  ["an id as text", grab(["3"]), "invalid-handle", "vertices[0]", '"3"'],
  ["an id twice", grab([50, 50]), "invalid-handle", "vertices[1]", "50", "listed before"],
  ["ids without end", grab(endless()), "invalid-handle", "vertices[121]", "121"],
  ["a fixed vertex", grab([left[0]]), "invalid-handle", String(left[0]), "fixed"],
  ["a vertex of another handle", grab([right[0]]), "invalid-handle", String(right[0]), "handle"],
  ["no transform", move(undefined), "invalid-handle", "transform", "undefined"],
  ["an unknown part of a transform", move({ shift: [0, 0, 1] }),
    "invalid-handle", "transform.shift", "scale, rotate, translate, matrix"],
  ["a translation in the plane", move({ translate: [0, 1] }),
    "invalid-handle", "transform.translate", "length 2", "3 finite numbers"],
  ["a translation to nowhere", move({ translate: [0, NaN, 0] }), "invalid-handle", "transform.translate[1]", "NaN"],
  ["a translation beyond all reason", move({ translate: [0, 1e31, 0] }),
    "invalid-handle", "transform.translate[1]", "1e+31", "at most 1e+30"],
  ["a scale of zero", move({ scale: 0 }), "invalid-handle", "transform.scale", "above 0"],
  ["an axis without direction", move({ rotate: { axis: [0, 0, 0], degrees: 3 } }),
    "invalid-handle", "transform.rotate.axis", "zero vector"],
  ["a rotation without an axis", move({ rotate: { degrees: 3 } }),
    "invalid-handle", "transform.rotate.axis", "undefined"],
  ["a rotation without degrees", move({ rotate: { axis: [1, 0, 0] } }),
    "invalid-handle", "transform.rotate.degrees", "undefined"],
  ["endless degrees", move({ rotate: { axis: [1, 0, 0], degrees: Infinity } }),
    "invalid-handle", "transform.rotate.degrees", "Infinity"],
  ["a short matrix", move({ matrix: [1, 0, 0] }), "invalid-handle", "transform.matrix", "length 3", "16"],
  ["a projective matrix", move({ matrix: [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }),
    "invalid-handle", "transform.matrix", "affine"],
  ["a matrix and a translation", move({ matrix: Array(16).fill(0), translate: [0, 0, 1] }),
    "invalid-handle", "matrix and translate"],
  ["no targets", () => hand.moveTo([]), "invalid-handle", "targets", "empty"],
  ["too few targets", () => hand.moveTo([1, 2, 3]), "invalid-handle", "targets", "length 3", String(3 * right.length)],
  ["a target nowhere", () => hand.moveTo(Array(3 * right.length).fill(NaN)), "invalid-handle", "targets[0]", "NaN"],
];

const solving: Row[] = [
  ["no iterations", solve({ maxIterations: 0 }), "invalid-option", "options.maxIterations", "0"],
  ["half an iteration", solve({ maxIterations: 1.5 }), "invalid-option", "options.maxIterations", "1.5"],
  ["no tolerance", solve({ tolerance: 0 }), "invalid-option", "options.tolerance", "above 0"],
  ["a tolerance that is not a number", solve({ tolerance: NaN }), "invalid-option", "options.tolerance", "NaN"],
  ["a signal that is none", solve({ signal: true }), "invalid-option", "options.signal", "AbortSignal"],
  ["a callback that is none", solve({ onProgress: 3 }), "invalid-option", "options.onProgress", "function"],
  ["an unknown option", solve({ iterations: 3 }), "invalid-option", "options.iterations", "maxIterations"],
  ["no options object", solve(null), "invalid-option", "options", "null"],
  ["a tolerance below zero for a step", () => deformer.step({ tolerance: -1 }),
    "invalid-option", "options.tolerance", "-1"],
  ["a short array for positions", () => deformer.positions(new Float32Array(3)),
    "invalid-option", "out", "length 3", String(mesh.positions.length)],
  ["a plain array for normals", () => deformer.normals([] as never), "invalid-option", "out", "Float32Array"],
  ["no points", () => deformer.transformPoints([]), "invalid-option", "points", "empty"],
  ["points that are cut short", () => deformer.transformPoints([1, 2]), "invalid-option", "points", "divisible by 3"],
  ["a point nowhere", () => deformer.transformPoints([1, 2, NaN]), "invalid-option", "points[2]", "NaN"],
  ["a short array for points", () => deformer.transformPoints([1, 2, 3], new Float64Array(6)),
    "invalid-option", "out", "length 6"],
  ["no state", restore(undefined), "invalid-option", "state", "undefined"],
  ["a state without nodes", restore({ handles: [] }), "invalid-option", "nodes"],
  ["a state of something else", restore({ cells: [] }), "invalid-option", "state.cells", "nodes"],
  [
    "a state that was tampered with",
    () => {
      const state = deformer.state();
      (state.rotations as number[][])[3][4] = NaN;
      deformer.restore(state);
    },
    "invalid-option",
    "state.rotations[3][4]",
    "NaN",
  ],
  [
    "a state cut short",
    () => {
      const state = deformer.state();
      (state.translations as number[][]).pop();
      deformer.restore(state);
    },
    "invalid-option",
    "translations",
  ],
  [
    "a state whose handles do not fit",
    () => {
      const state = deformer.state();
      state.handles[0].targets.pop();
      deformer.restore(state);
    },
    "invalid-option",
    "state.handles[0]",
    "targets",
  ],
  ["measuring nothing", () => pliant.measure(shape, []), "invalid-option", "positions", "empty"],
  ["measuring too little", () => pliant.measure(shape, [1, 2, 3]), "invalid-option", "positions", "length 3"],
  [
    "measuring NaN",
    () =>
      pliant.measure(shape, mesh.positions.map(() => NaN)),
    "invalid-option",
    "positions[0]",
    "NaN",
  ],
];

const selections: Row[] = [
  ["nothing", select(undefined), "invalid-option", "selection", "undefined"],
  ["no kind", select({}), "invalid-option", "selection", "0 keys"],
  ["two kinds", select({ all: true, vertices: [1] }), "invalid-option", "selection", "2 keys"],
  ["an unknown kind", select({ cube: {} }), "invalid-option", "selection.cube", "box"],
  ["no vertices", select({ vertices: [] }), "invalid-option", "selection.vertices", "empty"],
  ["a vertex twice", select({ vertices: [4, 4] }), "invalid-option", "selection.vertices[1]", "listed before"],
  ["a vertex out of range", select({ vertices: [400] }), "invalid-option", "selection.vertices[0]", "from 0 to 120"],
  ["a box upside down", select({ box: { min: [1, 0, 0], max: [0, 1, 1] } }),
    "invalid-option", "selection.box", "min[0]"],
  ["a box without a corner", select({ box: { min: [1, 0, 0] } }), "invalid-option", "selection.box.max", "undefined"],
  ["a sphere inside out", select({ sphere: { center: [0, 0, 0], radius: -1 } }),
    "invalid-option", "selection.sphere.radius", "-1"],
  ["a half space without direction", select({ halfSpace: { normal: [0, 0, 0], offset: 0 } }),
    "invalid-option", "selection.halfSpace.normal", "zero vector"],
  ["a half space nowhere", select({ halfSpace: { normal: [1, 0, 0] } }),
    "invalid-option", "selection.halfSpace.offset", "undefined"],
  ["not all", select({ all: false }), "invalid-option", "selection.all", "false"],
  ["any of none", select({ any: [] }), "invalid-option", "selection.any", "empty"],
  ["a fault deep inside", select({ any: [{ not: { every: [{ all: true }, { vertices: [1, 999] }] } }] }),
    "invalid-option", "selection.any[0].not.every[1].vertices[1]", "999"],
  ["what selects nothing", select({ not: { all: true } }), "invalid-option", "selection", "no vertex"],
  [
    "bottomless nesting",
    select(Array.from({ length: 20_000 }).reduce<object>((inner) => ({ not: inner }), { all: true })),
    "invalid-option",
    "nested too deeply",
  ],
];

const starting: Row[] = [
  ["an unknown option of init", () => entries.pliant.init({ wasm: 1 } as never),
    "invalid-option", "options.wasm", "wasmUrl"],
  ["two sources", () => entries.pliant.init({ wasmUrl: "a", wasmBinary: new ArrayBuffer(0) }),
    "invalid-option", "wasmUrl and wasmBinary"],
  ["an address that is none", () => entries.pliant.init({ wasmUrl: 5 } as never),
    "invalid-option", "options.wasmUrl", "5"],
  ["bytes that are none", () => entries.pliant.init({ wasmBinary: "bytes" } as never),
    "invalid-option", "options.wasmBinary"],
  ["a module that is none", () => entries.pliant.init({ wasmModule: {} } as never),
    "invalid-option", "options.wasmModule"],
];

describe.each([
  ["shape", shapes], ["deformer", deformers], ["handle", handles], ["solve, results and states", solving],
  ["selection", selections], ["init", starting],
])("%s refuses", (_, rows) => {
  afterEach(async () => {
    hand.move({ translate: [0, 0, 0.1] });
    expect((await deformer.solve()).converged).toBe(true);
    expect(pliant.shape(mesh).report.vertices).toBe(121);
  });

  it.each(rows)("%s", async (__, action, code, ...says) => {
    const error = await errorOf(action);
    expect(error.code).toBe(code);
    for (const words of says) expect(error.message).toContain(words);
    expect(error.message).not.toContain("\n");
    expect(error.message.length).toBeLessThan(300);
  });
});

describe("after an error", () => {
  it("nothing has changed", async () => {
    hand.move({ translate: [0, 0, 0.2] });
    await deformer.solve();
    const before = deformer.state();
    for (const [, action] of [...handles, ...solving]) await errorOf(action).catch(() => {});
    expect(deformer.state()).toEqual(before);
    expect(deformer.handles).toEqual([hand]);
  });

  it("memory is given back", async () => {
    // Each would take 40 MB if it leaked: 100 of them would not fit.
    const positions = new Float64Array(3 * 600_000).map((_, i) => i);
    const triangles = Uint32Array.of(0, 1, 2, 0, 1, 600_000);
    for (let i = 0; i < 100; ++i) expect((await errorOf(make({ positions, triangles }))).code).toBe("invalid-shape");
    for (let i = 0; i < 200; ++i) {
      expect((await errorOf(build({ cuts: [[{ all: true }, { vertices: [3] }]] }))).code).toBe("invalid-option");
    }
  });

  it("docs/errors.md says what its code means", () => {
    const folder = join(import.meta.dirname, "../..");
    const source = readFileSync(join(folder, "bindings/js/boundary/errors.ts"), "utf8");
    const codes = [...source.matchAll(/\| "([a-z-]+)"/g)].map(([, code]) => code);
    const explained = [...readFileSync(join(folder, "docs/errors.md"), "utf8").matchAll(/^\| `([a-z-]+)` \|/gm)].map(
      ([, code]) => code,
    );
    expect(codes.length).toBeGreaterThan(9);
    expect(explained).toEqual(codes);
  });

  it("is a PliantError with a stable code", async () => {
    const error = await pliant.edit(shape, null as never).catch((caught: unknown) => caught);
    expect(error).toBeInstanceOf(PliantError);
    expect(error).toBeInstanceOf(Error);
    expect(error).toMatchObject({ name: "PliantError", code: "invalid-script" });
  });
});
