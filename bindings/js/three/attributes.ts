// Attributes of a BufferGeometry as plain arrays, in and out.

import type { BufferAttribute, BufferGeometry, InterleavedBufferAttribute } from "three";

export type Attribute = BufferAttribute | InterleavedBufferAttribute;

// Getters and setters that every three.js from 0.150 on has.
const get = ["getX", "getY", "getZ", "getW"] as const;
const set = ["setX", "setY", "setZ", "setW"] as const;

/** The numbers of an attribute, `itemSize` an item: quantised ones as what they stand for. */
export function readAttribute(attribute: Attribute): Float32Array {
  const { count, itemSize } = attribute;
  if (isPlain(attribute) && attribute.array instanceof Float32Array) return attribute.array.slice(0, count * itemSize);
  const values = new Float32Array(count * itemSize);
  for (let i = 0, at = 0; i < count; ++i) for (let k = 0; k < itemSize; ++k) values[at++] = attribute[get[k]](i);
  return values;
}

/** Writes all numbers of an attribute of floats, and has them sent to the GPU. */
export function writeAttribute(attribute: Attribute, values: Float32Array): void {
  const { count, itemSize } = attribute;
  if (isPlain(attribute)) attribute.array.set(values);
  else for (let i = 0, at = 0; i < count; ++i) for (let k = 0; k < itemSize; ++k) attribute[set[k]](i, values[at++]);
  (isPlain(attribute) ? attribute : attribute.data).needsUpdate = true;
}

/**
 * The attribute itself where it holds floats. Quantised ones wrap where a deformation leaves their range, so that a
 * plain one of floats takes their place.
 */
export function ofFloats(attribute: Attribute): Attribute {
  if (attribute.array instanceof Float32Array || attribute.array instanceof Float64Array) return attribute;
  const Plain = plainClass(isPlain(attribute) ? attribute : (attribute.clone() as BufferAttribute));
  const floats = new Plain(readAttribute(attribute), attribute.itemSize);
  floats.name = attribute.name;
  return floats;
}

/** Replaces an attribute of a geometry by one of floats, where it is none. */
export function floatAttribute(geometry: BufferGeometry, name: string): Attribute | undefined {
  const attribute = geometry.getAttribute(name) as Attribute | undefined;
  if (!attribute) return undefined;
  const floats = ofFloats(attribute);
  if (floats !== attribute) geometry.setAttribute(name, floats);
  return floats;
}

function isPlain(attribute: Attribute): attribute is BufferAttribute {
  return (attribute as BufferAttribute).isBufferAttribute === true;
}

/** BufferAttribute itself, of the copy of three.js that made the geometry: this package has none of its own. */
function plainClass(attribute: BufferAttribute): new (array: Float32Array, itemSize: number) => BufferAttribute {
  let prototype: object = Object.getPrototypeOf(attribute);
  while (!Object.hasOwn(prototype, "setXYZ")) prototype = Object.getPrototypeOf(prototype);
  return prototype.constructor as ReturnType<typeof plainClass>;
}
