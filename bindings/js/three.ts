// pliant/three: a three.js BufferGeometry joined to a deformer. Vertex ids are those of the
// geometry's attributes: vertices repeated for UV seams or groups are welded inside and scattered back.

export { GeometryBinding } from "./three/binding.js";
export { shapeOf } from "./three/shape.js";
