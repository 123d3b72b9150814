// Pictures as puppets: dropped, pinned, dragged, turned, layered, exported.
import { readFileSync } from "node:fs";
import { NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import { beforeEach, describe, expect, test } from "vitest";
import {
  dotted, inScout, middleOf, painted, pixelAt, png, readPng, scout, visibleArea,
} from "../js/support/pictures.ts";
import { centroid, farthest } from "./support/browser.ts";
import { ask, demo, rest, useVisits, visit, ways } from "./support/visit.ts";

useVisits();

const size = 512;
const green = [0, 255, 0, 255];
const at = (x: number, y: number) => inScout([x, y], size);
const [hand, hip, head] = [at(0.77, 0.2), at(0, -0.1), at(0, 0.55)];
const hero = dotted(scout(size), hand[0], hand[1], 6, green);

const open = async (name: string, mimeType: string, buffer: Buffer) => {
  await demo.page.locator("#file").setInputFiles({ name, mimeType, buffer });
  await demo.page.waitForFunction((wanted) => window.pliantDemo.shape().name === wanted, name);
  await demo.idle();
};
const onPage = ([x, y]: readonly [number, number]) =>
  demo.page.evaluate((point) => window.pliantDemo.project(point), [x, y, 0] as [number, number, number]);
const handles = () => ask((hook) => hook.handles());

async function exported(kind: string): Promise<{ name: string; bytes: Buffer }> {
  const button = demo.page.locator(`#export-${kind}`);
  const [download] = await Promise.all([demo.page.waitForEvent("download"), button.click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}
const picture = async () => readPng((await exported("png")).bytes);

/** Clicks a pin into each of these places of the picture. */
async function pin(...places: (readonly [number, number])[]): Promise<void> {
  for (const place of places) {
    const { x, y } = await onPage(place);
    await demo.page.mouse.click(x, y);
    await demo.idle();
  }
}

/** Drags the first pin so that it goes from one place of the picture to another. */
async function pull(from: readonly [number, number], to: readonly [number, number]): Promise<void> {
  const [start, end, handle] = [await onPage(from), await onPage(to), await demo.handle(0)];
  await demo.drag(handle, { x: handle.x + end.x - start.x, y: handle.y + end.y - start.y });
}

describe.each(ways)("%s", (how) => {
  beforeEach(async () => {
    await visit(how);
    await open("hero.png", "image/png", Buffer.from(png(hero)));
  });

  test("a picture is bent by pins, and what was painted at one is where it went", async () => {
    expect(await demo.page.locator("#tool-handle").getAttribute("aria-checked")).toBe("true");
    expect([await handles(), await ask((hook) => hook.fixed())]).toEqual([[], []]);
    await pin(hand, hip, head);
    expect((await handles()).map(({ vertices }) => vertices.length >= 4)).toEqual([true, true, true]);
    expect(farthest(await rest(), await demo.positions())).toBeLessThan(1e-3);
    const same = await picture();
    expect(same).toMatchObject({ width: size, height: size });
    expect(Math.abs(visibleArea(same) / visibleArea(hero) - 1)).toBeLessThan(0.001);

    const target = [hand[0] - 60, hand[1] + 110] as const;
    await pull(hand, target);
    const bent = await picture();
    const [x, y] = middleOf(bent, green);
    expect(Math.hypot(x - target[0], y - target[1])).toBeLessThan(2); // a pixel of the page is 1.3 of the picture
    expect(pixelAt(bent, ...hand)[3]).toBe(0);
    expect(pixelAt(bent, 3, 3)).toEqual([0, 0, 0, 0]);
    expect(Math.abs(visibleArea(bent) / visibleArea(hero) - 1)).toBeLessThan(0.05);
    expect((await demo.positions()).every((value, i) => i % 3 !== 2 || value === 0)).toBe(true);
    await demo.shot(`puppet-${how.replaceAll(" ", "-")}`);
    await demo.press("Control+z");
    expect(farthest(await rest(), await demo.positions())).toBeLessThan(1e-3);
  });

  test("a pin is turned by its ring", async () => {
    await pin(hand, hip, head);
    const [{ vertices }] = await handles();
    const before = await demo.positions();
    await demo.page.locator("#overlay .handle").first().focus();
    const ring = (await demo.page.locator(".ring .grip").boundingBox())!;
    const grip = { x: ring.x + ring.width / 2, y: ring.y + ring.height / 2 };
    const { x, y } = await demo.handle(0);
    const [dx, dy] = [grip.x - x, grip.y - y];
    await demo.drag(grip, { x: x + dy, y: y - dx }); // a quarter turn, to the left
    const now = await demo.positions();
    const [a, b] = [centroid(before, vertices), centroid(now, vertices)];
    expect(Math.hypot(a[0]! - b[0]!, a[1]! - b[1]!)).toBeLessThan(1);
    for (const v of vertices) {
      const [px, py] = [before[3 * v]! - a[0]!, before[3 * v + 1]! - a[1]!];
      const [qx, qy] = [now[3 * v]! - b[0]!, now[3 * v + 1]! - b[1]!];
      expect(Math.hypot(qx + py, qy - px)).toBeLessThan(0.1 * Math.hypot(px, py) + 0.5);
    }
  });

  test("a pin comes to the front and goes to the back, and back again by undo", async () => {
    await pin(hand, hip, head);
    const target = at(-0.02, 0.06);
    await pull(hand, target);
    const seen = async () => Number.isFinite(middleOf(await picture(), green)[0]);
    expect(await seen()).toBe(true); // limbs lie over the body
    await demo.click("#to-back");
    expect(await seen()).toBe(false);
    const hit = await demo.page.evaluate(({ x, y }) => window.pliantDemo.pick(x, y), await onPage(target));
    expect((await handles())[0]!.vertices).not.toContain(hit); // the body is what is seen, and touched
    expect(JSON.parse((await exported("script")).bytes.toString()).steps[0].handles[0].depth).toBe(-1);
    await demo.click("#to-front");
    expect(await seen()).toBe(true);
    await demo.press("Control+z");
    expect(await seen()).toBe(false);
    await demo.page.locator("#overlay .handle").first().focus();
    await demo.press("PageUp");
    expect(await seen()).toBe(true);
  });
});

describe("files", () => {
  test("what leaves the frame is not cut off; .svg and .glb hold the picture", async () => {
    await visit("from a file");
    await open("hero.png", "image/png", Buffer.from(png(hero)));
    await pin(hand);
    await pull(hand, [hand[0] - 150, hand[1] + 90]);
    const { name, bytes } = await exported("png");
    expect(name).toBe("hero-bent.png");
    const moved = readPng(bytes);
    expect(moved.width).toBeGreaterThan(size);
    expect(moved.height).toBeGreaterThan(size);
    expect(Math.abs(visibleArea(moved) / visibleArea(hero) - 1)).toBeLessThan(0.01);
    const svg = (await exported("svg")).bytes.toString();
    expect(svg.match(/<clipPath /g)!.length).toBe((await ask((hook) => hook.shape())).triangles);
    const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);
    const glb = (await io.readBinary(new Uint8Array((await exported("glb")).bytes))).getRoot();
    expect(glb.listTextures()[0]!.getSize()).toEqual([size, size]);
    expect(glb.listMaterials()[0]!.getAlphaMode()).toBe("BLEND");
  });

  test("a .jpg loses the paper around its figure, and keeps what is as white within", async () => {
    await visit("from a file");
    const bytes = await demo.page.evaluate(async () => {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [200, 160];
      const context = canvas.getContext("2d")!;
      const dot = (x: number, y: number, r: number, color: string) => {
        context.fillStyle = color;
        context.beginPath();
        context.arc(x, y, r, 0, 7);
        context.fill();
      };
      context.fillStyle = "#fff";
      context.fillRect(0, 0, 200, 160);
      dot(100, 80, 50, "#2050c0");
      dot(85, 70, 9, "#fff");
      const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/jpeg", 0.9));
      return [...new Uint8Array(await blob!.arrayBuffer())];
    });
    await open("ball.jpg", "image/jpeg", Buffer.from(bytes));
    const before = await rest();
    const xs = before.filter((_, i) => i % 3 === 0);
    expect(Math.min(...xs)).toBeGreaterThan(45);
    expect(Math.max(...xs)).toBeLessThan(155);
    const out = await picture();
    expect(pixelAt(out, 10, 10)[3]).toBe(0);
    expect(pixelAt(out, 85, 90)[3]).toBe(255);
    expect(Math.min(...pixelAt(out, 85, 90))).toBeGreaterThan(235);
    expect(visibleArea(out) / (Math.PI * 50 ** 2)).toBeCloseTo(1, 1);
  });

  test("a picture without anything in it says so", async () => {
    await visit("from a file");
    const clear = Buffer.from(png(painted(40, 40, () => [0, 0, 0, 0])));
    await demo.page.locator("#file").setInputFiles({ name: "clear.png", mimeType: "image/png", buffer: clear });
    await demo.page.locator("#notice").waitFor({ state: "visible" });
    const notice = await demo.page.locator("#notice span").innerText();
    expect(notice).toMatch(/^clear\.png could not be read: data shows nothing/);
  });
});

test("the page's own puppet has its pins, and its hand is raised", async () => {
  await visit("from a file");
  await demo.choose("puppet");
  const names = (await handles()).map(({ name }) => name);
  expect(names).toEqual(["right hand", "left hand", "head", "hips", "right foot", "left foot"]);
  const handle = await demo.handle(0);
  await demo.drag(handle, { x: handle.x - 60, y: handle.y - 90 });
  const [before, now] = [await rest(), await demo.positions()];
  expect(farthest(before, now, handle.vertices)).toBeGreaterThan(100);
  expect(farthest(before, now, (await demo.handle(4)).vertices)).toBeLessThan(1e-3);
  await demo.shot("puppet-raised");
});
