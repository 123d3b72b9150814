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
  const first = raycaster.intersectObject(view.object, false)[0];
  if (!first) return undefined;
  const toViewer = raycaster.ray.direction.clone().negate();
  if (!(view.object instanceof Mesh)) return { point: first.point.clone(), normal: toViewer, vertex: first.index! };
  const normal = first.face!.normal.clone();
  if (normal.dot(toViewer) < 0) normal.negate();
  return { point: first.point.clone(), normal, vertex: nearestCorner(first, present.positions) };
}

function nearestCorner({ face, point }: Intersection, positions: Float32Array): number {
  const corners = [face!.a, face!.b, face!.c];
  const distances = corners.map((v) => new Vector3().fromArray(positions, 3 * v).distanceToSquared(point));
  return corners[distances.indexOf(Math.min(...distances))]!;
}
