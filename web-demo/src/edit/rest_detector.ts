// Tells a shape that comes to rest from one that goes to and fro.

/** Frames that are looked back on. */
const memory = 10;
/** A change below this share of the largest one since the start is none. */
const quiet = 1e-4;

export class RestDetector {
  private last: Float32Array | undefined;
  private turns: boolean[] = [];
  private largest = 0;
  private settled = false;

  reset(): void {
    this.last = undefined;
    this.turns = [];
    this.largest = 0;
    this.settled = false;
  }

  saw(before: Float32Array, after: Float32Array, settled: boolean): void {
    this.settled = settled;
    if (before.length !== after.length) return this.reset();
    const change = new Float32Array(after.length);
    let [along, size] = [0, 0];
    for (let i = 0; i < change.length; i++) {
      change[i] = after[i]! - before[i]!;
      size += change[i]! ** 2;
      along += change[i]! * (this.last?.[i] ?? 0);
    }
    this.largest = Math.max(this.largest, size);
    this.turns.push(along < 0 && size > quiet ** 2 * this.largest);
    if (this.turns.length > memory) this.turns.shift();
    this.last = change;
  }

  verdict(): "settled" | "moving" | "swinging" {
    if (this.settled) return "settled";
    return this.turns.filter(Boolean).length > memory / 2 ? "swinging" : "moving";
  }
}
