// Builds the demo page: dist/demo/index.html, one file with everything in it, so that it also opens
// from a disk. Called by scripts/build.mjs after the package; by hand: node web-demo/build.mjs.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "vite";
import { buildShapes, shapesFile } from "./build-shapes.mjs";
import { slimThree } from "./slim-three.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "..");

/**
 * Bytes. The plan was 350 kB gzipped with 100 kB of WASM; the modules alone take 285 kB of what is here, inlined, the
 * glTF library 42.
 */
const budget = { raw: 1.55e6, gzip: 690e3 };

/** The module "#shapes": what build-shapes.mjs made. */
const shapesPlugin = {
  name: "pliant-shapes",
  resolveId: (id) => (id === "#shapes" ? "\0shapes" : undefined),
  load: (id) =>
    id === "\0shapes"
      ? `export const shapes = ${JSON.stringify(JSON.parse(readFileSync(shapesFile, "utf8")).shapes)}`
      : undefined,
};

/**
 * The package, as it is built. Its worker entry has everything inside: in a page of one file there is nothing beside it
 * to load.
 */
const packagePlugin = (dist) => ({
  name: "pliant-package",
  enforce: "pre",
  resolveId: (id) => (id === "pliant/worker" || id === "pliant/picture" ? join(dist, `${id.slice(7)}.js`) : undefined),
  transform(code, id) {
    if (id !== join(dist, "worker.js")) return undefined;
    const beside = /new URL\((["'`])\.\/(?:pliant\.wasm|pliant-io\.wasm|worker-host\.js)\1,\s*import\.meta\.url\)/g;
    if (code.match(beside)?.length !== 3) {
      throw new Error(`${id}: expected it to name pliant.wasm, pliant-io.wasm and worker-host.js once each`);
    }
    return code.replace(beside, 'new URL("about:blank")');
  },
});

/** Puts script and style into the page: a page on a disk may load nothing else. */
const inlinePlugin = {
  name: "pliant-inline-page",
  enforce: "post",
  generateBundle: { order: "post", handler: inlineBundle },
};

function inlineBundle(_, bundle) {
  const page = bundle["index.html"];
  for (const [name, part] of Object.entries(bundle)) {
    const file = name.split("/").pop();
    if (name.endsWith(".js")) {
      const script = `<script type="module">${part.code.replaceAll("</script", "<\\/script")}</script>`;
      page.source = page.source
        .replace(new RegExp(`<script[^>]*${file}[^>]*></script>`), "")
        .replace("</body>", () => `${script}\n</body>`);
    } else if (name.endsWith(".css")) {
      page.source = page.source.replace(new RegExp(`<link[^>]*${file}[^>]*>`), () => `<style>${part.source}</style>`);
    } else continue;
    delete bundle[name];
  }
}

/** `dist`: the built package; `out`: where the page goes. */
export async function buildDemo({ dist = join(root, "dist"), out = join(dist, "demo") } = {}) {
  await buildShapes();
  const result = await build({
    configFile: false,
    root: here,
    logLevel: "warn",
    plugins: [packagePlugin(dist), shapesPlugin, slimThree, inlinePlugin],
    build: {
      write: false, target: "es2022", assetsInlineLimit: 1e8, cssCodeSplit: false, modulePreload: false,
      chunkSizeWarningLimit: 2000, rolldownOptions: { output: { codeSplitting: false } },
    },
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
