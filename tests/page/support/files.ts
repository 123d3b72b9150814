// Files on their way into the page and out of it.
import { readFileSync } from "node:fs";
import { demo } from "./visit.ts";

/** What the page gives to be saved. */
export async function exported(kind: "obj" | "glb" | "script"): Promise<{ name: string; bytes: Buffer }> {
  const [download] = await Promise.all([
    demo.page.waitForEvent("download"), demo.page.locator(`#export-${kind}`).click(),
  ]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** Drops a file on the page. */
export async function drop(name: string, content: string): Promise<void> {
  const transfer = await demo.page.evaluateHandle(([file, text]) => {
    const data = new DataTransfer();
    data.items.add(new File([text!], file!));
    return data;
  }, [name, content]);
  await demo.page.dispatchEvent("body", "dragover", { dataTransfer: transfer });
  await demo.page.dispatchEvent("body", "drop", { dataTransfer: transfer });
}

/** Waits until a file is there. */
export const shows = (file: string) =>
  demo.page.waitForFunction((name) => window.pliantDemo.shape().name === name, file);

/** Opens a file by the page's button and waits for it. */
export async function openFile(name: string, content: string | Uint8Array): Promise<void> {
  const buffer = Buffer.from(content as string);
  await demo.page.locator("#file").setInputFiles({ name, mimeType: "application/octet-stream", buffer });
  await shows(name);
  await demo.idle();
}
