// Pip, the creature a newcomer meets: one smooth union of ellipsoids and tapers, with eyes as
// components of their own. About two units tall, standing on y = 0, looking along +z.
import { chain, ellipsoid, project, smoothMax, smoothMin, sphere, taper } from "./sdf.mjs";

/** Both sides of the body from one: x >= 0 is computed. */
const mirrored = (p) => [Math.abs(p[0]), p[1], p[2]];

const arm = [[0.26, 1.06, 0.02, 0.13], [0.56, 0.98, 0.05, 0.105], [0.86, 1.06, 0.11, 0.1]];
const tail = [
  [0, 0.46, -0.2, 0.25], [0.0, 0.28, -0.52, 0.19], [0.12, 0.21, -0.82, 0.14],
  [0.33, 0.27, -1.06, 0.105], [0.52, 0.46, -1.16, 0.075], [0.58, 0.68, -1.12, 0.05],
];
const crest = [
  [0, 1.93, -0.16, 0.075], [0, 1.7, -0.36, 0.085], [0, 1.22, -0.3, 0.08], [0, 0.98, -0.38, 0.09],
  [0, 0.72, -0.43, 0.09], [0, 0.5, -0.58, 0.08], [0.03, 0.43, -0.75, 0.07], [0.14, 0.38, -0.9, 0.055],
];

const ear = (q) => smoothMin(
  taper(q, [0.2, 1.78, -0.02], [0.4, 2.12, -0.08], 0.1, 0.085),
  taper(q, [0.4, 2.12, -0.08], [0.5, 2.34, -0.06], 0.085, 0.058), 0.08);
const paw = (q) => smoothMin(
  ellipsoid(q, [0.98, 1.11, 0.14], [0.16, 0.135, 0.13]),
  taper(q, [0.95, 1.2, 0.16], [0.96, 1.3, 0.22], 0.06, 0.045), 0.06);
const torso = (p) => smoothMin(
  ellipsoid(p, [0, 0.62, 0.02], [0.44, 0.44, 0.4]), ellipsoid(p, [0, 1.0, 0], [0.3, 0.36, 0.27]), 0.25);
const head = (p) => smoothMin(
  ellipsoid(p, [0, 1.6, 0.02], [0.42, 0.37, 0.37]), ellipsoid(p, [0, 1.49, 0.3], [0.25, 0.165, 0.2]), 0.16);

/** The body's signed distance; the soles are flat, a little above the ground. */
export function body(p) {
  const q = mirrored(p);
  let d = smoothMin(torso(p), head(p), 0.14);
  d = smoothMin(d, smoothMin(chain(q, arm, 0.08), paw(q), 0.07), 0.12);
  const leg = smoothMin(taper(q, [0.22, 0.46, 0], [0.27, 0.16, 0.04], 0.21, 0.16),
    ellipsoid(q, [0.29, 0.12, 0.17], [0.19, 0.15, 0.29]), 0.1);
  d = smoothMin(d, leg, 0.12);
  d = smoothMin(d, chain(p, tail, 0.1), 0.14);
  d = smoothMin(d, ear(q), 0.09);
  for (const bump of crest) d = smoothMin(d, sphere(p, bump, bump[3]), 0.07);
  return smoothMax(d, 0.02 - p[1], 0.06);
}

const dark = [0.05, 0.06, 0.09];

/** The point of the body nearest to p, about. */
function onBody(p) {
  return project(body, p);
}

/** Spheres beside the body, eyes and nostrils: center, radius, colour. */
export const balls = [-1, 1].flatMap((side) => [
  { center: [side * 0.185, 1.665, 0.315], radius: 0.085, color: dark },
  { center: [side * 0.185 + 0.028, 1.7, 0.388], radius: 0.024, color: [1, 1, 1] },
  { center: onBody([side * 0.075, 1.56, 0.6]), radius: 0.018, color: dark },
]);

/** The smile: a thin tube along the muzzle. */
export const smile = {
  path: Array.from({ length: 13 }, (_, i) => {
    const t = i / 6 - 1;
    return onBody([0.15 * t, 1.395 + 0.05 * t * t, 0.6 - 0.1 * t * t]);
  }),
  radius: 0.011,
  color: [0.33, 0.16, 0.14],
};

const skin = [0.36, 0.69, 0.6];
const shade = [0.24, 0.55, 0.53];
const cream = [0.97, 0.91, 0.77];
const blush = [0.95, 0.53, 0.5];

const smooth = (from, to, x) => {
  const t = Math.min(1, Math.max(0, (x - from) / (to - from)));
  return t * t * (3 - 2 * t);
};
const mix = (a, b, t) => a.map((v, i) => v + t * (b[i] - v));

/** Linear-looking sRGB colour of the body at a surface point. */
export function bodyColor(p) {
  const q = mirrored(p);
  let c = mix(skin, shade, smooth(0.12, -0.25, p[2]) * 0.55);
  const belly = ellipsoid(p, [0, 0.72, 0.42], [0.27, 0.4, 0.3]);
  c = mix(c, cream, smooth(0.04, -0.05, belly));
  c = mix(c, cream, smooth(0.03, -0.03, ellipsoid(p, [0, 1.44, 0.5], [0.2, 0.11, 0.22])));
  for (const bump of crest) c = mix(c, blush, smooth(0.045, -0.01, sphere(p, bump, bump[3])));
  c = mix(c, blush, smooth(0.08, 0.02, sphere(q, [0.33, 1.52, 0.25], 0.05)));
  c = mix(c, blush, 0.8 * smooth(0.02, -0.04, ellipsoid(q, [0.42, 2.12, 0.03], [0.075, 0.17, 0.08])));
  return c;
}

export const bounds = { min: [-1.3, -0.1, -1.45], max: [1.3, 2.5, 0.8] };
