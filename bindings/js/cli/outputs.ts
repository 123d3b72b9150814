// Output files: written beside their place under another name, moved there when everything is done.

import { open, type FileHandle, rename, rm } from "node:fs/promises";
import { basename, dirname, join } from "node:path";
import { onFile } from "./failure.js";

export class Outputs {
  readonly #temporary = new Map<string, string>();

  /** Opens the file that will be `path` once all outputs are kept. */
  async open(path: string): Promise<FileHandle> {
    const temporary = join(dirname(path), `.${basename(path)}.${process.pid}.tmp`);
    return onFile(path, async () => {
      const file = await open(temporary, "w");
      this.#temporary.set(path, temporary);
      return file;
    });
  }

  async write(path: string, content: string | Uint8Array): Promise<void> {
    const file = await this.open(path);
    await onFile(path, async () => {
      try {
        await file.writeFile(content);
      } finally {
        await file.close();
      }
    });
  }

  /** Moves every file to its place. */
  async keep(): Promise<void> {
    for (const [path, temporary] of this.#temporary) {
      await onFile(path, () => rename(temporary, path));
      this.#temporary.delete(path);
    }
  }

  /** Removes what has not been kept. */
  async discard(): Promise<void> {
    for (const temporary of this.#temporary.values()) await rm(temporary, { force: true });
    this.#temporary.clear();
  }
}
