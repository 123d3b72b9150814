// Downloads: the present, as files.
import type { WritableShape } from "pliant/worker";
import type { Present } from "../edit/present.ts";
import { asFile } from "../shapes/refined.ts";
import type { ShapeData } from "../shapes/shape.ts";
import { connect } from "../solver/pliant.ts";

export type ExportKind = "obj" | "glb" | "script";

/** The user's file without its ending, or the shape's own name. */
const baseName = ({ id, name }: { id: string; name: string }) => (id === "file" ? name.replace(/\.[^.]*$/, "") : id);

const types = { obj: "model/obj", glb: "model/gltf-binary" };

export async function download(present: Present, kind: ExportKind): Promise<void> {
  const { doc, shown, positions } = present;
  const base = baseName(doc.shape);
  if (kind === "script") {
    save(`${base}-edit.json`, "application/json", JSON.stringify(present.script(), undefined, 1));
    return;
  }
  const name = `${base}-bent.${kind}`;
  save(name, types[kind], await (await connect()).write(await bent(shown, positions), name));
}

/** What is to be written: the visitor's file with its vertices elsewhere, or the shape as the page knows it. */
async function bent(shape: ShapeData, positions: Float32Array): Promise<WritableShape> {
  const texture = !shape.file && shape.picture ? { texture: await png(shape.picture.image) } : {};
  return { ...asFile(shape), ...texture, positions };
}

async function png(image: TexImageSource): Promise<Blob> {
  return new Promise((resolve) => (image as HTMLCanvasElement).toBlob((blob) => resolve(blob!), "image/png"));
}

function save(name: string, type: string, content: string | Uint8Array<ArrayBuffer>): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  // The browser has taken the address by the time the next task runs.
  setTimeout(() => URL.revokeObjectURL(link.href), 0);
}
