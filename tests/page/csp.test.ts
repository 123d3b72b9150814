// The package on a page with a strict content-security policy: scripts of its own and WASM, nothing else.
import { expect, test } from "vitest";
import { dist, errorsOf, serve } from "./support/browser.ts";
import { library } from "./support/replay.ts";
import { browser, useBrowser } from "./support/visit.ts";

/** Lifts one end of a strip; the height a corner reaches. */
const lift = `async (pliant) => {
const shape = pliant.shape({
  positions: Float32Array.of(0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 3, 1, 0),
  triangles: Uint32Array.of(0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6),
});
const deformer = pliant.deformer(shape, { method: "embedded-graph", nodeCount: 8 });
deformer.setFixed([0, 4]);
deformer.addHandle([3, 7]).move({ translate: [0, 0, 1] });
await deformer.solve();
return deformer.positions()[3 * 7 + 2];
}`;

const pages = {
  "/page.html": '<!doctype html><title>Strict</title><script type="module" src="./page.js"></script>',
  "/page.js": `import { init } from "./pliant.js"; window.lifted = await (${lift})(await init());`,
};

useBrowser();

test("pliant.js and pliant.wasm run under script-src 'self' 'wasm-unsafe-eval'", async () => {
  const policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'";
  const server = await serve(dist, { "Content-Security-Policy": policy }, pages);
  const page = await browser.newPage();
  const errors = errorsOf(page);
  await page.goto(`${server.address}page.html`);
  await page.waitForFunction(() => "lifted" in window);
  const pliant = await library();
  const expected = await (eval(lift) as (p: typeof pliant) => Promise<number>)(pliant);
  expect(expected).toBeGreaterThan(0.5);
  expect(await page.evaluate(() => (window as unknown as { lifted: number }).lifted)).toBe(expected);
  expect(errors.filter((text) => !text.includes("favicon"))).toEqual([]);
  await page.close();
  await server.close();
});
