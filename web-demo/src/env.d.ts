declare module "#shapes" {
  import type { PackedMesh } from "./shapes/decode.ts";
  export const shapes: { creature: PackedMesh; bunny: PackedMesh };
}
