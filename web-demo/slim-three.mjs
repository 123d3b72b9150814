// Leaves out of three.js what the page never uses but its renderer always carries: shader text behind
// features that no material here turns on, the generator of environment maps, virtual reality: 16 kB of
// the page, gzipped. What is not found under its name any more stops the build.

/** Shader chunks that are only included behind a #define that the page's materials never set. */
const chunks = [
  "alphahash_fragment", "alphahash_pars_fragment", "batching_pars_vertex", "batching_vertex", "bumpmap_pars_fragment",
  "clearcoat_normal_fragment_begin", "clearcoat_normal_fragment_maps", "clearcoat_pars_fragment",
  "clipping_planes_fragment", "clipping_planes_pars_fragment", "clipping_planes_pars_vertex", "clipping_planes_vertex",
  "displacementmap_pars_vertex", "displacementmap_vertex", "envmap_common_pars_fragment", "envmap_fragment",
  "envmap_pars_fragment", "envmap_pars_vertex", "envmap_physical_pars_fragment", "envmap_vertex",
  "gradientmap_pars_fragment", "iridescence_fragment", "iridescence_pars_fragment", "lightmap_pars_fragment",
  "lights_lambert_fragment", "lights_lambert_pars_fragment", "lights_physical_fragment",
  "lights_physical_pars_fragment", "lights_toon_fragment", "lights_toon_pars_fragment", "morphcolor_vertex",
  "morphinstance_vertex", "morphnormal_vertex", "morphtarget_pars_vertex", "morphtarget_vertex",
  "normalmap_pars_fragment", "skinbase_vertex", "skinning_pars_vertex", "skinning_vertex", "skinnormal_vertex",
  "transmission_fragment", "transmission_pars_fragment",
];

/**
 * Classes the renderer names, and what is left of them: one that it never makes, one that it only asks whether it is
 * on.
 */
const classes = {
  PMREMGenerator: "class PMREMGenerator {}",
  WebXRManager: `class WebXRManager {
    enabled = false; isPresenting = false; cameraAutoUpdate = false;
    addEventListener() {} removeEventListener() {} setAnimationLoop() {} dispose() {}
    getEnvironmentBlendMode() { return "opaque"; } hasDepthSensing() { return false; }
  }`,
};

function withoutChunk(code, name) {
  const text = new RegExp(`^((?:const|var) ${name} = )"(?:[^"\\\\]|\\\\.)*"`, "m");
  if (!text.test(code)) throw new Error(`three.module.js: expected a shader chunk ${name}`);
  return code.replace(text, '$1""');
}

function withoutClass(code, [name, rest]) {
  const start = code.search(new RegExp(`^class ${name}\\b`, "m"));
  const end = code.indexOf("\n}", start);
  if (start < 0 || end < 0) throw new Error(`three.module.js: expected a class ${name}`);
  return code.slice(0, start) + rest + code.slice(end + 2);
}

export const slimThree = {
  name: "pliant-slim-three",
  enforce: "pre",
  transform(code, id) {
    if (!id.endsWith("/three/build/three.module.js")) return undefined;
    return Object.entries(classes).reduce(withoutClass, chunks.reduce(withoutChunk, code));
  },
};
