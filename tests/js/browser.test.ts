// The installed package in a real Chromium: bundled by Vite, on strict pages, opened from a file.

import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Browser } from "playwright-core";
import { createLogger, build as viteBuild } from "vite";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { launch, serve } from "../page/support/browser.js";
import { consumer, installed, pliant } from "./support/package.js";
import { sheet, where } from "./support/shapes.js";

const mesh = sheet(15);
const left = where(mesh.positions, (x) => x < 0.15);
const right = where(mesh.positions, (x) => x > 0.9);

const given = { positions: Array.from(mesh.positions), triangles: Array.from(mesh.triangles) };

/** An application: lifts a side of a sheet, by the calls that `library` and a worker share. */
const lift = `async (library) => {
  const { positions, triangles } = ${JSON.stringify(given)};
  const shape = await library.shape({ positions: Float64Array.from(positions), triangles });
  const deformer = await library.deformer(shape, { method: "embedded-graph", nodeCount: 30 });
  await deformer.setFixed(${JSON.stringify(left)});
  const hand = await deformer.addHandle(${JSON.stringify(right)});
  await hand.move({ translate: [0, 0, 0.3] });
  await deformer.solve();
  return Array.from(await deformer.positions());
}`;
/** A program that lifts it by a library that comes by a promise. */
const lifted = (library: string) =>
  `const lift = ${lift}; window.results = ${library}.then(lift).then((found) => [found]);`;
const bundled = `
import { init } from "pliant";
import { init as initWorker } from "pliant/worker";
const lift = ${lift};
window.results = Promise.all([init().then(lift), initWorker().then(lift)]);
`;
const expected: number[] = await new Function(`return ${lift}`)()(pliant);

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser?.close());

/** What `window.results` of a page resolves to, and every error on the way. */
async function results(address: string): Promise<{ found: number[][]; errors: string[] }> {
  const page = await browser.newPage();
  const errors: string[] = [];
  page.on("console", (message) => {
    if (message.type() === "error" && !message.location().url.endsWith("favicon.ico")) errors.push(message.text());
  });
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(address);
  const found = await page.evaluate(() => (window as unknown as { results: Promise<number[][]> }).results);
  await page.close();
  return { found, errors };
}

const application = (name: string, files: Record<string, string>) => {
  const folder = join(consumer, name);
  mkdirSync(folder, { recursive: true });
  for (const [file, content] of Object.entries(files)) writeFileSync(join(folder, file), content);
  return folder;
};

describe("bundled by Vite", () => {
  const page = '<!doctype html><title>Application</title><script type="module" src="./main.js"></script>';
  const folder = application("bundled", { "index.html": page, "main.js": bundled });
  const warnings: string[] = [];

  beforeAll(async () => {
    const customLogger = createLogger("warn");
    customLogger.warn = customLogger.warnOnce = (message) => warnings.push(message);
    await viteBuild({ configFile: false, root: folder, customLogger, build: { assetsInlineLimit: 0 } });
  });

  it("takes its WASM and its worker along, without a warning", () => {
    const assets = readdirSync(join(folder, "dist/assets"));
    expect(assets.filter((file) => file.endsWith(".wasm")).length).toBeGreaterThan(0);
    expect(assets.filter((file) => file.includes("worker-host")).length).toBeGreaterThan(0);
    expect(warnings).toEqual([]);
  });

  it("runs under a strict content-security policy, in the page and in a worker", async () => {
    const policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'";
    const server = await serve(join(folder, "dist"), { "Content-Security-Policy": policy });
    expect(await results(server.address)).toEqual({ found: [expected, expected], errors: [] });
    await server.close();
  });
});

