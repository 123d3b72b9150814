// What lies under the pointer.
import { Mesh, Raycaster, Vector2, Vector3, type Intersection } from "three";
import type { Present } from "../edit/present.ts";
import type { ShapeView } from "./shape_view.ts";
import type { Viewport } from "./viewport.ts";

export interface Hit {
  point: Vector3;
  /** Unit, towards the viewer. */
  normal: Vector3;
  /** The nearest vertex. */
  vertex: number;
  /** Distance of the farthest corner of the triangle; 0: there is none. */
  reach: number;
}

const raycaster = new Raycaster();

/** The first hit of the deformed shape under a place on the page, or undefined. */
export function pick(
  viewport: Viewport, view: ShapeView, present: Present, clientX: number, clientY: number,
): Hit | undefined {
  if (!view.object) return undefined;
  const { x, y } = viewport.toClip(clientX, clientY);
  viewport.camera.updateMatrixWorld(); // it may have turned since it was last drawn
  raycaster.setFromCamera(new Vector2(x, y), viewport.camera);
  const distance = viewport.camera.position.distanceTo(viewport.controls.target);
  raycaster.params.Points.threshold = 0.008 * distance;
  view.bound();
  const hits = raycaster.intersectObject(view.object, false);
  // In the plane all are as far away: the one that is drawn last is seen.
  const later = (a: Intersection, b: Intersection) => ((b.faceIndex ?? 0) > (a.faceIndex ?? 0) ? b : a);
  const first = present.doc.shape.dimension === 2 ? hits.reduce(later, hits[0]!) : hits[0];
  if (!first) return undefined;
  const toViewer = raycaster.ray.direction.clone().negate();
  const point = first.point.clone();
  if (!(view.object instanceof Mesh)) return { point, normal: toViewer, vertex: first.index!, reach: 0 };
  const normal = first.face!.normal.clone();
  if (normal.dot(toViewer) < 0) normal.negate();
  return { point, normal, ...cornersNear(first, present.positions) };
}

function cornersNear({ face, point }: Intersection, positions: Float32Array): Pick<Hit, "vertex" | "reach"> {
  const corners = [face!.a, face!.b, face!.c];
  const distances = corners.map((v) => new Vector3().fromArray(positions, 3 * v).distanceTo(point));
  return { vertex: corners[distances.indexOf(Math.min(...distances))]!, reach: Math.max(...distances) };
}
