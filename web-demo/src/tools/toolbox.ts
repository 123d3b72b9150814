// The table of tools, in the order of the toolbar and of the number keys.
import { AddHandle } from "./add_handle.ts";
import { Grain } from "./grain.ts";
import { Paint } from "./paint.ts";
import { pose } from "./pose.ts";
import type { SketchTool } from "./sketch.ts";
import type { Stage, Tool } from "./tool.ts";

export const makeTools = (stage: Stage, sketch: SketchTool): Tool[] =>
  [sketch, pose(), new AddHandle(stage), new Paint(stage, true), new Paint(stage, false), new Grain(stage)];
