// Strokes on the page: with a mouse, a pen and fingers; what they do is undone, exported and replayed.
import { describe, expect, test } from "vitest";
import { farthest, type Place } from "./support/browser.ts";
import { replayed } from "./support/replay.ts";
import { touchScreen } from "./support/touch.ts";
import { ask, demo, diagonal, rest, useVisits, visit, ways } from "./support/visit.ts";

useVisits();

type Point = [number, number, number];

/** Along the creature's right arm, up beside its head, and down to its feet. */
const arm: Point[] = [[-0.34, 1.04, 0.14], [-0.56, 0.98, 0.16], [-0.82, 1.05, 0.22], [-1.06, 1.14, 0.24]];
const up: Point[] = [[-0.34, 1.04, 0.14], [-0.62, 1, 0.16], [-0.85, 1.12, 0.2], [-0.98, 1.42, 0.24]];
const down: Point[] = [[-0.34, 1.04, 0.14], [-0.56, 0.94, 0.16], [-0.68, 0.76, 0.2], [-0.72, 0.5, 0.24]];

const onPage = (points: Point[]): Promise<Place[]> =>
  demo.page.evaluate((list) => list.map((p) => window.pliantDemo.project(p)), points);

async function stroke(points: Point[]): Promise<void> {
  const [first, ...rest] = await onPage(points);
  await demo.drag(first!, ...rest);
}
const limb = async () => (await ask((hook) => hook.limb()))!;
/** Vertices by what the stroke made of them. */
const labelled = (labels: number[], wanted: (label: number) => boolean) =>
  [...labels.keys()].filter((v) => wanted(labels[v]!));

describe.each(ways)("%s", (how) => {
  test("a stroke along an arm chooses it, a second bends it there", async () => {
    await visit(how);
    const before = await rest();
    await stroke(arm);
    const { labels, s } = await limb();
    expect(farthest(before, await demo.positions())).toBe(0);
    const arms = labelled(labels, (label) => label > 0);
    expect(arms.length).toBeGreaterThan(200);
    expect(arms.every((v) => before[3 * v]! < -0.2)).toBe(true); // none beyond the shoulder
    expect(Math.max(...s)).toBeCloseTo(1, 1);
    expect(await demo.page.locator("#coach").innerText()).toBe("Now draw where it should go");
    await demo.shot(`limb-${how.replaceAll(" ", "-")}`);

    await stroke(up);
    const now = await demo.positions();
    expect(farthest(before, now, arms)).toBeGreaterThan(0.05 * (await diagonal()));
    expect(farthest(before, now, labelled(labels, (label) => label === 0))).toBeLessThan(1e-6 * (await diagonal()));
    const { curve } = await limb();
    const goal = (await onPage(up)).at(-1)!;
    // The limb keeps its length, so that it may end a little before or behind the stroke.
    expect(Math.hypot(curve.at(-1)!.x - goal.x, curve.at(-1)!.y - goal.y)).toBeLessThan(40);
    expect(await demo.page.locator("#coach").isVisible()).toBe(false);
    await demo.shot(`sketched-${how.replaceAll(" ", "-")}`);
  });
});

test("a stroke from the hand to the shoulder holds the body; the flip holds the hand", async () => {
  await visit("served");
  const before = await rest();
  await stroke(arm);
  const { labels } = await limb();
  await demo.press("Control+z");
  await stroke(arm.toReversed());
  const inwards = await limb();
  const alike = labels.filter((label, v) => (label > 0) === (inwards.labels[v]! > 0)).length / labels.length;
  expect(alike).toBeGreaterThan(0.99);
  await stroke(up);
  const bent = await demo.positions();
  const still = labelled(inwards.labels, (label) => label === 0);
  expect(farthest(before, bent, still)).toBeLessThan(1e-6 * (await diagonal()));
  expect(farthest(before, bent)).toBeGreaterThan(0.05 * (await diagonal()));
  expect(farthest((await replayed()).positions, bent)).toBeLessThan(1e-6 * (await diagonal()));

  await demo.page.locator("#limb-flip").click();
  await demo.idle();
  const flipped = await demo.positions();
  expect(farthest(before, flipped, still)).toBeGreaterThan(0.05 * (await diagonal()));
  // The eyes, which no edge joins to the rest, are static by label and ride on the body.
  const hand = labelled((await limb()).labels, (label) => label === 0).filter((v) => before[3 * v]! < -0.7);
  expect(hand.length).toBeGreaterThan(10);
  expect(farthest(before, flipped, hand)).toBeLessThan(1e-6 * (await diagonal()));
  expect(farthest((await replayed()).positions, flipped)).toBeLessThan(1e-6 * (await diagonal()));
  await demo.page.locator("#limb-flip").click();
  await demo.idle();
  expect(farthest(bent, await demo.positions())).toBeLessThan(0.02 * (await diagonal()));
});

