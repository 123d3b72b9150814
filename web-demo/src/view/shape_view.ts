// The deformed shape on the screen: surface, dots or picture, tinted where it is fixed or held.
import {
  BufferAttribute, BufferGeometry, CanvasTexture, DoubleSide, FrontSide, Group, Material, Mesh, MeshBasicMaterial,
  MeshPhongMaterial, NoColorSpace, Points, PointsMaterial, Sphere, SRGBColorSpace, Texture, Vector3,
} from "three";
import type { Doc } from "../edit/document.ts";
import { boundingBox, vertexCount, type ShapeData } from "../shapes/shape.ts";
import type { SketchView } from "../solver/pliant.ts";

type Color = readonly [number, number, number];

/** sRGB bytes. */
const clay: Color = [222, 206, 186];
/** Linear colour and opacity, as bytes: blue where fixed, orange where held. */
const fixedTint = [11, 22, 114, 190];
const heldTint = [255, 72, 7, 150];

/** The renderer works in linear light. */
const linear = Float32Array.from({ length: 256 }, (_, c) => {
  const x = c / 255;
  return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
});

/** Around any shape. */
const everywhere = new Sphere(new Vector3(), Infinity);

export class ShapeView {
  readonly group = new Group();
  private geometry = new BufferGeometry();
  /** What the colours show. */
  private painted: unknown[] = [];
  /** What the index holds. */
  private layered: Uint32Array | undefined;
  object: Mesh | Points | undefined;

  /** Takes a shape on; its geometry from before is freed. `solid`: only its outside is ever seen. */
  show(shape: ShapeData, solid: boolean): void {
    this.clear();
    this.painted = [];
    this.geometry = new BufferGeometry();
    const count = vertexCount(shape);
    this.geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * count), 3));
    this.geometry.setAttribute("normal", new BufferAttribute(new Float32Array(3 * count), 3));
    this.geometry.setAttribute("tint", new BufferAttribute(new Uint8Array(4 * count), 4, true));
    if (shape.picture) this.geometry.setAttribute("uv", new BufferAttribute(shape.picture.uv, 2));
    else this.geometry.setAttribute("color", new BufferAttribute(baseColors(shape), 3));
    this.object = shape.triangles.length > 0 ? this.surface(shape, solid) : this.dots(shape);
    this.object.frustumCulled = false;
    this.group.add(this.object);
  }

  private surface(shape: ShapeData, solid: boolean): Mesh {
    this.layered = shape.triangles;
    this.geometry.setIndex(new BufferAttribute(shape.triangles.slice(), 1));
    const side = solid ? FrontSide : DoubleSide;
    if (shape.picture && shape.dimension === 2) return new Mesh(this.geometry, flat(shape.picture.image));
    const vertexColors = !shape.picture;
    const material = tinted(new MeshPhongMaterial({ vertexColors, specular: 0x1c1c1c, shininess: 24, side }));
    if (shape.picture) {
      material.map = pictureTexture(shape.picture.image);
      material.specular.set(0);
      material.alphaTest = 0.4;
    }
    const mesh = new Mesh(this.geometry, material);
    mesh.castShadow = mesh.receiveShadow = true;
    return mesh;
  }

  private dots(shape: ShapeData): Points {
    const size = (shape.dotSize ?? 0.006) * boundingBox(shape.positions).diagonal;
    const material = tinted(
      new PointsMaterial({ vertexColors: true, size, sizeAttenuation: true, map: disc(), alphaTest: 0.5 }),
    );
    const points = new Points(this.geometry, material);
    points.castShadow = true;
    return points;
  }

  private clear(): void {
    if (!this.object) return;
    this.group.remove(this.object);
    this.geometry.dispose();
    const material = this.object.material as MeshBasicMaterial | MeshPhongMaterial | PointsMaterial;
    material.map?.dispose();
    material.dispose();
  }

  /** Triangles in the order they are drawn in. */
  layer(triangles: Uint32Array): void {
    const index = this.geometry.index as BufferAttribute | null;
    if (!index || this.layered === triangles) return;
    this.layered = triangles;
    (index.array as Uint32Array).set(triangles);
    index.needsUpdate = true;
  }

  update(positions: Float32Array, normals: Float32Array): void {
    this.write("position", positions);
    this.write("normal", normals);
    this.geometry.boundingSphere = everywhere; // a drawing would look through all vertices for a smaller one
  }

  /** Before a ray looks for the shape: rays that pass by its sphere are told at once. */
  bound(): void {
    if (this.geometry.boundingSphere !== everywhere) return;
    this.geometry.boundingSphere = null; // or it would be made smaller in its place
    this.geometry.computeBoundingSphere();
  }

  private write(name: string, values: Float32Array): void {
    const attribute = this.geometry.getAttribute(name) as BufferAttribute;
    attribute.array.set(values);
    attribute.needsUpdate = true;
  }

  /** Colours from the constraints; `stroke`: what does not move as a stroke that is not done yet leaves it. */
  paint(doc: Doc, stroke?: ReadonlySet<number>): void {
    const held = doc.handles.filter((h) => h.held).map((h) => h.vertices);
    const pulled = doc.handles.filter((h) => !h.held).map((h) => h.vertices);
    const unmoved = stroke ? [stroke] : [doc.fixed, ...held];
    this.repaint([...unmoved, undefined, ...pulled], stroke !== undefined, (tints) => {
      for (const region of unmoved) for (const v of region) tints.set(fixedTint, 4 * v);
      for (const region of pulled) for (const v of region) tints.set(heldTint, 4 * v);
    });
  }

  /** The limb under strokes from red to blue along it, or nothing; fainter once it has been posed. */
  paintLimb(limb: SketchView | undefined, faint: boolean): void {
    this.repaint([limb?.labels, limb?.parameters, faint], false, (tints) => {
      if (!limb) return;
      const opacity = faint ? 70 : 165;
      for (let v = 0; 4 * v < tints.length; v++) {
        const s = limb.parameters[v] ?? 0;
        if ((limb.labels[v] ?? 1) > 0) {
          tints.set([225 * (1 - s) ** 1.5 + 8, 14 + 40 * s * (1 - s), 225 * s ** 1.5 + 8, opacity], 4 * v);
        }
      }
    });
  }

  private repaint(key: unknown[], always: boolean, fill: (tints: Uint8Array) => void): void {
    if (!always && key.length === this.painted.length && key.every((part, i) => part === this.painted[i])) return;
    this.painted = always ? [] : key;
    const attribute = this.geometry.getAttribute("tint") as BufferAttribute;
    const tints = attribute.array as Uint8Array;
    tints.fill(0);
    fill(tints);
    attribute.needsUpdate = true;
  }

  setWireframe(on: boolean): void {
    if (this.object instanceof Mesh) (this.object.material as MeshBasicMaterial | MeshPhongMaterial).wireframe = on;
  }

  /** Lets what lies inside shine through. */
  setVeiled(on: boolean): void {
    const material = this.object?.material as Material | undefined;
    if (!material || this.object instanceof Points) return;
    if (material instanceof MeshBasicMaterial) {
      material.opacity = on ? 0.45 : 1;
      return;
    }
    material.transparent = on;
    material.opacity = on ? 0.45 : 1;
    material.depthWrite = !on;
    material.needsUpdate = true;
  }
}

