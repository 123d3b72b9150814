// What a way of using the pointer is: the toolbar, the input and the keys know nothing else.
import type { Present } from "../edit/present.ts";
import type { Session } from "../edit/session.ts";
import type { IconName } from "../ui/icons.ts";
import type { Hit } from "../view/picking.ts";
import type { ShapeView } from "../view/shape_view.ts";
import type { Viewport } from "../view/viewport.ts";

/** What tools work on. */
export interface Stage {
  readonly session: Session;
  /** The session's: what there is to work on. */
  readonly present: Present;
  readonly viewport: Viewport;
  readonly view: ShapeView;
  /** The first hit under a place on the page. */
  pick(x: number, y: number): Hit | undefined;
  /** The tool's size in the shape's unit of length. */
  radius(): number;
  /** Colours of a stroke that is not done yet; undefined: the document's. */
  preview(fixed?: ReadonlySet<number>): void;
  /** The line that is being drawn, or none. */
  ink(points: readonly Pointer[] | undefined): void;
  /** A circle of the tool's size at a place on the page, or none. */
  showBrush(at?: { x: number; y: number; hit: Hit | undefined }): void;
}

/** A place on the page, in pixels. */
export interface Pointer {
  x: number;
  y: number;
}

export interface Tool {
  readonly id: string;
  readonly label: string;
  readonly icon: IconName;
  /** One sentence for the hint line. */
  readonly hint: string;
  /** Share of the diagonal at the ends of the size slider, and where it starts (0 to 1); absent: no size. */
  readonly size?: { min: number; max: number; start: number };
  /** True: the tool has the pointer until it is up. False: the camera has it. */
  down(at: Pointer): boolean;
  /**
   * `samples`: every place since the last call, where the device tells more than the page asks for; the last is `at`.
   */
  move?(at: Pointer, samples: readonly Pointer[]): void;
  up?(): void;
  /** The gesture was none: a palm, or the first of two fingers. */
  cancel?(): void;
  /** Whether the tool can be used on what is there; absent: always. */
  available?(): boolean;
  /** The pointer moves with no button down; undefined: it left. */
  hover?(at: Pointer | undefined): void;
  /** Enter was pressed, with the cross in the middle of the view at `at`. */
  act?(at: Pointer): void;
}
