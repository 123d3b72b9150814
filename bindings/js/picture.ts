// pliant/picture: what pictures need beside a shape: drawing them without a GPU, and what lies in front where they
// overlap.
// Plain functions over plain data; nothing of the library is loaded.

export { PliantError, type ErrorCode } from "./boundary/errors.js";
export type { Color, Image, PictureInput } from "./picture/image.js";
export { backToFront, type Pin, spreadDepths } from "./picture/order.js";
export { type Drawing, frameOf, rasterize } from "./picture/raster.js";
