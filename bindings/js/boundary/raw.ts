// The shape of the WASM modules as embind exposes them: what bindings/wasm/bind_*.cpp provides and
// the TypeScript facade beside this file consumes. Nothing here is public.
//
// Conventions. A fallible call returns a RawStatus (code "ok" or an error code of docs/errors.md).
// Arrays go in through a RawScratch: ask for a view, `.set()` it, pass the scratch. Arrays come out
// as a view of WASM memory that is valid only until the next call: copy at once.
// Every object is freed with delete().

export interface RawStatus {
  code: string; // "ok" | "invalid-shape" | "invalid-option" | "invalid-handle" | "parse-error" | "not-solvable" | "too-large"
  message: string;
}

export interface RawObject {
  delete(): void;
}

/** Staging memory for arrays on their way in. Each slot keeps its content until resized. */
export interface RawScratch extends RawObject {
  doubles(length: number): Float64Array;
  integers(length: number): Int32Array;
  bytes(length: number): Uint8Array;
}

export interface RawShapeReport {
  vertices: number;
  triangles: number;
  components: number;
  boundaryEdges: number;
  nonManifoldEdges: number;
  degenerateTriangles: number;
  weldedVertices: number;
}

export interface RawShape extends RawObject {
  /** doubles: dimension * n coordinates; integers: 3 * m vertex ids (may be empty). */
  build(scratch: RawScratch, dimension: number): RawStatus;
  report(): RawShapeReport;
  diagonal(): number;
}

export interface RawStep {
  status: RawStatus;
  iteration: number;
  energy: number;
  accepted: boolean;
  converged: boolean;
}

export interface RawEnergyTerm {
  name: string;
  value: number;
  weight: number;
}

export interface RawCounters {
  unknowns: number;
  factorizations: number;
  analyses: number;
}

export interface RawEmbeddedGraphOptions {
  nodeCount: number;
  sampling: string; // "surface" | "simplify" | "nodes" (then scratch.doubles holds 3 m coordinates)
  neighbours: number; // 0: the default, min(4, nodes)
  rotationWeight: number;
  regularizationWeight: number;
  constraintWeight: number;
  solver: string; // "auto" | "gauss-newton"
  exactHandles: boolean;
  seed: number;
}

/** A saved deformation, table by table. columns 0: a scalar. */
export interface RawState extends RawObject {
  size(): number;
  name(table: number): string;
  columns(table: number): number;
  integral(table: number): boolean;
  data(table: number): Float64Array;
  /** Takes scratch.doubles as the table's data. */
  add(name: string, columns: number, integral: boolean, scratch: RawScratch): void;
}

/** What deformers and sketches have in common (bind_deformation.cpp). */
export interface RawDeformation extends RawObject {
  positions(): Float32Array; // 3 a vertex
  positions64(): Float64Array; // 3 a vertex
  normals(): Float32Array; // 3 a vertex
  /** doubles in: 3 q; on success `points` is a view of 3 q doubles. */
  transformPoints(scratch: RawScratch): { status: RawStatus; points: Float64Array };
  reset(): void;
  save(state: RawState): void;
  restore(state: RawState): RawStatus;
}

export interface RawDeformer extends RawDeformation {
  /** Cuts: scratch.integers holds, for each pair, |a|, a..., |b|, b... (empty: none). */
  buildEmbeddedGraph(shape: RawShape, options: RawEmbeddedGraphOptions, scratch: RawScratch): RawStatus;
  /** constraintWeight 0: exact handles. */
  buildArap(shape: RawShape, rims: boolean, constraintWeight: number, smoothness: number): RawStatus;
  /** Of a deformer built so; likewise setEdgeMaterial and field. */
  setArap(rims: boolean, constraintWeight: number, smoothness: number): RawStatus;
  /**
   * field: "" | "strokes" | "axis" | "max" | "min" | "geodesic". doubles: stretch, lambda (below 0: from stretch), bend,
   * pStretch, pBend, gravity xyz, axis xyz, the points of all strokes; integers: points of each stroke, or source vertices.
   */
  buildEdgeMaterial(shape: RawShape, field: string, scratch: RawScratch): RawStatus;
  setEdgeMaterial(field: string, scratch: RawScratch): RawStatus;
  field(): Float64Array; // 3 n
  /** integers: vertex ids. */
  setFixed(scratch: RawScratch): RawStatus;
  /** integers: vertex ids; the new id is in `id` (0 on error). */
  addHandle(scratch: RawScratch): { status: RawStatus; id: number };
  removeHandle(id: number): RawStatus;
  /** doubles: scale, center xyz, axis xyz, angle (radians), about xyz, translation xyz (14 numbers). */
  moveHandle(id: number, scratch: RawScratch): RawStatus;
  /** doubles: 3 a vertex of the handle. */
  setTargets(id: number, scratch: RawScratch): RawStatus;
  step(tolerance: number): RawStep;
  energyTotal(): number;
  energyTerms(): RawEnergyTerm[];
  counters(): RawCounters;
  /** Adds graph nodes where the energy terms are high; `added` 0 where nothing is left to refine. */
  refine(maxNodes: number): { status: RawStatus; added: number };
}

/**
 * Editing by strokes (bind_sketch.cpp). Packed into the scratch, doubles beside integers:
 * CAMERA: eye, target, up, angle or height, width, height beside 1 where that is orthographic, else 0;
 * STROKE and PROFILE: two numbers a sample beside how many;
 * POSE: heading, length, turns, twist, scale beside how many turns and points of each profile.
 */
