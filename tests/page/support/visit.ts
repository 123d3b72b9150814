// A visit to the page for every test: the browser of a test file, and the page that is open in it.
import type { Browser } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect } from "vitest";
import { demoFile, dist, launch, openDemo, serve, type Demo, type DemoOptions } from "./browser.ts";

/** From a server, or from a disk. */
export const ways = ["served", "from a file"] as const;

export let browser: Browser;
let server: Awaited<ReturnType<typeof serve>>;
/** The page of the test that runs. */
export let demo: Demo;

/** A browser while the tests of a file run. */
export function useBrowser(): void {
  beforeAll(async () => {
    browser = await launch();
  });
  afterAll(() => browser?.close());
}

/** The same, for tests that `visit` the page: none may leave an error behind. */
export function useVisits(): void {
  useBrowser();
  beforeAll(async () => {
    server = await serve(`${dist}/demo`);
  });
  afterAll(() => server?.close());
  afterEach(async () => {
    expect(demo.errors).toEqual([]);
    await demo.page.context().close();
  });
}

export const addressOf = (way: (typeof ways)[number]): string => (way === "served" ? server.address : demoFile);

export async function visit(way: (typeof ways)[number], options?: DemoOptions): Promise<Demo> {
  demo = await openDemo(browser, addressOf(way), options);
  return demo;
}

export const ask = <T>(question: (hook: Window["pliantDemo"]) => T): Promise<T> =>
  demo.page.evaluate(`(${question.toString()})(window.pliantDemo)`) as Promise<T>;

export const rest = (): Promise<number[]> => ask((hook) => hook.rest());
export const diagonal = async (): Promise<number> => (await ask((hook) => hook.shape())).diagonal;
