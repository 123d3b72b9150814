// The page's picture to begin with: a scout with a scarf, drawn from capsules and discs. It needs no canvas, so tests
// draw it, too.

type Point = readonly [x: number, y: number];
type Color = readonly [red: number, green: number, blue: number];
type Distance = (x: number, y: number) => number;

/** What is painted over what is there: of one colour where the distance is below zero, darker at its edge by `ink`. */
interface Layer {
  distance: Distance;
  color: Color;
  ink?: boolean;
  shade?: number;
}

const night: Color = [44, 34, 58];
const skin: Color = [246, 200, 160];
const coat: Color = [42, 130, 142];
const trousers: Color = [74, 74, 118];
const leather: Color = [122, 74, 48];
const red: Color = [221, 74, 66];
const straw: Color = [240, 190, 84];

const disc =
  ([cx, cy]: Point, radius: number): Distance =>
  (x, y) =>
    Math.hypot(x - cx, y - cy) - radius;

/** Close to the true distance near the line, never more than it far off. */
const ellipse =
  ([cx, cy]: Point, a: number, b: number): Distance =>
  (x, y) => {
    const [u, v] = [(x - cx) / a, (y - cy) / b];
    const k = Math.hypot(u, v);
    return Math.max((k - 1) * Math.min(a, b), Math.min(0.05, (k * (k - 1)) / (Math.hypot(u / a, v / b) || 1)));
  };

/** Thick from one radius to another. */
function capsule([ax, ay]: Point, [bx, by]: Point, from: number, to = from): Distance {
  const [dx, dy] = [bx - ax, by - ay];
  return (x, y) => {
    const t = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)));
    return Math.hypot(x - ax - t * dx, y - ay - t * dy) - from - t * (to - from);
  };
}

const both =
  (...parts: Distance[]): Distance =>
  (x, y) =>
    Math.min(...parts.map((part) => part(x, y)));
const within =
  (outer: Distance, inner: Distance): Distance =>
  (x, y) =>
    Math.max(outer(x, y), inner(x, y));
const below =
  (height: number): Distance =>
  (_, y) =>
    y - height;
const above =
  (height: number): Distance =>
  (_, y) =>
    height - y;

const head = ellipse([0, 0.5], 0.2, 0.19);
const body = both(capsule([0, 0.18], [0, -0.12], 0.15, 0.19), capsule([-0.06, 0.2], [0.06, 0.2], 0.13));

/** On one side (-1 or 1): arm or leg, from the body outwards. */
const limbs = (side: number): Layer[] => [
  {
    distance: both(
      capsule([side * 0.1, -0.2], [side * 0.2, -0.52], 0.105, 0.085),
      capsule([side * 0.2, -0.52], [side * 0.24, -0.78], 0.085, 0.075),
    ),
    color: trousers,
    ink: true,
  },
  {
    distance: both(
      capsule([side * 0.24, -0.74], [side * 0.245, -0.86], 0.088),
      capsule([side * 0.25, -0.87], [side * 0.36, -0.885], 0.078, 0.07),
    ),
    color: leather,
    ink: true,
  },
  { distance: disc([side * 0.79, 0.2], 0.082), color: skin, ink: true },
  {
    distance: both(
      capsule([side * 0.14, 0.2], [side * 0.42, 0.2], 0.1, 0.08),
      capsule([side * 0.42, 0.2], [side * 0.7, 0.2], 0.08, 0.075),
    ),
    color: coat,
    ink: true,
    shade: 0.1,
  },
  { distance: capsule([side * 0.705, 0.2], [side * 0.715, 0.2], 0.082), color: straw, ink: true },
];

const face = (side: number): Layer[] => [
  { distance: ellipse([side * 0.075, 0.505], 0.026, 0.036), color: night },
  { distance: disc([side * 0.075 + 0.01, 0.52], 0.009), color: [255, 255, 255] },
  { distance: ellipse([side * 0.125, 0.44], 0.032, 0.02), color: [240, 150, 130] },
];

