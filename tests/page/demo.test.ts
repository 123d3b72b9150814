// The page as a visitor meets it: served and from a disk, with mouse, keys and fingers.
import { describe, expect, test } from "vitest";
import { centroid, farthest, type DemoOptions } from "./support/browser.ts";
import { touchScreen } from "./support/touch.ts";
import { addressOf, ask, demo, useVisits, visit, ways } from "./support/visit.ts";

useVisits();

const open = (options?: DemoOptions) => visit("served", { tool: "pose", ...options });

describe.each(ways)("%s", (how) => {
  test("greets with a creature and a line to draw along; posing with a handle that asks to be dragged", async () => {
    await visit(how);
    const shape = await ask((hook) => hook.shape());
    expect(shape.id).toBe("creature");
    expect(shape.vertices).toBeGreaterThan(10_000);
    expect((await ask((hook) => hook.fixed())).length).toBeGreaterThan(100);
    expect(await ask((hook) => hook.handles().length)).toBe(1);
    expect(await demo.page.locator("#tool-sketch").getAttribute("aria-checked")).toBe("true");
    expect(await demo.page.locator("#coach").innerText()).toBe("Draw along here");
    expect(await demo.page.locator(".handle").count()).toBe(0);
    await demo.shot(`page-${how.replaceAll(" ", "-")}`);
    await demo.page.locator("#tool-pose").click();
    expect(await demo.page.locator("#drag-me").isVisible()).toBe(true);
    expect(demo.page.workers()).toHaveLength(1);
    expect(demo.requests.filter((url) => !url.startsWith("blob:"))).toEqual([addressOf(how)]);
  });

  test("bends when the handle is dragged; the fixed region stays", async () => {
    await visit(how, { tool: "pose" });
    const handle = await demo.handle();
    await demo.drag(handle, { x: handle.x + 60, y: handle.y - 110 });
    const [rest, now, fixed, shape] = [
      await ask((h) => h.rest()), await demo.positions(), await ask((h) => h.fixed()), await ask((h) => h.shape()),
    ];
    const moved = await demo.handle();
    expect(Math.hypot(moved.x - handle.x - 60, moved.y - handle.y + 110)).toBeLessThan(1);
    expect(farthest(rest, now, fixed)).toBeLessThan(1e-6 * shape.diagonal);
    // The vertices of the handle arrive where its mark is on the screen.
    const shift = centroid(now, handle.vertices).map((x, k) => x - centroid(rest, handle.vertices)[k]!);
    expect(Math.hypot(...shift)).toBeGreaterThan(0.1 * shape.diagonal);
    expect(farthest(now, rest.map((x, i) => x + shift[i % 3]!), handle.vertices)).toBeLessThan(0.01 * shape.diagonal);
    expect(await demo.page.locator("#drag-me").isVisible()).toBe(false);
    expect(await demo.page.locator("#readout-energy").innerText()).not.toBe("0");
    await demo.shot(`bent-${how.replaceAll(" ", "-")}`);
  });
});

test("undo goes back, redo goes forth, reset goes to rest", async () => {
  const { page } = await open();
  const { diagonal } = await ask((hook) => hook.shape());
  const rest = await demo.positions();
  const handle = await demo.handle();
  await demo.drag(handle, { x: handle.x - 50, y: handle.y - 60 });
  const first = await demo.positions();
  await demo.drag(await demo.handle(), { x: handle.x + 40, y: handle.y - 120 });
  const second = await demo.positions();
  expect(farthest(first, second)).toBeGreaterThan(0.05 * diagonal);

  await demo.press("Control+z");
  expect(farthest(await demo.positions(), first)).toBeLessThan(1e-4 * diagonal);
  await demo.click("#undo");
  expect(farthest(await demo.positions(), rest)).toBeLessThan(1e-5 * diagonal);
  expect(await page.locator("#undo").isDisabled()).toBe(true);
  await page.locator("#redo").click();
  await demo.press("Control+y");
  expect(farthest(await demo.positions(), second)).toBeLessThan(1e-4 * diagonal);
  await demo.click("#reset");
  expect(farthest(await demo.positions(), rest)).toBeLessThan(1e-6 * diagonal);
  await demo.click("#undo");
  expect(farthest(await demo.positions(), second)).toBeLessThan(1e-4 * diagonal);
});