/** Lets a material mix in the colours of the attribute `tint` (rgb and opacity). */
function tinted<T extends Material>(material: T): T {
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("void main() {", "attribute vec4 tint;\nvarying vec4 vTint;\nvoid main() {\n  vTint = tint;");
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", "varying vec4 vTint;\nvoid main() {")
      .replace(
        "#include <color_fragment>",
        "#include <color_fragment>\n  diffuseColor.rgb = mix(diffuseColor.rgb, vTint.rgb, vTint.a);",
      );
  };
  return material;
}

/**
 * A picture in the plane, as it is: neither lit nor taken to linear light, with colours times alpha, one triangle over
 * the
 * one before.
 */
function flat(image: TexImageSource): MeshBasicMaterial {
  const map = pictureTexture(image);
  map.colorSpace = NoColorSpace;
  map.premultiplyAlpha = true;
  const material = new MeshBasicMaterial({
    map, transparent: true, premultipliedAlpha: true, side: DoubleSide, depthTest: false, depthWrite: false,
  });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("void main() {", "attribute vec4 tint;\nvarying vec4 vTint;\nvoid main() {\n  vTint = tint;");
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", "varying vec4 vTint;\nvoid main() {")
      .replace("#include <color_fragment>",
        "diffuseColor.rgb = mix(diffuseColor.rgb, vTint.rgb * diffuseColor.a, 0.6 * vTint.a);")
      .replace("#include <opaque_fragment>", "gl_FragColor = diffuseColor * vec4(vec3(opacity), 1.0);")
      .replace("#include <colorspace_fragment>", "")
      .replace("#include <premultiplied_alpha_fragment>", "");
  };
  return material;
}

/** Linear colours of the vertices. */
function baseColors(shape: ShapeData): Float32Array {
  const out = new Float32Array(3 * vertexCount(shape));
  for (let i = 0; i < out.length; i++) out[i] = linear[shape.colors?.[i] ?? clay[i % 3]!]!;
  return out;
}

function pictureTexture(image: TexImageSource): Texture {
  const texture = new Texture(image as HTMLImageElement);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 8;
  texture.needsUpdate = true;
  return texture;
}

/** A round dot for points. */
function disc(): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d")!;
  context.fillStyle = "#fff";
  context.beginPath();
  context.arc(32, 32, 31, 0, 2 * Math.PI);
  context.fill();
  return new CanvasTexture(canvas);
}
