// Undo and redo over immutable values.

interface Entry<T> {
  value: T;
  /** Entries with the same label in a row are one: a held arrow key is one step back. */
  label: string;
}

export class History<T> {
  private readonly entries: Entry<T>[];
  private at = 0;

  constructor(first: T, private readonly limit = 100) {
    this.entries = [{ value: first, label: "" }];
  }

  get current(): T {
    return this.entries[this.at]!.value;
  }
  get canUndo(): boolean {
    return this.at > 0;
  }
  get canRedo(): boolean {
    return this.at + 1 < this.entries.length;
  }

  /** A new value; what was undone is gone. `label` joins it to the last entry of the same label. */
  push(value: T, label = ""): void {
    this.entries.length = this.at + 1;
    if (label !== "" && this.entries[this.at]!.label === label) {
      this.entries[this.at]!.value = value;
      return;
    }
    this.entries.push({ value, label });
    if (this.entries.length > this.limit) this.entries.shift();
    this.at = this.entries.length - 1;
  }

  undo(): T {
    if (this.canUndo) this.at--;
    return this.current;
  }
  redo(): T {
    if (this.canRedo) this.at++;
    return this.current;
  }
}