test("undo also takes back the choice of a shape and of an option", async () => {
  const { page } = await open();
  await demo.choose("plane");
  await page.locator("#option-nodeCount").focus();
  await demo.press("ArrowLeft");
  expect(await page.locator("#option-nodeCount").inputValue()).toBe("240");
  await demo.click("#undo");
  expect(await page.locator("#option-nodeCount").inputValue()).toBe("250");
  await demo.click("#undo");
  expect(await ask((hook) => hook.shape().id)).toBe("creature");
  expect(await page.locator('input[value="creature"]').isChecked()).toBe(true);
});

test("options changed while the last ones are still being built all count", async () => {
  const { page } = await open();
  await demo.choose("plane");
  await page.locator("#option-nodeCount").focus();
  for (let i = 0; i < 4; i++) await page.keyboard.press("ArrowLeft");
  await page.locator("#option-neighbours").focus();
  await demo.press("ArrowRight", "ArrowRight");
  expect(await page.locator("#option-nodeCount").inputValue()).toBe("210");
  expect(await page.locator("#option-neighbours").inputValue()).toBe("6");
  expect(await ask((hook) => hook.script())).toMatchObject({ steps: [{ options: { nodeCount: 210, neighbours: 6 } }] });
});

test("the brush fixes and frees what it passes over", async () => {
  const { page } = await open();
  const before = await ask((hook) => hook.fixed());
  const { x, y } = await ask((hook) => {
    const rest = hook.rest();
    let belly = 0; // the vertex that is farthest in front, in the middle of the trunk
    for (let v = 0; v < rest.length / 3; v++) {
      if (Math.abs(rest[3 * v + 1]! - 0.8) < 0.2 && rest[3 * v + 2]! > rest[3 * belly + 2]!) belly = v;
    }
    return hook.vertexAt(belly);
  });
  const under = await page.evaluate(([px, py]) => window.pliantDemo.pick(px!, py!), [x, y]);
  await page.locator("#tool-fix").click();
  await demo.drag({ x, y }, { x: x + 15, y: y + 20 }, { x, y: y + 25 });
  const painted = await ask((hook) => hook.fixed());
  expect(painted.length).toBeGreaterThan(before.length);
  expect(painted).toContain(under);
  expect(before.every((v) => painted.includes(v))).toBe(true);
  await page.locator("#tool-free").click();
  await demo.drag({ x, y }, { x: x + 15, y: y + 20 }, { x, y: y + 25 });
  expect(await ask((hook) => hook.fixed())).not.toContain(under);
  await page.locator("#undo").click();
  await demo.click("#undo");
  expect(await ask((hook) => hook.fixed())).toEqual(before);
});

test("a press on the surface places a handle, and the same gesture moves it", async () => {
  const { page } = await open();
  const rest = await ask((hook) => hook.rest());
  const tip = await ask((hook) => {
    const p = hook.rest();
    let top = 0; // the tip of an ear
    for (let v = 0; v < p.length / 3; v++) if (p[3 * v + 1]! > p[3 * top + 1]!) top = v;
    return hook.vertexAt(top);
  });
  await page.keyboard.press("3");
  await demo.drag({ x: tip.x, y: tip.y + 6 }, { x: tip.x + 50, y: tip.y + 40 });
  const ear = await demo.handle(1);
  expect(ear.vertices.length).toBeGreaterThan(1);
  const { diagonal } = await ask((hook) => hook.shape());
  expect(farthest(rest, await demo.positions(), ear.vertices)).toBeGreaterThan(0.05 * diagonal);
  expect(await ask((hook) => hook.selected())).toBe(ear.id);
});

test("the ring turns a handle in the picture", async () => {
  await open();
  const handle = await demo.handle();
  const at = (degrees: number) => ({
    x: handle.x + 46 * Math.cos((degrees * Math.PI) / 180), y: handle.y + 46 * Math.sin((degrees * Math.PI) / 180),
  });
  await demo.drag(at(-120), at(-90), at(-60), at(-30));
  const script = (await ask((hook) => hook.script())) as {
    steps: { drag: { handles: { move: { rotate: { degrees: number } } }[] }[] }[];
  };
  const { degrees } = script.steps[0]!.drag.at(-1)!.handles[0]!.move.rotate;
  expect(degrees).toBeCloseTo(90, 0);
});

