// The shape of the WASM modules as embind exposes them: what bindings/wasm/bind_*.cpp provides and
// the TypeScript facade beside this file consumes. Nothing here is public.
//
// Conventions. A fallible call returns a RawStatus (code "ok" or an error code of docs/errors.md).
// Arrays go in through a RawScratch: ask for a view, `.set()` it, pass the scratch. Arrays come out
// as a view of WASM memory that is valid only until the next call: copy at once.
// Every object is freed with delete().

export interface RawStatus {
  /** "ok" or an `ErrorCode`. */
  code: string;
  message: string;
}

/** null: no numbers. */
export type RawValue = string | number | boolean | null | ArrayLike<number>;

/** Options and other arguments by name; what comes back are words and lists of numbers. `Core` stages them. */
export type RawValues = Readonly<Record<string, RawValue>>;

/** The names of staged values: a line for each, "name=word", or "name count" for so many doubles of the scratch. */
export type RawNames = string;

export interface RawObject {
  delete(): void;
}

/** Staging memory for arrays on their way in. Each slot keeps its content until resized. */
export interface RawScratch extends RawObject {
  doubles(length: number): Float64Array;
  integers(length: number): Int32Array;
  bytes(length: number): Uint8Array;
}

/** What was found. Edges and components are counted after vertices at equal positions became one. */
export interface ShapeReport {
  vertices: number;
  triangles: number;
  components: number;
  /** Edges with one triangle. */
  boundaryEdges: number;
  /** Edges with more than two triangles. */
  nonManifoldEdges: number;
  /** Triangles with fewer than three distinct points, or no area. */
  degenerateTriangles: number;
  /** Vertices that share the position of an earlier one. */
  weldedVertices: number;
}

export interface RawShape extends RawObject {
  /** doubles: dimension * n coordinates; integers: 3 * m vertex ids (may be empty). */
  build(scratch: RawScratch, dimension: number): RawStatus;
  report(): ShapeReport;
  diagonal(): number;
  /** Of what the surface bounds; NaN: nothing. */
  volume(): number;
  /** integers: a vertex a spot; doubles: 3 a spot, its centre, then 3 n positions, or none for those at rest. */
  patch(scratch: RawScratch, radius: number): Int32Array;
  /** How many there are; the next two give vertices of one of them. */
  findLooseParts(): number;
  loosePart(part: number): Int32Array;
  besideLoosePart(part: number): Int32Array;
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
  /** doubles in: 3 q points, then their normals; on success `points` is a view of 3 q doubles, the turned normals. */
  transformNormals(scratch: RawScratch): { status: RawStatus; points: Float64Array };
  reset(): void;
  save(state: RawState): void;
  restore(state: RawState): RawStatus;
}

export interface RawDeformer extends RawDeformation {
  /** Options that are left out are those of the method's struct in C++. */
  build(shape: RawShape, method: string, options: RawNames, scratch: RawScratch): RawStatus;
  /** Those left out stay. */
  setOptions(options: RawNames, scratch: RawScratch): RawStatus;
  /** Those in use. */
  options(scratch: RawScratch): RawNames;
  /** On success `points` is a view of 3 n doubles. */
  field(): { status: RawStatus; points: Float64Array };
  /** integers: vertex ids. */
  setFixed(scratch: RawScratch): RawStatus;
  /** integers: vertex ids; the new id is in `id` (0 on error). */
  addHandle(scratch: RawScratch): { status: RawStatus; id: number };
  removeHandle(id: number): RawStatus;
  /** scale, center, axis, angle (radians), about, translation. */
  moveHandle(id: number, motion: RawNames, scratch: RawScratch): RawStatus;
  /** doubles: 3 a vertex of the handle. */
  setTargets(id: number, scratch: RawScratch): RawStatus;
  step(tolerance: number): RawStep;
  energyTotal(): number;
  energyTerms(): RawEnergyTerm[];
  counters(): RawCounters;
  /** Improves the model once, where the options ask for it; `added` above 0: there is more to solve. */
  refine(): { status: RawStatus; added: number };
}

