// Pose: handles are buttons of their own (ui/handle_overlay.ts), everything else is the camera's.
import type { Tool } from "./tool.ts";

export const pose = (): Tool => ({
  id: "pose",
  label: "Pose",
  icon: "pose",
  hint: "Drag an orange handle. Drag beside it to look around.",
  down: () => false,
});
