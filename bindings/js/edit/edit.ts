// `pliant.edit`, loaded when it is first called.

import type { Core } from "../boundary/core.js";
import { extentOf, type Shape } from "../shape/shape.js";
import { readScript } from "./read.js";
import { runScript } from "./frames.js";
import type { EditOptions, EditResult, EditScript } from "./types.js";

export function edit(core: Core, shape: Shape, script: EditScript, options: EditOptions): Promise<EditResult> {
  const plan = readScript(script, extentOf(shape));
  return runScript(core, shape, plan, options);
}
