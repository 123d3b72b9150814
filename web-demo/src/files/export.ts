// Downloads: the present, as files.
import type { Present } from "../edit/present.ts";
import { writeGlb } from "./write_glb.ts";
import { writeObj } from "./write_obj.ts";

export type ExportKind = "obj" | "glb" | "script";

/** The user's file without its ending, or the shape's own name. */
const baseName = ({ id, name }: { id: string; name: string }) => (id === "file" ? name.replace(/\.[^.]*$/, "") : id);

export async function download(present: Present, kind: ExportKind): Promise<void> {
  const { doc, shown, positions, normals } = present;
  const base = baseName(doc.shape);
  if (kind === "obj") save(`${base}-bent.obj`, "model/obj", writeObj(shown, positions));
  if (kind === "glb") save(`${base}-bent.glb`, "model/gltf-binary", await writeGlb(shown, positions, normals));
  if (kind === "script") save(`${base}-edit.json`, "application/json", JSON.stringify(present.script(), undefined, 1));
}

function save(name: string, type: string, content: string | Uint8Array<ArrayBuffer>): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  // The browser has taken the address by the time the next task runs.
  setTimeout(() => URL.revokeObjectURL(link.href), 0);
}
