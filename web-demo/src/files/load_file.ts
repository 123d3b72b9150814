// The visitor's own file as a shape: read by the library, in its worker. Whatever goes wrong is said in words.
import type { ReadOptions, ShapeFile } from "pliant/worker";
import { ofVertices } from "../shapes/refined.ts";
import type { LoadedShape, ShapeData } from "../shapes/shape.ts";
import { connect } from "../solver/pliant.ts";
import { asCanvas, readPicture } from "./picture.ts";
import { turn } from "./turn.ts";

const shapes = ["obj", "ply", "off", "stl", "glb", "xyz"];
const pictures = ["png", "jpg", "jpeg", "webp"];

/** Errors: a sentence for the visitor; what a signal stopped is an error without one. */
export async function loadFile(file: File, options: ReadOptions): Promise<ShapeData> {
  const ending = file.name.toLowerCase().split(".").pop() ?? "";
  if (![...shapes, ...pictures].includes(ending)) {
    const known = [...shapes, ...pictures].map((name) => `.${name}`).join(", ");
    throw new Error(`${file.name}: this kind of file is not known here. Known are ${known}.`);
  }
  try {
    const loaded = pictures.includes(ending)
      ? await readPicture(file)
      : await asShape(await (await connect()).read(file, file.name, options));
    return { id: "file", name: file.name, ...loaded };
  } catch (error) {
    if (options.signal?.aborted) throw new Error("", { cause: error });
    const reason = (error instanceof Error ? error.message : String(error)).replace(`${file.name}: `, "");
    throw new Error(`${file.name} could not be read: ${reason}.`);
  }
}

async function asShape(file: ShapeFile): Promise<LoadedShape> {
  const picture = file.texture && (await createImageBitmap(file.texture));
  await turn();
  const positions = new Float32Array(file.positions);
  await turn();
  return {
    positions, exact: file.positions, triangles: file.triangles, dimension: 3, file,
    ...(picture ? { picture: { image: asCanvas(picture, picture.width, picture.height), uv: ofVertices(file) } } : {}),
    ...(!picture && file.colors.length > 0 ? { colors: file.colors } : {}),
  };
}
