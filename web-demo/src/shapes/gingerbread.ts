// A gingerbread figure in the plane: a smooth outline, iced by a canvas.
import { pictureShape } from "../files/picture.ts";
import type { ShapeData } from "./shape.ts";

const smoothMin = (a: number, b: number, blend: number): number => {
  const h = Math.max(blend - Math.abs(a - b), 0) / blend;
  return Math.min(a, b) - (h * h * h * blend) / 6;
};

function capsule(x: number, y: number, a: [number, number], b: [number, number], radius: number): number {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const t = Math.min(1, Math.max(0, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy)));
  return Math.hypot(x - a[0] - t * dx, y - a[1] - t * dy) - radius;
}

/** Signed distance to the outline, negative inside; symmetric in x. */
function outline(x: number, y: number): number {
  const side = Math.abs(x);
  let d = capsule(side, y, [0, -0.25], [0, 0.1], 0.34);
  d = smoothMin(d, capsule(side, y, [0.1, 0.14], [0.72, 0.3], 0.19), 0.16);
  d = smoothMin(d, capsule(side, y, [0.18, -0.35], [0.36, -0.98], 0.21), 0.16);
  return smoothMin(d, Math.hypot(side, y - 0.72) - 0.37, 0.16);
}

const frame = { min: [-1, -1.25] as const, max: [1, 1.15] as const };

function paintDough(context: CanvasRenderingContext2D, width: number, height: number): void {
  const image = context.createImageData(width, height);
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) {
      const x = frame.min[0] + ((column + 0.5) / width) * (frame.max[0] - frame.min[0]);
      const y = frame.max[1] - ((row + 0.5) / height) * (frame.max[1] - frame.min[1]);
      const d = outline(x, y);
      const grain = 0.5 + 0.5 * Math.sin(91 * x + 57 * y) * Math.sin(73 * y - 41 * x);
      const baked = Math.min(1, Math.max(0, 1 + d / 0.16));
      const light = 1 - 0.3 * baked * baked + 0.03 * grain;
      const wave = 0.007 * Math.sin(38 * x) * Math.sin(38 * y);
      const icing = Math.min(1, Math.max(0, (0.02 - Math.abs(d + 0.085 + wave)) / 0.007));
      const at = 4 * (row * width + column);
      [198, 126, 66].forEach((c, k) => {
        image.data[at + k] = light * c * (1 - icing) + icing * [255, 250, 242][k]!;
      });
      image.data[at + 3] = 255 * Math.min(1, Math.max(0, 0.5 - (d * width) / (frame.max[0] - frame.min[0])));
    }
  }
  context.putImageData(image, 0, 0);
}

function paintFace(context: CanvasRenderingContext2D): void {
  const dot = (x: number, y: number, r: number, color: string) => {
    context.fillStyle = color;
    context.beginPath();
    context.arc(x, y, r, 0, 2 * Math.PI);
    context.fill();
  };
  for (const side of [-1, 1]) {
    dot(side * 0.13, 0.79, 0.042, "#3b2415");
    dot(side * 0.13 + 0.013, 0.805, 0.013, "#fff");
    dot(side * 0.21, 0.67, 0.045, "#e98a78");
  }
  context.strokeStyle = "#fffaf2";
  context.lineWidth = 0.032;
  context.lineCap = "round";
  context.beginPath();
  context.arc(0, 0.7, 0.13, Math.PI * 1.15, Math.PI * 1.85);
  context.stroke();
  for (const [y, color] of [[0.2, "#d8473f"], [-0.02, "#4f9d69"], [-0.24, "#e9b44c"]] as const) {
    dot(0, y, 0.056, color);
    dot(-0.016, y + 0.018, 0.015, "#ffffffb0");
  }
}

function icing(): ImageData {
  const canvas = document.createElement("canvas");
  canvas.width = 640;
  canvas.height = 768;
  const context = canvas.getContext("2d")!;
  paintDough(context, canvas.width, canvas.height);
  const scale = canvas.width / (frame.max[0] - frame.min[0]);
  context.setTransform(scale, 0, 0, -scale, -frame.min[0] * scale, frame.max[1] * scale);
  paintFace(context);
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

export async function gingerbread(): Promise<ShapeData> {
  const { width, height, data } = icing();
  const scale = width / (frame.max[0] - frame.min[0]);
  const [right, up] = [(x: number) => (x - frame.min[0]) * scale, (y: number) => (y - frame.min[1]) * scale];
  return {
    id: "gingerbread", name: "Gingerbread (2D)", ...(await pictureShape({ width, height, data })),
    start: {
      fixed: ([x, y]) => y < up(-0.92) && x < right(0),
      handles: [{ name: "hand", center: [right(0.78), up(0.31), 0], radius: 0.12 * scale }],
    },
  };
}
