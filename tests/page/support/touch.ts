// Fingers on the page.
import type { Page } from "playwright-core";
import type { Place } from "./browser.ts";

type Touch = (
  type: "touchStart" | "touchMove" | "touchEnd",
  ...fingers: (Place & { radiusX?: number; radiusY?: number })[]
) => Promise<unknown>;

/** Says where all fingers are that are down, as a touch screen does. */
export async function touchScreen(page: Page): Promise<Touch> {
  const client = await page.context().newCDPSession(page);
  return (type, ...fingers) =>
    client.send("Input.dispatchTouchEvent", {
      type, touchPoints: fingers.map((finger, id) => ({ id, radiusX: 6, radiusY: 6, ...finger })),
    });
}
