// Builds the demo page: dist/demo/index.html, one file with everything in it, so that it also opens
// from a disk. Called by scripts/build.mjs after the package; by hand: node web-demo/build.mjs.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "vite";
import { buildShapes, shapesFile } from "./build-shapes.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "..");

/** Bytes. */
const budget = { raw: 1.2e6, gzip: 350e3 };

/** The module "#shapes": what build-shapes.mjs made. */
const shapesPlugin = {
  name: "pliant-shapes",
  resolveId: (id) => (id === "#shapes" ? "\0shapes" : undefined),
  load: (id) => (id === "\0shapes" ? `export const shapes = ${JSON.stringify(JSON.parse(readFileSync(shapesFile, "utf8")).shapes)}` : undefined),
};

/** Puts script and style into the page: a page on a disk may load nothing else. */
const inlinePlugin = {
  name: "pliant-inline-page",
  enforce: "post",
  generateBundle(_, bundle) {
    const page = bundle["index.html"];
    for (const [name, part] of Object.entries(bundle)) {
      const file = name.split("/").pop();
      if (name.endsWith(".js")) {
        const script = `<script type="module">${part.code.replaceAll("</script", "<\\/script")}</script>`;
        page.source = page.source.replace(new RegExp(`<script[^>]*${file}[^>]*></script>`), "").replace("</body>", () => `${script}\n</body>`);
      } else if (name.endsWith(".css")) {
        page.source = page.source.replace(new RegExp(`<link[^>]*${file}[^>]*>`), () => `<style>${part.source}</style>`);
      } else continue;
      delete bundle[name];
    }
  },
};

export async function buildDemo({ out = join(root, "dist/demo") } = {}) {
  await buildShapes();
  const result = await build({
    configFile: false,
    root: here,
    logLevel: "warn",
    plugins: [shapesPlugin, inlinePlugin],
    build: { write: false, target: "es2022", assetsInlineLimit: 1e8, cssCodeSplit: false, modulePreload: false, chunkSizeWarningLimit: 2000 },
  });
  const files = result.output.map((file) => file.fileName);
  if (files.join() !== "index.html") throw new Error(`the demo page should be one file, but is ${files.join(", ")}`);
  const page = result.output[0].source;
  mkdirSync(out, { recursive: true });
  writeFileSync(join(out, "index.html"), page);
  const [raw, gzip] = [Buffer.byteLength(page), gzipSync(page, { level: 9 }).length];
  console.log(`dist/demo/index.html  ${(raw / 1000).toFixed(0)} kB, gzip ${(gzip / 1000).toFixed(0)} kB`);
  if (raw > budget.raw || gzip > budget.gzip) {
    throw new Error(`the demo page is over its budget of ${budget.raw / 1000} kB, gzip ${budget.gzip / 1000} kB`);
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await buildDemo();
