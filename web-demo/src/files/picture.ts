// A picture as a shape in the plane: a lattice over it, without the cells that show nothing.
import type { LoadedShape } from "../shapes/shape.ts";

const cells = 96; // along the longer side

/** Errors: not a picture; nothing to see. */
export async function readPicture(file: Blob): Promise<LoadedShape> {
  const image = await createImageBitmap(file).catch(() => {
    throw new Error("it is not a picture");
  });
  const step = Math.max(image.width, image.height) / cells;
  const [columns, rows] = [Math.max(1, Math.round(image.width / step)), Math.max(1, Math.round(image.height / step))];
  const visible = coverage(image, columns, rows);
  const ids = new Map<number, number>();
  const [positions, uv, triangles]: [number[], number[], number[]] = [[], [], []];
  const vertex = (column: number, row: number): number => {
    const key = row * (columns + 1) + column;
    if (!ids.has(key)) {
      ids.set(key, ids.size);
      const [u, v] = [column / columns, 1 - row / rows];
      positions.push(
        ((u - 0.5) * 2 * image.width) / (cells * step), ((v - 0.5) * 2 * image.height) / (cells * step), 0,
      );
      uv.push(u, v);
    }
    return ids.get(key)!;
  };
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      if (!visible(column, row)) continue;
      const [a, b] = [vertex(column, row), vertex(column + 1, row)];
      const [c, d] = [vertex(column, row + 1), vertex(column + 1, row + 1)];
      triangles.push(a, c, b, b, c, d);
    }
  }
  if (ids.size === 0) throw new Error("the picture is transparent throughout");
  const canvas = asCanvas(image, image.width, image.height);
  return {
    positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles), dimension: 2,
    picture: { image: canvas, uv: Float32Array.from(uv) },
  };
}

/** A canvas: what the renderer and the exports can both turn the right way up. */
export function asCanvas(image: ImageBitmap, width: number, height: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  canvas.getContext("2d")!.drawImage(image, 0, 0, width, height);
  return canvas;
}

/** Whether any of 4 x 4 samples of a cell is more than faintly opaque. */
function coverage(image: ImageBitmap, columns: number, rows: number): (column: number, row: number) => boolean {
  const width = 4 * columns;
  const { data } = asCanvas(image, width, 4 * rows).getContext("2d")!.getImageData(0, 0, width, 4 * rows);
  return (column, row) => {
    for (let y = 4 * row; y < 4 * row + 4; y++) {
      for (let x = 4 * column; x < 4 * column + 4; x++) if (data[4 * (y * width + x) + 3]! > 24) return true;
    }
    return false;
  };
}