test("a hand dragged off the shape pulls the arm it belongs to; off no limb there is a message", async () => {
  await visit("served");
  const before = await rest();
  const [hand] = await onPage([arm.at(-1)!]);
  await demo.drag(hand!, { x: hand!.x - 20, y: hand!.y - 60 }, { x: hand!.x - 30, y: hand!.y - 160 });
  const { labels, curve } = await limb();
  const arms = labelled(labels, (label) => label > 0);
  expect(arms.length).toBeGreaterThan(200);
  expect(arms.every((v) => before[3 * v]! < -0.1)).toBe(true);
  const now = await demo.positions();
  expect(farthest(before, now, arms)).toBeGreaterThan(0.05 * (await diagonal()));
  expect(curve.at(-1)!.y).toBeLessThan(hand!.y - 40);
  expect(farthest((await replayed()).positions, now)).toBeLessThan(1e-6 * (await diagonal()));
  await demo.shot("pulled");
  await demo.press("Control+z"); // one stroke, one step back
  expect(await ask((hook) => hook.limb())).toBeUndefined();
});

test("a stroke begun while the limb is still being chosen, or posed, is on it", async () => {
  await visit("served");
  const { mouse } = demo.page;
  for (const points of [arm, up, down]) {
    const [first, ...more] = await onPage(points);
    await mouse.move(first!.x, first!.y);
    await mouse.down();
    for (const { x, y } of more) await mouse.move(x, y, { steps: 4 });
    await mouse.up();
  }
  await demo.idle();
  const { steps } = (await ask((hook) => hook.script())) as { steps: Record<string, unknown>[] };
  expect(steps).toHaveLength(1);
  expect(steps[0]).toHaveProperty("bend");
  const { curve } = await limb();
  const [goal] = await onPage([down.at(-1)!]);
  expect(Math.hypot(curve.at(-1)!.x - goal!.x, curve.at(-1)!.y - goal!.y)).toBeLessThan(60);
});

test("the preview follows the hand before it lets go, and ends where the stroke ends", async () => {
  await visit("served");
  await stroke(arm);
  const before = await rest();
  const [first, ...more] = await onPage(up);
  await demo.page.mouse.move(first!.x, first!.y);
  await demo.page.mouse.down();
  for (const { x, y } of more) await demo.page.mouse.move(x, y, { steps: 6 });
  await demo.idle();
  const preview = await demo.positions();
  expect(farthest(before, preview)).toBeGreaterThan(0.05 * (await diagonal()));
  await demo.page.mouse.up();
  await demo.idle();
  expect(farthest(preview, await demo.positions())).toBeLessThan(1e-2 * (await diagonal()));
});

test("further strokes pose the same limb; undo and redo walk through all of them", async () => {
  await visit("served");
  const poses = [await demo.positions()];
  await stroke(arm);
  const { labels } = await limb();
  for (const target of [up, down]) {
    await stroke(target);
    poses.push(await demo.positions());
  }
  expect((await limb()).labels).toEqual(labels);
  expect(farthest(poses[1]!, poses[2]!)).toBeGreaterThan(0.1 * (await diagonal()));
  const tolerance = 1e-6 * (await diagonal());
  await demo.press("Control+z");
  expect(farthest(await demo.positions(), poses[1]!)).toBeLessThan(tolerance);
  await demo.press("Control+z");
  expect(farthest(await demo.positions(), poses[0]!)).toBe(0);
  expect(await limb()).toBeDefined();
  await demo.press("Control+z");
  expect(await ask((hook) => hook.limb())).toBeUndefined();
  await demo.press("Control+y", "Control+y", "Control+y");
  expect(farthest(await demo.positions(), poses[2]!)).toBeLessThan(tolerance);
});

test("a stroke twists, another thickens; the script replays to the same shape", async () => {
  await visit("served");
  await stroke(arm);
  await stroke(up);
  const bent = await demo.positions();
  const { curve, labels } = await limb();
  const middle = curve[Math.floor(0.6 * curve.length)]!;
  await demo.page.locator("#stroke-twist").click();
  const [dx, dy] = [curve.at(-1)!.x - curve[0]!.x, curve.at(-1)!.y - curve[0]!.y];
  const across = 110 / Math.hypot(dx, dy);
  await demo.drag(middle, { x: middle.x - across * dy, y: middle.y + across * dx });
  const twisted = await demo.positions();
  expect(farthest(bent, twisted)).toBeGreaterThan(0.02 * (await diagonal()));
  expect(farthest(bent, twisted, labelled(labels, (label) => label === 0))).toBeLessThan(1e-6 * (await diagonal()));
  await demo.page.keyboard.press("s");
  await demo.drag(middle, { x: middle.x, y: middle.y - 60 });
  expect(farthest(twisted, await demo.positions())).toBeGreaterThan(0.01 * (await diagonal()));
  const { steps } = (await ask((hook) => hook.script())) as { steps: Record<string, unknown>[] };
  expect(steps).toHaveLength(1);
  expect(Object.keys(steps[0]!)).toEqual(expect.arrayContaining(["camera", "reference", "bend", "twist", "scale"]));
  expect(farthest((await replayed()).positions, await demo.positions())).toBeLessThan(1e-6 * (await diagonal()));
});