test("everything can be done with keys", async () => {
  const { page } = await open();
  const { diagonal } = await ask((hook) => hook.shape());
  const rest = await demo.positions();
  await page.locator("#view").focus();
  await page.keyboard.press("Tab");
  expect(await page.evaluate(() => document.activeElement?.getAttribute("aria-label"))).toBe("Handle paw");
  expect(await page.evaluate(() => document.activeElement!.matches(":focus-visible"))).toBe(true);
  const before = await demo.handle();
  for (let i = 0; i < 5; i++) await page.keyboard.press("Shift+ArrowUp");
  await demo.press("]");
  const after = await demo.handle();
  expect(before.y - after.y).toBeGreaterThan(100);
  expect(farthest(rest, await demo.positions(), after.vertices)).toBeGreaterThan(0.05 * diagonal);

  // A run of nudges is one step of the history.
  await demo.press("Control+z");
  expect(farthest(rest, await demo.positions())).toBeLessThan(1e-5 * diagonal);
  await demo.press("Delete");
  expect(await ask((hook) => hook.handles().length)).toBe(0);
  expect(await page.evaluate(() => document.activeElement?.id)).toBe("view");

  await page.keyboard.press("3");
  await page.keyboard.press("ArrowRight");
  expect(await page.locator("#cross").isVisible()).toBe(true);
  await demo.press("Enter");
  expect(await ask((hook) => hook.handles().length)).toBe(1);
  await page.keyboard.press("4");
  const fixed = await ask((hook) => hook.fixed().length);
  for (let i = 0; i < 6; i++) await page.keyboard.press("ArrowRight");
  await demo.press("Enter");
  expect(await ask((hook) => hook.fixed().length)).toBeGreaterThan(fixed);
});

test("a finger drags a handle", async () => {
  const { page, idle } = await open({ hasTouch: true });
  const { diagonal } = await ask((hook) => hook.shape());
  const rest = await demo.positions();
  const { x, y, vertices } = await demo.handle();
  const touch = await touchScreen(page);
  await touch("touchStart", { x, y });
  for (let i = 1; i <= 5; i++) await touch("touchMove", { x: x - 8 * i, y: y - 20 * i });
  await touch("touchEnd");
  await idle();
  expect(farthest(rest, await demo.positions(), vertices)).toBeGreaterThan(0.05 * diagonal);
  const moved = await demo.handle();
  expect(Math.hypot(moved.x - x + 40, moved.y - y + 100)).toBeLessThan(1);
});

test.each(["bunny", "plane", "tree", "gingerbread"])("the shape %s bends too", async (id) => {
  await open();
  await demo.choose(id);
  const [rest, fixed, { diagonal }] = [
    await ask((h) => h.rest()), await ask((h) => h.fixed()), await ask((h) => h.shape()),
  ];
  const handle = await demo.handle();
  await demo.drag(handle, { x: handle.x - 40, y: handle.y - 70 });
  const now = await demo.positions();
  expect(now.every(Number.isFinite)).toBe(true);
  expect(farthest(rest, now, handle.vertices)).toBeGreaterThan(0.03 * diagonal);
  expect(farthest(rest, now, fixed)).toBeLessThan(1e-6 * diagonal);
  if (id === "gingerbread") expect(now.every((x, i) => i % 3 !== 2 || x === 0)).toBe(true);
  await demo.shot(`bent-${id}`);
});

test("the graph can be watched", async () => {
  const { page, idle } = await open();
  const handle = await demo.handle();
  await page.locator("#graph").check();
  await demo.drag(handle, { x: handle.x + 40, y: handle.y - 90 });
  await idle();
  await demo.shot("graph");
  await page.locator("#graph").uncheck();
  await page.locator("#wire").check();
  await demo.shot("wireframe");
});

test("on a small screen everything fits, and the settings open and close", async () => {
  const { page } = await open({ viewport: { width: 360, height: 640 }, colorScheme: "dark" });
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(360);
  expect(await page.locator("#panel-body").isVisible()).toBe(false);
  await page.locator("#panel-toggle").click();
  expect(await page.locator("#panel-body").isVisible()).toBe(true);
  expect(await page.locator("#panel-toggle").getAttribute("aria-expanded")).toBe("true");
  await demo.shot("phone");
});

test("every control has a name", async () => {
  const { page } = await open();
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll<HTMLElement>("button, input, select, canvas")]
      .filter((e) => !e.getAttribute("aria-label") && !e.textContent?.trim() && !(e as HTMLInputElement).labels?.length)
      .map((e) => e.outerHTML));
  expect(nameless).toEqual([]);
});
