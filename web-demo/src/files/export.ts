// Downloads: the present, as files.
import { frameOf } from "pliant/picture";
import type { WritableShape } from "pliant/worker";
import type { Present } from "../edit/present.ts";
import { asFile } from "../shapes/refined.ts";
import type { PictureOn, ShapeData } from "../shapes/shape.ts";
import { connect } from "../solver/pliant.ts";
import { depthsOf } from "../view/layers.ts";
import { asPng } from "./picture.ts";

export type ExportKind = "png" | "svg" | "obj" | "glb" | "script";

/** The user's file without its ending, or the shape's own name. */
const baseName = ({ id, name }: { id: string; name: string }) => (id === "file" ? name.replace(/\.[^.]*$/, "") : id);

const types = { png: "image/png", svg: "image/svg+xml", obj: "model/obj", glb: "model/gltf-binary" };

export async function download(present: Present, kind: ExportKind): Promise<void> {
  const { doc, shown, positions } = present;
  const base = baseName(doc.shape);
  if (kind === "script") {
    save(`${base}-edit.json`, "application/json", JSON.stringify(present.script(), undefined, 1));
    return;
  }
  const name = `${base}-bent.${kind}`;
  save(name, types[kind], await (await connect()).write(await bent(shown, positions, depthsOf(doc)), name));
}

/** What is to be written: the visitor's file with its vertices elsewhere, or the shape as the page knows it. */
async function bent(shape: ShapeData, positions: Float32Array, depths?: Float64Array): Promise<WritableShape> {
  const { file, picture, dimension } = shape;
  const texture = !file && picture ? { texture: await asPng(picture) } : {};
  const placed = picture && dimension === 2 ? inFrame(picture, positions, depths) : { positions };
  return { ...asFile(shape), ...texture, ...placed };
}

/** In the plane: the frame of the picture, and as much more as it takes to show all of the shape. */
function inFrame({ image }: PictureOn, positions: Float32Array, depths: Float64Array | undefined): WritableShape {
  const flat = positions.filter((_, i) => i % 3 < 2);
  const { width, height, origin: [x, y] } = frameOf(flat);
  const [left, bottom] = [Math.min(0, x), Math.min(0, y)];
  const [right, top] = [Math.max(image.width, x + width), Math.max(image.height, y + height)];
  const frame = { width: right - left, height: top - bottom, origin: [left, bottom] as const };
  return { positions: flat, dimension: 2, frame, ...(depths ? { depths } : {}) };
}

function save(name: string, type: string, content: string | Uint8Array<ArrayBuffer>): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  // The browser has taken the address by the time the next task runs.
  setTimeout(() => URL.revokeObjectURL(link.href), 0);
}