test("limb after limb, then a handle: one script holds it all", async () => {
  await visit("served");
  await stroke(arm);
  await stroke(up);
  const [left, leftDown] = [arm, down].map((points) => points.map(([x, y, z]): Point => [-x, y, z]));
  await stroke(left!);
  expect((await limb()).curve[0]!.x).toBeGreaterThan((await onPage([[0, 1, 0]]))[0]!.x);
  await stroke(leftDown!);
  await demo.click("#tool-pose");
  const paw = await demo.handle();
  await demo.drag(paw, { x: paw.x - 30, y: paw.y - 30 });
  const { steps } = (await ask((hook) => hook.script())) as { steps: { method: string }[] };
  expect(steps.map((step) => step.method)).toEqual(["sketch", "sketch", "embedded-graph"]);
  expect(farthest((await replayed()).positions, await demo.positions())).toBeLessThan(1e-6 * (await diagonal()));
  await demo.shot("two-limbs");
});

test("after the camera has turned, the next stroke is meant as it is seen from there", async () => {
  await visit("served");
  await stroke(arm);
  await stroke(up);
  await demo.page.locator("#view").focus();
  await demo.page.keyboard.press("ArrowRight");
  const { curve, labels } = await limb();
  const [start, end] = [curve[0]!, curve.at(-1)!];
  await demo.drag(start, { x: start.x - 60, y: start.y + 10 }, { x: start.x - 90, y: start.y + 70 });
  const again = await limb();
  const share = again.labels.filter((label, v) => (label > 0) === (labels[v]! > 0)).length / labels.length;
  expect(share).toBeGreaterThan(0.99);
  expect(again.curve.at(-1)!.y).toBeGreaterThan(end.y + 60);
  expect(farthest((await replayed()).positions, await demo.positions())).toBeLessThan(1e-6 * (await diagonal()));
  await demo.press("Control+z"); // one stroke, one step back
  expect(Math.abs((await limb()).curve.at(-1)!.y - end.y)).toBeLessThan(2);
});

test("morph, smoothing, refinement, mirror and the curves", async () => {
  await visit("served");
  await stroke(arm);
  await stroke(up);
  const size = await diagonal();
  const [before, whole] = [await rest(), await demo.positions()];
  const tip = farthest(before, whole);
  await demo.page.locator("#morph").focus();
  await demo.press("Home");
  expect(farthest(before, await demo.positions())).toBeLessThan(1e-6 * size);
  await demo.press("End");
  expect(farthest(whole, await demo.positions())).toBeLessThan(1e-6 * size);

  await demo.page.locator("#mirror").check();
  await demo.idle();
  const both = await demo.positions();
  const other = [...before.keys()]
    .filter((i) => i % 3 === 0 && before[i]! > 0.4 && before[i + 1]! > 0.7)
    .map((i) => i / 3);
  expect(farthest(before, both, other)).toBeGreaterThan(0.8 * tip);

  await demo.page.locator("#curves summary").click();
  await demo.page.locator('.knot[aria-label="Thickness at 4 of 4"]').focus();
  await demo.press(...Array<string>(12).fill("ArrowUp"));
  expect(farthest(both, await demo.positions())).toBeGreaterThan(0.01 * size);
  const {
    steps: [{ scale }],
  } = (await ask((hook) => hook.script())) as { steps: [{ scale: { profile: [number, number][] } }] };
  expect(scale.profile.at(-1)![1]).toBeCloseTo(1.6, 6); // every press counts, also while the one before is carried out
  await demo.page.locator("#keep-length").uncheck();
  await stroke([[-0.34, 1.04, 0.14], [-0.8, 1, 0.16], [-1.3, 1.3, 0.2], [-1.4, 1.9, 0.24]]);
  const { vertices } = await ask((hook) => hook.shape());
  await demo.page.locator("#refine").check();
  await demo.idle();
  expect((await ask((hook) => hook.shape())).vertices).toBeGreaterThan(vertices);
  expect(farthest((await replayed()).positions, await demo.positions())).toBeLessThan(1e-6 * size);
  await demo.shot("refined");
  await demo.click("#undo");
  expect((await ask((hook) => hook.shape())).vertices).toBe(vertices);
  await demo.click("#undo");
  expect(await ask((hook) => hook.limb())).toBeDefined();
});

