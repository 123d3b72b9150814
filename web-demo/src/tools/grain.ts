// Grain: strokes on the surface along which the material is stiff.
import { isPainting, type Strokes } from "../methods.ts";
import type { Pointer, Stage, Tool } from "./tool.ts";

export class Grain implements Tool {
  readonly id = "grain";
  readonly label = "Grain";
  readonly icon = "grain" as const;
  readonly hint = "Stroke the surface along its grain: there it resists most.";
  private vertices: number[] | undefined;
  private ink: Pointer[] = [];

  constructor(private readonly stage: Stage) {}

  available(): boolean {
    const { method, options } = this.stage.present.doc;
    return isPainting(method, options);
  }

  down(at: Pointer): boolean {
    this.vertices = this.available() && this.stage.pick(at.x, at.y) ? [] : undefined;
    if (!this.vertices) return false;
    this.ink = [];
    this.dab(at);
    return true;
  }

  move(_: Pointer, samples: readonly Pointer[]): void {
    for (const sample of samples) this.dab(sample);
    this.stage.ink(this.ink);
  }

  up(): void {
    const { vertices } = this;
    const { session, present: { doc } } = this.stage;
    this.cancel();
    if (!vertices || vertices.length < 2) return;
    const rest = doc.shape.positions;
    const stroke = vertices.map((v) => [rest[3 * v]!, rest[3 * v + 1]!, rest[3 * v + 2]!] as const);
    void session.setOption("strokes", [...(doc.options["strokes"] as Strokes), stroke]);
  }

  cancel(): void {
    this.vertices = undefined;
    this.stage.ink(undefined);
  }

  private dab(at: Pointer): void {
    const hit = this.stage.pick(at.x, at.y);
    if (!hit) return;
    this.ink.push(at);
    if (this.vertices!.at(-1) !== hit.vertex) this.vertices!.push(hit.vertex);
  }
}
