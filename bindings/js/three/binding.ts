// A geometry that follows a deformer.

import type { BufferGeometry } from "three";
import { Place } from "../boundary/check.js";
import { NormalGroups } from "../shape/normals.js";
import { type Attribute, floatAttribute, ofFloats, readAttribute, writeAttribute } from "./attributes.js";
import { restOf, trianglesOf } from "./shape.js";
import { TangentFrames } from "./tangents.js";

/** An absolute morph target, and how far it is from the geometry at rest: it keeps that distance. */
interface Target {
  attribute: Attribute;
  offsets: Float32Array;
}

/**
 * Keeps a geometry up to date with a deformer over its shape: positions, normals, tangents, absolute morph targets and
 * bounds. Quantised attributes among them become Float32: a deformation leaves their range.
 */
export class GeometryBinding {
  readonly geometry: BufferGeometry;
  readonly #positions: Float32Array;
  readonly #normals: Float32Array | undefined;
  readonly #groups: NormalGroups | undefined;
  readonly #tangents: Float32Array | undefined;
  readonly #frames: TangentFrames | undefined;
  readonly #targets: { position: Target[]; normal: Target[] };

  /** Takes the geometry as it is now for the shape at rest. Errors: invalid-shape. */
  constructor(geometry: BufferGeometry) {
    this.geometry = geometry;
    this.#positions = restOf(geometry);
    const triangles = trianglesOf(geometry, this.#positions.length / 3);
    const [position, normal, tangent] = ["position", "normal", "tangent"].map((name) => floatAttribute(geometry, name));
    this.#targets = {
      position: absoluteTargets(geometry, "position", position), normal: absoluteTargets(geometry, "normal", normal),
    };
    if (!normal || triangles.length === 0) return;
    this.#normals = readAttribute(normal);
    this.#groups = new NormalGroups(this.#positions, this.#normals, triangles);
    if (tangent?.itemSize !== 4) return;
    this.#tangents = readAttribute(tangent);
    this.#frames = new TangentFrames(this.#positions, this.#tangents, triangles);
  }

  /** Takes positions from a deformer or a sketch over `shapeOf(geometry)`. Errors: invalid-option. */
  update(deformer: { positions(out: Float32Array): Float32Array }): void {
    if (typeof deformer?.positions !== "function") {
      new Place("invalid-option", "deformer").fail(deformer, "a deformer or a sketch over shapeOf(geometry)");
    }
    this.write(deformer.positions(this.#positions));
  }

  /** Takes positions from elsewhere, for example a worker: three numbers a vertex. Errors: invalid-option. */
  write(positions: Float32Array): void {
    const { length } = this.#positions;
    const fits = positions instanceof Float32Array && positions.length === length;
    if (!fits) new Place("invalid-option", "positions").fail(positions, `a Float32Array of length ${length}`);
    this.#put("position", positions);
    if (this.#groups && this.#normals) {
      this.#groups.compute(positions, this.#normals);
      this.#put("normal", this.#normals);
    }
    if (this.#frames && this.#tangents) {
      this.#frames.compute(positions, this.#normals!, this.#tangents);
      this.#put("tangent", this.#tangents);
    }
    this.geometry.computeBoundingBox();
    this.geometry.computeBoundingSphere();
  }

  #put(name: "position" | "normal" | "tangent", values: Float32Array): void {
    writeAttribute(this.geometry.getAttribute(name), values);
    if (name === "tangent") return;
    for (const { attribute, offsets } of this.#targets[name]) {
      writeAttribute(attribute, offsets.map((offset, i) => values[i] + offset));
    }
  }
}

/** Targets that hold places instead of distances; each as floats. */
function absoluteTargets(geometry: BufferGeometry, name: "position" | "normal", base: Attribute | undefined): Target[] {
  const targets = geometry.morphAttributes[name];
  if (!targets || !base || geometry.morphTargetsRelative) return [];
  const rest = readAttribute(base);
  return targets.map((target, i) => {
    const attribute = (targets[i] = ofFloats(target) as typeof target);
    return { attribute, offsets: readAttribute(attribute).map((value, at) => value - rest[at]) };
  });
}