test("a line across the limb makes what lies beyond it rigid; a solver finishes the pose", async () => {
  await visit("served");
  await stroke(arm);
  const before = (await limb()).labels;
  const [wrist] = await onPage([[-0.74, 1.03, 0.2]]);
  await demo.page.keyboard.press("c");
  await demo.drag({ x: wrist!.x - 12, y: wrist!.y - 60 }, { x: wrist!.x + 12, y: wrist!.y + 60 });
  const { labels } = await limb();
  const rigid = labelled(labels, (label) => label >= 2);
  expect(rigid.length).toBeGreaterThan(2 * labelled(before, (label) => label >= 2).length);
  await demo.page.keyboard.press("b");
  await stroke(up);
  const sketched = await demo.positions();
  await demo.page.locator("#finish").selectOption("arap");
  await demo.idle();
  const finished = await demo.positions();
  expect(farthest(sketched, finished, rigid)).toBeLessThan(1e-5 * (await diagonal())); // the handle
  expect(farthest(sketched, finished)).toBeGreaterThan(1e-4 * (await diagonal()));
  expect(farthest((await replayed()).positions, finished)).toBeLessThan(1e-6 * (await diagonal()));
  await demo.press("Control+z");
  expect(farthest(sketched, await demo.positions())).toBeLessThan(1e-6 * (await diagonal()));
});

test("a pen draws with all its samples; the palm beside it does nothing", async () => {
  await visit("served", { hasTouch: true });
  const client = await demo.page.context().newCDPSession(demo.page);
  const touch = await touchScreen(demo.page);
  const places = await onPage(arm);
  const pen = (type: "mousePressed" | "mouseMoved" | "mouseReleased", { x, y }: Place) =>
    client.send("Input.dispatchMouseEvent", {
      type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, pointerType: "pen", clickCount: 1,
    });
  await pen("mousePressed", places[0]!);
  await pen("mouseMoved", places[1]!);
  const palm = { x: places[0]!.x + 160, y: places[0]!.y + 40, radiusX: 40, radiusY: 50 };
  await touch("touchStart", palm);
  await touch("touchMove", { ...palm, y: palm.y + 60 });
  await touch("touchEnd");
  for (const place of places.slice(2)) await pen("mouseMoved", place);
  await pen("mouseReleased", places.at(-1)!);
  await demo.idle();
  const { curve } = await limb();
  expect(Math.hypot(curve.at(-1)!.x - places.at(-1)!.x, curve.at(-1)!.y - places.at(-1)!.y)).toBeLessThan(12);
});

test("one finger draws, two turn the view", async () => {
  await visit("served", { hasTouch: true });
  const touch = await touchScreen(demo.page);
  const places = await onPage(arm);
  await touch("touchStart", places[0]!);
  for (const [i, to] of places.slice(1).entries()) {
    const from = places[i]!;
    for (const t of [0.25, 0.5, 0.75, 1]) {
      await touch("touchMove", { x: from.x + t * (to.x - from.x), y: from.y + t * (to.y - from.y) });
    }
  }
  await touch("touchEnd");
  await demo.idle();
  expect(labelled((await limb()).labels, (label) => label > 0).length).toBeGreaterThan(200);

  const nose: Point[] = [[0, 1.6, 0.4]];
  const [before] = await onPage(nose);
  const a = { x: before!.x, y: before!.y + 80 };
  const shifted = (d: number) => [{ x: a.x + d, y: a.y }, { x: a.x + 60 + d, y: a.y }];
  await touch("touchStart", a);
  await touch("touchStart", ...shifted(0));
  for (let i = 1; i <= 6; i++) await touch("touchMove", ...shifted(8 * i));
  await touch("touchEnd");
  await demo.idle();
  const [after] = await onPage(nose);
  expect(Math.hypot(after!.x - before!.x, after!.y - before!.y)).toBeGreaterThan(5);
  expect(farthest(await rest(), await demo.positions())).toBe(0);
});

test("a stroke beside the shape turns the camera; what cannot be sketched on opens with handles", async () => {
  await visit("served");
  const [before] = await onPage([[0, 1.6, 0.4]]);
  await demo.drag({ x: 120, y: 400 }, { x: 200, y: 420 });
  const [after] = await onPage([[0, 1.6, 0.4]]);
  expect(Math.abs(after!.x - before!.x)).toBeGreaterThan(3);
  expect(await ask((hook) => hook.limb())).toBeUndefined();
  await demo.choose("tree");
  expect(await demo.page.locator("#tool-sketch").isVisible()).toBe(false);
  expect(await demo.page.locator("#tool-pose").getAttribute("aria-checked")).toBe("true");
});
