// A progress bar on stderr, where that is a terminal.

const width = 24;
const interval = 50;

export class Progress {
  readonly #shown: boolean;
  #last = -Infinity;
  #drawn = false;

  constructor(quiet: boolean) {
    this.#shown = !quiet && process.stderr.isTTY === true;
  }

  /** `done` of `total`, and what is being done. */
  show(done: number, total: number, text: string): void {
    const now = performance.now();
    if (!this.#shown || now - this.#last < interval) return;
    this.#last = now;
    const full = Math.round(width * Math.min(1, done / total));
    process.stderr.write(`\r[${"#".repeat(full)}${".".repeat(width - full)}] ${text}\x1b[K`);
    this.#drawn = true;
  }

  /** Leaves the line as if nothing had been there. */
  clear(): void {
    if (this.#drawn) process.stderr.write("\r\x1b[K");
    this.#drawn = false;
  }
}
