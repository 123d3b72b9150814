// A real Chromium on the built page, and what tests do with it. Tests wait for states, never for time.
import { createServer, type Server } from "node:http";
import { mkdirSync, readFileSync, statSync } from "node:fs";
import { extname, join, normalize } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium, type Browser, type BrowserContextOptions, type Page } from "playwright-core";
import type { PliantDemo } from "../../../web-demo/src/hook.ts";

export const root = fileURLToPath(new URL("../../..", import.meta.url));
export const dist = process.env["PLIANT_DIST"] ?? join(root, "dist");
const artifacts = join(root, "artifacts");

declare global {
  interface Window {
    pliantDemo: PliantDemo;
  }
}

const flags = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

export const launch = (): Promise<Browser> => chromium.launch({ executablePath: "/usr/bin/chromium", args: flags });

const types: Record<string, string> = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };

/** Serves a folder on a free local port; `pages` are served from memory. */
export async function serve(folder: string, headers: Record<string, string> = {}, pages: Record<string, string> = {}) {
  const server: Server = createServer((request, response) => {
    const path = new URL(request.url!, "http://localhost").pathname;
    const file = normalize(join(folder, path.endsWith("/") ? `${path}index.html` : path));
    const content =
      pages[path] ?? (statSync(file, { throwIfNoEntry: false })?.isFile() ? readFileSync(file) : undefined);
    response.writeHead(content === undefined ? 404 : 200, {
      "Content-Type": types[extname(file)] ?? "text/plain", ...headers,
    });
    response.end(content);
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address() as { port: number };
  return { address: `http://127.0.0.1:${port}/`, close: () => new Promise((resolve) => server.close(resolve)) };
}

/** Console errors and uncaught exceptions of a page, as they come. */
export function errorsOf(page: Page): string[] {
  const errors: string[] = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(error.message));
  return errors;
}

/** Pixels on the page. */
export interface Place {
  x: number;
  y: number;
}

export interface Demo {
  page: Page;
  /** Console errors and uncaught exceptions so far. */
  errors: string[];
  /** What was asked of the network. */
  requests: string[];
  idle(): Promise<void>;
  handle(index?: number): Promise<ReturnType<PliantDemo["handles"]>[number]>;
  positions(): Promise<number[]>;
  /** Chooses a shape of the page and waits for it. */
  choose(id: string): Promise<void>;
  /** Presses at the first place, moves through the others, releases. */
  drag(...path: Place[]): Promise<void>;
  /** Presses keys, one at once after another, and waits for what they do. */
  press(...keys: string[]): Promise<void>;
  /** Clicks something and waits for what it does. */
  click(selector: string): Promise<void>;
  /** Keeps a picture in artifacts/. */
  shot(name: string): Promise<void>;
}

export const demoFile = pathToFileURL(join(dist, "demo/index.html")).href;

/** `tool`: the one to start with instead of the page's own. */
export type DemoOptions = BrowserContextOptions & { tool?: string };

export async function openDemo(
  browser: Browser, address: string, { tool, ...options }: DemoOptions = {},
): Promise<Demo> {
  const context = await browser.newContext({
    viewport: { width: 1000, height: 640 }, acceptDownloads: true, ...options,
  });
  const page = await context.newPage();
  const errors = errorsOf(page);
  const requests: string[] = [];
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(address);
  await page.waitForFunction(() => window.pliantDemo !== undefined);
  const idle = () => page.evaluate(() => window.pliantDemo.idle());
  await idle();
  if (tool) await page.locator(`#tool-${tool}`).click();
  return {
    page, errors, requests, idle,
    handle: async (index = 0) => (await page.evaluate(() => window.pliantDemo.handles())).at(index)!,
    positions: () => page.evaluate(() => window.pliantDemo.positions()),
    choose: async (id) => {
      await page.locator(`label:has(input[value="${id}"])`).click();
      await page.waitForFunction((wanted) => window.pliantDemo.shape().id === wanted, id);
      await idle();
    },
    drag: async (first, ...path) => {
      await page.mouse.move(first.x, first.y);
      await page.mouse.down();
      for (const { x, y } of path) await page.mouse.move(x, y, { steps: 4 });
      await page.mouse.up();
      await idle();
    },
    press: async (...keys) => {
      for (const key of keys) await page.keyboard.press(key);
      await idle();
    },
    click: async (selector) => {
      await page.locator(selector).click();
      await idle();
    },
    shot: async (name) => {
      mkdirSync(artifacts, { recursive: true });
      await page.screenshot({ path: join(artifacts, `${name}.png`) });
    },
  };
}

/** The largest distance between points of two lists, over some vertices or all. */
export function farthest(a: ArrayLike<number>, b: ArrayLike<number>, vertices?: Iterable<number>): number {
  let worst = 0;
  for (const v of vertices ?? Array(a.length / 3).keys()) {
    worst = Math.max(
      worst, Math.hypot(a[3 * v]! - b[3 * v]!, a[3 * v + 1]! - b[3 * v + 1]!, a[3 * v + 2]! - b[3 * v + 2]!),
    );
  }
  return worst;
}

export function centroid(positions: ArrayLike<number>, vertices: number[]): number[] {
  return [0, 1, 2].map((k) => vertices.reduce((sum, v) => sum + positions[3 * v + k]!, 0) / vertices.length);
}