export interface RawSketch extends RawDeformation {
  /** CAMERA, STROKE (reference), if mirrored a point and a normal, then beside how many there are the partitions as STROKEs; labels are the other integers. hold: 0 larger, 1 start, 2 end. */
  build(shape: RawShape, smooth: boolean, mirrored: boolean, hold: number, scratch: RawScratch): RawStatus;
  /** CAMERA, a STROKE of one pixel: the limb under it, for the next call. Before `build`, too. */
  findLimb(shape: RawShape, scratch: RawScratch): RawStatus;
  foundLimb(): Float64Array; // 2 a sample
  heldAtEnd(): boolean;
  /** CAMERA, STROKE. */
  redraw(scratch: RawScratch): RawStatus;
  /** STROKE. */
  bend(scratch: RawScratch, unfinished: boolean): RawStatus;
  unbend(): void;
  twist(radians: number): RawStatus;
  /** PROFILE. */
  setScale(scratch: RawScratch): RawStatus;
  setTurning(scratch: RawScratch): RawStatus;
  setTwistSpeed(scratch: RawScratch): RawStatus;
  setSmooth(smooth: boolean): void;
  setMorph(t: number): RawStatus;
  /** A POSE with the counts in line, each before what it counts. */
  pose(): Float64Array;
  /** POSE; if two, another: then the share t of the way to it. */
  setPose(scratch: RawScratch, two: boolean, t: number): RawStatus;
  /** integers: the input's triangles. */
  refine(scratch: RawScratch, maxAdded: number): RawStatus;
  unrefine(): void;
  /** How many vertices the refinement added; -1 without one. The next three only with one. */
  added(): number;
  parents(): Int32Array; // 2 an added vertex
  triangles(): Uint32Array; // 3 a triangle
  triangleParents(): Uint32Array; // 1 a triangle
  labels(): Int32Array; // n
  parameters(): Float64Array; // n + added
  reference(): Float64Array; // 3 a node
  target(): Float64Array; // 3 a node
  rest(): Float64Array; // 3 (n + added)
  /** Keeps what the next three give; spacing in diagonals. */
  seed(spacing: number): void;
  seedFixed(): Int32Array;
  seedVertices(): Int32Array;
  seedTargets(): Float64Array; // 3 a vertex
}

export interface RawQuality {
  stretchMean: number;
  stretchP95: number;
  stretchMax: number;
  shear: number;
  volume: number; // NaN where not defined
  area: number; // NaN where not defined
  folds: number;
  intersections: number;
  roughnessRest: number;
  roughness: number;
}

/** pliant.wasm: the solvers. */
export interface RawModule {
  Scratch: new () => RawScratch;
  Shape: new () => RawShape;
  Deformer: new () => RawDeformer;
  State: new () => RawState;
  Sketch: new () => RawSketch;
  /** doubles: 3 n deformed positions of the input's vertices. */
  measureQuality(shape: RawShape, scratch: RawScratch, withIntersections: boolean): RawQuality;
}

/** A file read into memory (bind_io.cpp). */
export interface RawDocument extends RawObject {
  /** format: "obj" | "ply" | "off" | "stl" | "xyz"; bytes: the file, which the scratch gives away. To be read by `advance`. */
  begin(format: string, scratch: RawScratch): RawStatus;
  /** Reads a piece of it; `share` 1: all is read. */
  advance(): { status: RawStatus; share: number };
  positions(): Float64Array; // 3 n
  /** Polygons as a flat list of vertex ids, and where each begins: faceOffsets has faces + 1 entries. */
  faceVertices(): Uint32Array;
  faceOffsets(): Uint32Array;
  triangles(): Uint32Array; // the polygons as triangles, 3 m
  /** Texture coordinates, 2 a corner in faceVertices order; empty where the file has none. */
  cornerTexcoords(): Float64Array;
  /** sRGB, 3 a vertex; empty where the file has none. */
  colors(): Uint8Array;
  /** Sets positions (doubles), polygons (integers: count, ids..., count, ids...), for writing what another reader read. */
  assign(scratch: RawScratch): RawStatus;
  /** Sets texture coordinates, 2 a corner (doubles). */
  assignTexcoords(scratch: RawScratch): RawStatus;
  /** Sets colours, 3 a vertex (bytes). */
  assignColors(scratch: RawScratch): RawStatus;
  /** doubles: 3 n new positions. On success `bytes` is a view of the file. */
  write(format: string, scratch: RawScratch): { status: RawStatus; bytes: Uint8Array };
}

/** Streams a file through, replacing coordinates and keeping every other byte (bind_io.cpp). */
export interface RawRewriter extends RawObject {
  open(format: string): RawStatus;
  /** bytes: the next piece of the file (empty and last = true at the end). Then `points` holds the coordinates found. */
  push(scratch: RawScratch, last: boolean): { status: RawStatus; points: Float64Array };
  /** doubles: the new coordinates of the last push, as many. `bytes` is what to write. */
  emit(scratch: RawScratch): { status: RawStatus; bytes: Uint8Array };
}

/** pliant-io.wasm: readers and writers, loaded only by those who read files. */
export interface RawIoModule {
  Scratch: new () => RawScratch;
  Document: new () => RawDocument;
  Rewriter: new () => RawRewriter;
}