const layers: Layer[] = [
  ...limbs(-1),
  ...limbs(1),
  { distance: body, color: coat, ink: true, shade: 0.1 },
  { distance: within(body, within(below(-0.08), above(-0.135))), color: leather },
  { distance: capsule([-0.025, -0.108], [0.025, -0.108], 0.03), color: straw, ink: true },
  ...[0.16, 0.04].map((y): Layer => ({ distance: disc([0, y], 0.022), color: straw })),
  { distance: head, color: skin, ink: true },
  ...face(-1),
  ...face(1),
  {
    distance: within(
      within((x, y) => Math.abs(Math.hypot(x, y - 0.47) - 0.075) - 0.011, below(0.44)),
      below(0.44),
    ),
    color: night,
  },
  {
    distance: both(capsule([-0.13, 0.32], [0.13, 0.32], 0.06), capsule([0.1, 0.3], [0.17, 0.13], 0.045, 0.055)),
    color: red,
    ink: true,
    shade: 0.1,
  },
  { distance: within(ellipse([0, 0.66], 0.19, 0.2), above(0.62)), color: straw, ink: true, shade: 0.08 },
  { distance: within(within(ellipse([0, 0.66], 0.19, 0.2), above(0.62)), below(0.7)), color: red },
  { distance: ellipse([0, 0.625], 0.34, 0.045), color: straw, ink: true, shade: 0.08 },
];

/** Width of the line around a layer, and the side of the squares that are painted with the layers that reach them. */
const ink = 0.014;
const tile = 32;

/** The scout at a size in pixels, on nothing. */
export function scout(size = 1024): { width: number; height: number; data: Uint8ClampedArray<ArrayBuffer> } {
  const data = new Uint8ClampedArray(4 * size * size);
  const perPixel = 2 / size;
  const place = (column: number, row: number): Point => [(column + 0.5) * perPixel - 1, 1 - (row + 0.5) * perPixel];
  for (let top = 0; top < size; top += tile) {
    for (let left = 0; left < size; left += tile) {
      const [x, y] = place(left + tile / 2, top + tile / 2);
      const near = layers.filter(({ distance }) => distance(x, y) < tile * perPixel + ink);
      if (near.length === 0) continue;
      for (let row = top; row < Math.min(size, top + tile); row++) {
        for (let column = left; column < Math.min(size, left + tile); column++) {
          paint(data, 4 * (row * size + column), place(column, row), near, perPixel);
        }
      }
    }
  }
  return { width: size, height: size, data };
}

/** Where a point of the drawing lies in the picture of that size: pixels from the bottom left corner. */
export const inScout = ([x, y]: Point, size = 1024): [number, number] => [((x + 1) * size) / 2, ((y + 1) * size) / 2];

/** One pixel: layers over each other, each smooth over a pixel. */
function paint(data: Uint8ClampedArray, at: number, [x, y]: Point, near: readonly Layer[], pixel: number): void {
  let [red, green, blue, alpha] = [0, 0, 0, 0];
  const over = (color: Color, cover: number, light: number) => {
    red += cover * (light * color[0] - red);
    green += cover * (light * color[1] - green);
    blue += cover * (light * color[2] - blue);
    alpha += cover * (1 - alpha);
  };
  const cover = (distance: number) => Math.min(1, Math.max(0, 0.5 - distance / pixel));
  for (const layer of near) {
    const distance = layer.distance(x, y);
    if (distance > ink + pixel) continue;
    if (layer.ink) over(night, cover(distance - ink), 1);
    const light = 1 - (layer.shade ?? 0) * Math.min(1, Math.max(0, 1 + distance / 0.06));
    over(layer.color, cover(distance), light);
  }
  if (alpha === 0) return;
  [data[at], data[at + 1], data[at + 2], data[at + 3]] = [red / alpha, green / alpha, blue / alpha, 255 * alpha];
}
