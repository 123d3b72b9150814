// A deformed picture as SVG: its triangles, each the picture under an affine map, clipped.

/**
 * How far triangles overlap, in pixels of the picture: viewers smooth each edge, and between two the ground would show.
 */
const overlap = 0.6;

export interface SvgDrawing {
  /** The picture, as a data URL. */
  href: string;
  /** Of the picture. */
  width: number;
  height: number;
  /** What the file shows: pixels from the bottom left corner, y up. */
  frame: { width: number; height: number; origin: readonly [number, number] };
  positions: ArrayLike<number>;
  texcoords: ArrayLike<number>;
  /** From back to front. */
  triangles: ArrayLike<number>;
}

export function svgOf({ href, width, height, frame, positions, texcoords, triangles }: SvgDrawing): string {
  const lines = [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${frame.width} ${frame.height}"`,
    ` width="${frame.width}" height="${frame.height}">`,
    `<defs><image id="picture" width="${width}" height="${height}" preserveAspectRatio="none" href="${href}"/></defs>`,
  ];
  for (let t = 0; t < triangles.length; t += 3) {
    const ids = [triangles[t], triangles[t + 1], triangles[t + 2]];
    const from = ids.map((v): Point => [texcoords[2 * v] * width, (1 - texcoords[2 * v + 1]) * height]);
    const to = ids.map((v): Point => [
      positions[2 * v] - frame.origin[0],
      frame.height - (positions[2 * v + 1] - frame.origin[1]),
    ]);
    const matrix = affine(from, to);
    if (!matrix) continue;
    const corners = widened(from)
      .map((p) => p.map(text).join(" "))
      .join("L");
    lines.push(
      `<clipPath id="t${t / 3}"><path d="M${corners}Z"/></clipPath>`,
      `<use href="#picture" clip-path="url(#t${t / 3})" transform="matrix(${matrix.map(text).join(" ")})"/>`,
    );
  }
  return `${lines.join("\n")}\n</svg>\n`;
}

type Point = [x: number, y: number];

const text = (x: number): string => String(Number(x.toFixed(5)));

/** The map that takes three points to three others, as SVG writes it; undefined for points on a line. */
function affine([a, b, c]: Point[], [p, q, r]: Point[]): number[] | undefined {
  const [bx, by, cx, cy] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
  const twice = bx * cy - by * cx;
  if (Math.abs(twice) < 1e-9) return undefined;
  const rows = [0, 1].map((k) => {
    const [u, v] = [q[k] - p[k], r[k] - p[k]];
    const [dx, dy] = [(u * cy - v * by) / twice, (v * bx - u * cx) / twice];
    return [dx, dy, p[k] - dx * a[0] - dy * a[1]];
  });
  return [rows[0][0], rows[1][0], rows[0][1], rows[1][1], rows[0][2], rows[1][2]];
}

/** Corners moved outwards, so that all sides are `overlap` farther out; sharp ones no more than four times as far. */
function widened(points: Point[]): Point[] {
  const [a, b, c] = points;
  const turn = Math.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  return points.map((p, i) => {
    const [before, after] = [points[(i + 2) % 3], points[(i + 1) % 3]];
    const [m, n] = [outward(before, p, turn), outward(p, after, turn)];
    const along = Math.max(1 + m[0] * n[0] + m[1] * n[1], 0.125);
    return [p[0] + (overlap * (m[0] + n[0])) / along, p[1] + (overlap * (m[1] + n[1])) / along];
  });
}

function outward(from: Point, to: Point, turn: number): Point {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  return [(turn * dy) / length, (-turn * dx) / length];
}
