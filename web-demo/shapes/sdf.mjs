// Signed distances (negative inside) of the few solids the demo's shapes are made of.
// Points are [x, y, z] arrays; lengths are in the shape's own unit.

const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const clamp01 = (t) => Math.min(1, Math.max(0, t));

export const sphere = (p, center, radius) => Math.hypot(...sub(p, center)) - radius;

/** Not exact away from the surface, but its zero set is the ellipsoid and its slope is near one. */
export function ellipsoid(p, center, radii) {
  const d = sub(p, center);
  const k0 = Math.hypot(d[0] / radii[0], d[1] / radii[1], d[2] / radii[2]);
  const k1 = Math.hypot(d[0] / radii[0] ** 2, d[1] / radii[1] ** 2, d[2] / radii[2] ** 2);
  return k1 === 0 ? -Math.min(...radii) : (k0 * (k0 - 1)) / k1;
}

/** A segment a-b whose radius runs linearly from ra to rb. */
export function taper(p, a, b, ra, rb) {
  const ab = sub(b, a);
  const ap = sub(p, a);
  const t = clamp01(dot(ap, ab) / dot(ab, ab));
  return Math.hypot(ap[0] - t * ab[0], ap[1] - t * ab[1], ap[2] - t * ab[2]) - (ra + t * (rb - ra));
}

/** A chain of tapers through [x, y, z, radius] points, joined smoothly. */
export function chain(p, points, blend) {
  let d = Infinity;
  for (let i = 0; i + 1 < points.length; i++) {
    const [a, b] = [points[i], points[i + 1]];
    d = smoothMin(d, taper(p, a, b, a[3], b[3]), blend);
  }
  return d;
}

/** min(a, b) with a fillet of about `blend`: a cubic, so that curvature stays bounded. */
export function smoothMin(a, b, blend) {
  if (!Number.isFinite(a)) return b;
  const h = Math.max(blend - Math.abs(a - b), 0) / blend;
  return Math.min(a, b) - (h * h * h * blend) / 6;
}

export const smoothMax = (a, b, blend) => -smoothMin(-a, -b, blend);

/** Central differences. */
export function gradient(f, p, step = 1e-4) {
  return [0, 1, 2].map((axis) => {
    const [lo, hi] = [[...p], [...p]];
    lo[axis] -= step;
    hi[axis] += step;
    return (f(hi) - f(lo)) / (2 * step);
  });
}

/** The nearest point of the zero set, by a few Newton steps along the gradient. */
export function project(f, p) {
  let q = p;
  for (let i = 0; i < 4; i++) {
    const g = gradient(f, q);
    const s = f(q) / Math.max(dot(g, g), 1e-6);
    q = [q[0] - s * g[0], q[1] - s * g[1], q[2] - s * g[2]];
  }
  return q;
}