/** Editing by strokes (bind_sketch.cpp). Samples of a stroke and points of a profile are two numbers each. */
export interface RawSketch extends RawDeformation {
  /**
   * eye, target, up, fovY or orthographicHeight, width, height; reference; hold, smooth, mirrorPoint and mirrorNormal,
   * partitions (and partitions/sizes), labels.
   */
  build(shape: RawShape, drawing: RawNames, scratch: RawScratch): RawStatus;
  /** The camera, and one pixel as the reference: the limb under it, for the next call. Before `build`, too. */
  findLimb(shape: RawShape, drawing: RawNames, scratch: RawScratch): RawStatus;
  foundLimb(): Float64Array; // 2 a sample
  heldAtEnd(): boolean;
  /** The camera and the reference. */
  redraw(drawing: RawNames, scratch: RawScratch): RawStatus;
  /** doubles: the target, as those of the profiles below. */
  bend(scratch: RawScratch, unfinished: boolean): RawStatus;
  unbend(): void;
  twist(radians: number): RawStatus;
  setScale(scratch: RawScratch): RawStatus;
  setTurning(scratch: RawScratch): RawStatus;
  setTwistSpeed(scratch: RawScratch): RawStatus;
  setSmooth(smooth: boolean): void;
  setMorph(t: number): RawStatus;
  /** heading, turns, length, twist, scale. */
  pose(scratch: RawScratch): RawNames;
  /** A pose, or what lies the part t of the way to another one, whose names begin with "toward/". */
  setPose(pose: RawNames, scratch: RawScratch, t: number): RawStatus;
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
  /**
   * doubles in: 3 q points, and where they go; out, 9: the rotation vector of the rigid motion, its centre, and where
   * that goes.
   */
  fitRigid(scratch: RawScratch): void;
}

/** A file read into memory (bind_io.cpp). */
export interface RawDocument extends RawObject {
  /**
   * format: "obj" | "ply" | "off" | "stl" | "xyz"; bytes: the file, which the scratch gives away. To be read by
   * `advance`.
   */
  begin(format: string, scratch: RawScratch): RawStatus;
  /** Reads a piece of it; `fraction` 1: all is read. */
  advance(): { status: RawStatus; fraction: number };
  positions(): Float64Array; // 3 n
  /** Polygons as a flat list of vertex ids, and where each begins: faceOffsets has faces + 1 entries. */
  faceVertices(): Uint32Array;
  faceOffsets(): Uint32Array;
  triangles(): Uint32Array; // the polygons as triangles, 3 m
  /** Texture coordinates, 2 a corner in faceVertices order; empty where the file has none. */
  cornerTexcoords(): Float64Array;
  /** sRGB, 3 a vertex; empty where the file has none. */
  colors(): Uint8Array;
  /**
   * Sets positions (doubles), polygons (integers: count, ids..., count, ids...), for writing what another reader read.
   */
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
  /**
   * largest: a coordinate beyond it is an error of the file. normals: those of vertices are turned instead of left out.
   */
  open(format: string, largest: number, normals: boolean): RawStatus;
  /**
   * bytes: the next piece of the file (empty and last = true at the end). Then `points` holds the coordinates found,
   * and `normals` as many normals, or none.
   */
  push(scratch: RawScratch, last: boolean): { status: RawStatus; points: Float64Array; normals: Float64Array };
  /** doubles: the new coordinates of the last push, as many, then the normals. `bytes` is what to write. */
  emit(scratch: RawScratch): { status: RawStatus; bytes: Uint8Array };
}

/** pliant-io.wasm: readers and writers, loaded only by those who read files. */
export interface RawIoModule {
  Scratch: new () => RawScratch;
  Document: new () => RawDocument;
  Rewriter: new () => RawRewriter;
}
