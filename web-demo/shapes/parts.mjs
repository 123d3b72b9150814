// Small closed meshes that stand beside a body: { points: [[x, y, z]], triangles: [[a, b, c]] }.

/** An octahedron split `levels` times, pushed out a little: Loop subdivision pulls it in again. */
export function ball(center, radius, levels) {
  let points = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
  let triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
  for (let level = 0; level < levels; level++) {
    const middles = new Map();
    const middle = (a, b) => {
      const key = a < b ? `${a},${b}` : `${b},${a}`;
      if (!middles.has(key)) {
        const m = points[a].map((x, k) => x + points[b][k]);
        middles.set(key, points.push(m.map((x) => x / Math.hypot(...m))) - 1);
      }
      return middles.get(key);
    };
    triangles = triangles.flatMap(([a, b, c]) => {
      const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
      return [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]];
    });
  }
  const swell = radius * (1 + 0.5 / 4 ** levels);
  return { points: points.map((p) => p.map((x, k) => center[k] + swell * x)), triangles };
}

const sub = (a, b) => a.map((x, k) => x - b[k]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

/** A tube of `sides` sides along a path that nowhere runs along z, closed by a point at either end. */
export function tube(path, radius, sides) {
  const points = [path[0]];
  const triangles = [];
  const rings = path.length - 2;
  const corner = (ring, i) => 1 + ring * sides + (i % sides);
  for (let ring = 0; ring < rings; ring++) {
    const along = unit(sub(path[ring + 2], path[ring]));
    const u = unit(cross(along, [0, 0, 1]));
    const v = cross(along, u);
    for (let i = 0; i < sides; i++) {
      const angle = (2 * Math.PI * i) / sides;
      points.push(path[ring + 1].map((x, k) => x + radius * (Math.cos(angle) * u[k] + Math.sin(angle) * v[k])));
    }
  }
  const last = points.push(path.at(-1)) - 1;
  for (let i = 0; i < sides; i++) {
    triangles.push([0, corner(0, i + 1), corner(0, i)], [last, corner(rings - 1, i), corner(rings - 1, i + 1)]);
    for (let ring = 0; ring + 1 < rings; ring++) {
      const [a, b] = [corner(ring, i), corner(ring, i + 1)];
      triangles.push([a, b, b + sides], [a, b + sides, a + sides]);
    }
  }
  return { points, triangles };
}
