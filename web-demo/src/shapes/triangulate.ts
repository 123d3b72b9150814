// Even triangulation of a region of the plane given by a signed distance: a lattice of equilateral
// triangles, its points near the outline drawn onto it, what still crosses the outline cut there.

export interface PlaneMesh {
  /** 2 n coordinates. */
  points: Float64Array;
  /** 3 m ids, counter-clockwise. */
  triangles: Uint32Array;
}

interface Frame {
  min: readonly [number, number];
  max: readonly [number, number];
}

type Distance = (x: number, y: number) => number;

/** The lattice: points, their distances (0 on the outline), and its triangles. */
function lattice(distance: Distance, { min, max }: Frame, spacing: number) {
  const rowHeight = (spacing * Math.sqrt(3)) / 2;
  const columns = Math.ceil((max[0] - min[0]) / spacing) + 2;
  const rows = Math.ceil((max[1] - min[1]) / rowHeight) + 2;
  const points: [number, number][] = [];
  const side: number[] = [];
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      let p: [number, number] = [min[0] + (column - 0.5 + (row % 2) / 2) * spacing, min[1] + (row - 0.5) * rowHeight];
      let d = distance(...p);
      if (Math.abs(d) < 0.35 * spacing) [p, d] = [ontoOutline(distance, p, spacing), 0];
      points.push(p);
      side.push(d);
    }
  }
  const triangles: [number, number, number][] = [];
  for (let row = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const a = row * columns + column;
      const up = a + columns;
      if (row % 2 === 0) triangles.push([a, a + 1, up], [a + 1, up + 1, up]);
      else triangles.push([a, a + 1, up + 1], [a, up + 1, up]);
    }
  }
  return { points, side, triangles };
}

function ontoOutline(distance: Distance, p: [number, number], spacing: number): [number, number] {
  const step = 1e-3 * spacing;
  let [x, y] = p;
  for (let i = 0; i < 4; i++) {
    const gx = (distance(x + step, y) - distance(x - step, y)) / (2 * step);
    const gy = (distance(x, y + step) - distance(x, y - step)) / (2 * step);
    const t = distance(x, y) / Math.max(gx * gx + gy * gy, 1e-6);
    [x, y] = [x - t * gx, y - t * gy];
  }
  return [x, y];
}

export function triangulate(distance: Distance, frame: Frame, spacing: number): PlaneMesh {
  const { points, side, triangles } = lattice(distance, frame, spacing);
  const cuts = new Map<string, number>();
  const cut = (inside: number, outside: number): number => {
    const key = `${inside},${outside}`;
    if (!cuts.has(key)) {
      const t = side[inside]! / (side[inside]! - side[outside]!);
      const [a, b] = [points[inside]!, points[outside]!];
      cuts.set(key, points.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]) - 1);
    }
    return cuts.get(key)!;
  };
  const kept: number[] = [];
  for (const triangle of triangles) {
    if (!triangle.some((v) => side[v]! < 0)) continue;
    // Walk round the triangle and keep what is inside: a polygon of three or four corners.
    const polygon: number[] = [];
    triangle.forEach((v, i) => {
      const w = triangle[(i + 1) % 3]!;
      if (side[v]! <= 0) polygon.push(v);
      if (side[v]! * side[w]! < 0) polygon.push(side[v]! < 0 ? cut(v, w) : cut(w, v));
    });
    for (let i = 1; i + 1 < polygon.length; i++) kept.push(polygon[0]!, polygon[i]!, polygon[i + 1]!);
  }
  return compact(points, kept);
}

/** Drops the points that no triangle uses. */
function compact(points: [number, number][], triangles: number[]): PlaneMesh {
  const ids = new Map<number, number>();
  const renumbered = Uint32Array.from(triangles, (v) => {
    if (!ids.has(v)) ids.set(v, ids.size);
    return ids.get(v)!;
  });
  const flat = new Float64Array(2 * ids.size);
  for (const [v, id] of ids) flat.set(points[v]!, 2 * id);
  return { points: flat, triangles: renumbered };
}
