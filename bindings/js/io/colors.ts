// Colours of vertices: sRGB bytes here, linear light in glTF.

/** A linear colour times another, as sRGB bytes at `at`. */
export function srgbColor(color: ArrayLike<number>, factor: ArrayLike<number>, out: Uint8Array, at: number): void {
  for (let k = 0; k < 3; ++k) {
    const light = Math.min(1, Math.max(0, color[k] * factor[k]));
    out[at + k] = Math.round(255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055));
  }
}

/**
 * The colours of these vertices as glTF has them, four numbers each; 16 bits, so that dark ones come back as they were.
 */
export function linearColors(colors: Uint8Array, vertices: readonly number[]): Uint16Array {
  const linear = Uint16Array.from({ length: 256 }, (_, byte) => {
    const x = byte / 255;
    return Math.round(65535 * (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
  });
  const out = new Uint16Array(4 * vertices.length).fill(65535);
  vertices.forEach((v, i) => {
    for (let k = 0; k < 3; ++k) out[4 * i + k] = linear[colors[3 * v + k]];
  });
  return out;
}
