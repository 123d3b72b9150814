// Makes the demo's shapes: build/demo-shapes/shapes.json. Deterministic; needs manifold-3d and bunny.
// Run by itself (node web-demo/build-shapes.mjs) or through build.mjs.
import { mkdirSync, readFileSync, writeFileSync, existsSync } from "node:fs";
import { createHash } from "node:crypto";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";
import { dirname, join } from "node:path";
import ManifoldModule from "manifold-3d";
import { balls, body, bodyColor, bounds, smile } from "./shapes/creature.mjs";
import { encodeMesh } from "./shapes/encode.mjs";
import { ball, tube } from "./shapes/parts.mjs";
import { remesh } from "./shapes/remesh.mjs";

const here = dirname(fileURLToPath(import.meta.url));
export const shapesFile = join(here, "../build/demo-shapes/shapes.json");
const require = createRequire(import.meta.url);

/** The page subdivides once (Loop), so this is twice the edge length a visitor sees. */
const edgeLength = 0.054;

const rows = (flat, stride, count = 3) =>
  Array.from({ length: flat.length / stride }, (_, i) => [...flat.slice(i * stride, i * stride + count)]);

/** The zero set of the creature's distance as even triangles. */
async function bodyMesh() {
  const manifold = await ManifoldModule();
  manifold.setup();
  const solid = manifold.Manifold.levelSet((p) => -body(p), bounds, edgeLength);
  const mesh = solid.getMesh();
  const points = rows(mesh.vertProperties, mesh.numProp);
  const triangles = rows(mesh.triVerts, 3);
  solid.delete();
  return remesh(points, triangles, body, edgeLength);
}

async function creature() {
  const { points, triangles } = await bodyMesh();
  const colors = points.map(bodyColor);
  const add = (part, color) => {
    triangles.push(...part.triangles.map((t) => t.map((v) => v + points.length)));
    points.push(...part.points);
    colors.push(...part.points.map(() => color));
  };
  for (const b of balls) add(ball(b.center, b.radius, b.radius > 0.05 ? 3 : 1), b.color);
  add(tube(smile.path, smile.radius, 5), smile.color);
  return { points, triangles, colors };
}

/** Everything the result depends on: rebuilt only when one of these changes. */
function fingerprint() {
  const hash = createHash("sha256");
  for (const file of [
    "build-shapes.mjs", "shapes/creature.mjs", "shapes/encode.mjs", "shapes/parts.mjs", "shapes/remesh.mjs",
    "shapes/sdf.mjs", "shapes/walk.mjs",
  ]) {
    hash.update(readFileSync(join(here, file)));
  }
  hash.update(readFileSync(join(here, "../package-lock.json")));
  return hash.digest("hex");
}

export async function buildShapes() {
  const made = fingerprint();
  if (existsSync(shapesFile) && JSON.parse(readFileSync(shapesFile, "utf8")).made === made) return;
  const bunny = require("bunny");
  const shapes = {
    creature: encodeMesh(await creature()),
    bunny: encodeMesh({ points: bunny.positions, triangles: bunny.cells }),
  };
  mkdirSync(dirname(shapesFile), { recursive: true });
  writeFileSync(shapesFile, JSON.stringify({ made, shapes }));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await buildShapes();
