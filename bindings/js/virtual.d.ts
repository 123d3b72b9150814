// Modules that build.mjs makes.

declare module "#wasm/pliant.mjs" {
  const createModule: import("./boundary/wasm.js").ModuleFactory<import("./boundary/raw.js").RawModule>;
  export default createModule;
}

declare module "#wasm/pliant-io.mjs" {
  const createModule: import("./boundary/wasm.js").ModuleFactory<import("./boundary/raw.js").RawIoModule>;
  export default createModule;
}

/** pliant.wasm, gzipped, in base64. */
declare module "#wasm/inline" {
  const text: string;
  export default text;
}

/** pliant-io.wasm, likewise. */
declare module "#wasm/io-inline" {
  const text: string;
  export default text;
}

/** The worker's script, with the WASM inside. */
declare module "#worker-script" {
  const script: string;
  export default script;
}

declare module "#version" {
  const version: string;
  export default version;
}

/** The decoder of Draco for glTF, and its WASM, gzipped, in base64. */
declare module "#draco" {
  export const wasm: string;
  const createDecoder: (options: { wasmBinary: ArrayBuffer }) => Promise<object>;
  export default createDecoder;
}