describe("as it is", () => {
  it("runs from a server, without a bundler", async () => {
    const main = bundled.replaceAll('"pliant"', '"./pliant.js"').replaceAll('"pliant/worker"', '"./worker.js"');
    const pages = {
      "/": '<!doctype html><title>Plain</title><script type="module" src="./main.js"></script>', "/main.js": main,
    };
    const server = await serve(join(installed, "dist"), {}, { ...pages, "/index.html": pages["/"] });
    expect(await results(`${server.address}index.html`)).toEqual({ found: [expected, expected], errors: [] });
    await server.close();
  });

  it("has all inside in pliant/inline: nothing is fetched, not even from a data: URL", async () => {
    const policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'";
    const main = `import { init } from "./inline.js"; ${lifted("init()")}`;
    const page = '<!doctype html><title>Strict</title><script type="module" src="./main.js"></script>';
    const server = await serve(
      join(installed, "dist"), { "Content-Security-Policy": policy }, { "/index.html": page, "/main.js": main },
    );
    expect(await results(`${server.address}index.html`)).toEqual({ found: [expected], errors: [] });
    await server.close();
  });
});

describe("kept from loading", () => {
  const main = `
    import { init } from "./pliant.js";
    import { init as initWorker } from "./worker.js";
    const told = (promise) => promise.then(() => "started", ({ code, message }) => [code, message]);
    window.results = Promise.all([told(init(/* options */)), told(initWorker(/* options */))]);`;
  const page = '<!doctype html><title>Kept</title><script type="module" src="./main.js"></script>';
  const found = async (policy: string, options = "") => {
    const pages = { "/index.html": page, "/main.js": main.replaceAll("/* options */", options) };
    const server = await serve(join(installed, "dist"), { "Content-Security-Policy": policy }, pages);
    const outcome = await results(`${server.address}index.html`);
    await server.close();
    return outcome.found as unknown;
  };
  const failed = (part: string) => ["load-failed", expect.stringContaining(part)];

  it("by the network", async () => {
    const policy = "script-src 'self' 'wasm-unsafe-eval'";
    expect(await found(policy, '{ wasmUrl: "gone.wasm" }')).toEqual([
      failed("gone.wasm answers 404"), failed("gone.wasm answers 404"),
    ]);
  });

  it("by a policy against WASM", async () => {
    expect(await found("script-src 'self'")).toEqual([
      failed("Content Security Policy"), failed("Content Security Policy"),
    ]);
  });

  it("by a policy against workers", async () => {
    const [page, worker] = (await found("script-src 'self' 'wasm-unsafe-eval'; worker-src 'none'")) as unknown[];
    expect([page, worker]).toEqual(["started", failed("the worker cannot be started")]);
  });
});

describe("opened from a file", () => {
  const open = (name: string, page: string) => {
    const folder = application("files", { [`${name}.html`]: `<!doctype html><title>${name}</title>${page}` });
    return pathToFileURL(join(folder, `${name}.html`)).href;
  };
  const safe = (script: string) => script.replaceAll("</script", "<\\/script");

  it("runs as a classic script beside the page", async () => {
    application("files", { "pliant.global.js": readFileSync(join(installed, "dist/pliant.global.js"), "utf8") });
    const [library, program] = ['<script src="pliant.global.js"></script>', lifted("pliant.init()")];
    const address = open("classic", `${library}<script>${program}</script>`);
    expect(await results(address)).toEqual({ found: [expected], errors: [] });
  });

  it("runs as a module inside the page", async () => {
    const inline = readFileSync(join(installed, "dist/inline.js"), "utf8");
    const name = /([\w$]+) as init\b/.exec(inline)![1];
    const address = open("module", `<script type="module">${safe(inline)}\n${lifted(`${name}()`)}</script>`);
    expect(await results(address)).toEqual({ found: [expected], errors: [] });
  });

  it("runs in a worker made from inside the script", async () => {
    const source = `import { init } from "pliant/worker"; ${lifted("init()")}`;
    const folder = application("from-file", { "main.js": source });
    const built = await viteBuild({
      configFile: false, root: folder, logLevel: "silent",
      build: { write: false, rolldownOptions: { input: join(folder, "main.js"), output: { codeSplitting: false } } },
    });
    const [chunk] = (built as { output: { code: string }[] }).output;
    expect(await results(open("worker", `<script type="module">${safe(chunk.code)}</script>`))).toEqual({
      found: [expected], errors: [],
    });
  });
});
