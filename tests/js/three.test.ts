// pliant/three: geometries of three.js joined to a deformer.

import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { entries, errorOf, pliant } from "./support/package.js";

describe("pliant/three", () => {
  const { GeometryBinding, shapeOf } = entries.three;

  async function bent(geometry: THREE.BufferGeometry) {
    const binding = new GeometryBinding(geometry as never);
    const input = shapeOf(geometry as never);
    const shape = pliant.shape(input);
    const deformer = pliant.deformer(shape, { method: "embedded-graph", nodeCount: 20 });
    deformer.setFixed(shape.select({ halfSpace: { normal: [0, -1, 0], offset: 0.9 } }));
    deformer.addHandle(shape.select({ halfSpace: { normal: [0, 1, 0], offset: 0.9 } })).move({ translate: [1, 0, 0] });
    await deformer.solve();
    binding.update(deformer);
    return { shape, deformer, binding };
  }

  it("welds UV seams and scatters results back over them", async () => {
    const geometry = new THREE.CylinderGeometry(0.3, 0.3, 2, 16, 12);
    const rest = geometry.getAttribute("position").clone();
    const { shape, deformer } = await bent(geometry);
    expect(shape.report.weldedVertices).toBeGreaterThan(0);
    expect(shape.report.boundaryEdges).toBe(0);
    const moved = geometry.getAttribute("position");
    expect(Float32Array.from(moved.array)).toEqual(deformer.positions());
    for (let i = 0; i < rest.count; ++i) {
      for (let j = 0; j < i; ++j) {
        const same = rest.getX(i) === rest.getX(j) && rest.getY(i) === rest.getY(j) && rest.getZ(i) === rest.getZ(j);
        if (same) {
          expect([moved.getX(i), moved.getY(i), moved.getZ(i)]).toEqual([moved.getX(j), moved.getY(j), moved.getZ(j)]);
        }
      }
    }
  });

  it("keeps hard edges hard and smooth ones smooth", async () => {
    const geometry = new THREE.BoxGeometry(0.5, 2, 0.5, 2, 8, 2);
    const rest = geometry.getAttribute("normal").clone();
    await bent(geometry);
    const [normal, position, index] = [
      geometry.getAttribute("normal"), geometry.getAttribute("position"), geometry.index!,
    ];
    const v = (attribute: { getX(i: number): number; getY(i: number): number; getZ(i: number): number }, i: number) =>
      new THREE.Vector3(attribute.getX(i), attribute.getY(i), attribute.getZ(i));
    let turned = 0;
    for (let t = 0; t < index.count; t += 3) {
      const [a, b, c] = [0, 1, 2].map((corner) => v(position, index.getX(t + corner)));
      const face = new THREE.Vector3().crossVectors(b.clone().sub(a), c.clone().sub(a)).normalize();
      // Every vertex of the box belongs to one side: its normal is close to that of its triangles.
      for (let corner = 0; corner < 3; ++corner) {
        const i = index.getX(t + corner);
        expect(v(normal, i).length()).toBeCloseTo(1, 5);
        expect(v(normal, i).dot(face)).toBeGreaterThan(0.8);
        turned = Math.max(turned, v(normal, i).distanceTo(v(rest, i)));
      }
    }
    expect(turned).toBeGreaterThan(0.2);
  });

  it("updates versions and bounds, and leaves groups and texture coordinates alone", async () => {
    const geometry = new THREE.BoxGeometry(0.5, 2, 0.5, 2, 8, 2);
    geometry.computeBoundingSphere();
    const [groups, uv] = [structuredClone(geometry.groups), Array.from(geometry.getAttribute("uv").array)];
    const before = geometry.getAttribute("position") as THREE.BufferAttribute;
    const { version } = before;
    await bent(geometry);
    expect(geometry.getAttribute("position")).toBe(before);
    expect(before.version).toBeGreaterThan(version);
    expect(geometry.groups).toEqual(groups);
    expect(Array.from(geometry.getAttribute("uv").array)).toEqual(uv);
    expect(geometry.boundingBox!.max.x).toBeGreaterThan(1);
    expect(geometry.boundingSphere!.center.x).toBeGreaterThan(0.3);
  });

  it("takes geometries without an index, and interleaved ones", async () => {
    const indexed = new THREE.TorusGeometry(0.8, 0.2, 8, 24).rotateX(0.3);
    const soup = indexed.toNonIndexed();
    const { shape } = await bent(soup);
    expect(shape.report).toMatchObject({ triangles: indexed.index!.count / 3, components: 1, boundaryEdges: 0 });
    const data = new THREE.InterleavedBuffer(new Float32Array(indexed.getAttribute("position").count * 6), 6);
    const interleaved = new THREE.BufferGeometry().setIndex(indexed.index);
    interleaved.setAttribute("position", new THREE.InterleavedBufferAttribute(data, 3, 0));
    const source = indexed.getAttribute("position");
    for (let i = 0; i < source.count; ++i) {
      interleaved.getAttribute("position").setXYZ(i, source.getX(i), source.getY(i), source.getZ(i));
    }
    await bent(interleaved);
    await bent(indexed);
    const [a, b] = [interleaved.getAttribute("position"), indexed.getAttribute("position")];
    for (let i = 0; i < a.count; ++i) expect(a.getX(i)).toBe(b.getX(i));
    expect(data.version).toBeGreaterThan(0);
  });

  /**
   * A geometry of floats with its attributes in 16 and 8 bits, as gltfpack leaves them; `interleaved`: side by side.
   */
  function quantised(geometry: THREE.BufferGeometry, interleaved: boolean): THREE.BufferGeometry {
    const result = new THREE.BufferGeometry().setIndex(geometry.index);
    const attribute = (name: string, array: Int16Array | Int8Array) => {
      const scale = array instanceof Int16Array ? 32767 : 127;
      array.set(Array.from(geometry.getAttribute(name).array, (x) => Math.round(scale * x)));
      if (!interleaved) return new THREE.BufferAttribute(array, 3, true);
      return new THREE.InterleavedBufferAttribute(new THREE.InterleavedBuffer(array, 3), 3, 0, true);
    };
    const { length } = geometry.getAttribute("position").array;
    result.setAttribute("position", attribute("position", new Int16Array(length)));
    return result.setAttribute("normal", attribute("normal", new Int8Array(length)));
  }

  it.each([false, true])("follows beyond the range of quantised attributes, interleaved %s", async (interleaved) => {
    const geometry = quantised(new THREE.CylinderGeometry(0.3, 0.3, 1.9, 16, 12), interleaved);
    const { deformer } = await bent(geometry);
    const position = geometry.getAttribute("position");
    expect(
      Float32Array.from({ length: 3 * position.count }, (_, i) =>
        [position.getX, position.getY, position.getZ][i % 3].call(position, Math.floor(i / 3)),
      ),
    ).toEqual(deformer.positions());
    expect(geometry.boundingBox!.max.x).toBeGreaterThan(1.2);
    const normal = geometry.getAttribute("normal");
    for (let i = 0; i < normal.count; ++i) {
      expect(Math.hypot(normal.getX(i), normal.getY(i), normal.getZ(i))).toBeCloseTo(1, 5);
    }
  });

  it("has tangents that follow, as those made anew", async () => {
    const geometry = new THREE.CylinderGeometry(0.3, 0.3, 2, 16, 12);
    geometry.computeTangents();
    const rest = geometry.getAttribute("tangent").clone();
    await bent(geometry);
    const moved = geometry.getAttribute("tangent").clone();
    geometry.computeTangents();
    const made = geometry.getAttribute("tangent");
    const at = (attribute: { array: ArrayLike<number> }, i: number) =>
      new THREE.Vector3(attribute.array[4 * i], attribute.array[4 * i + 1], attribute.array[4 * i + 2]);
    let turned = 0;
    for (let i = 0; i < made.count; ++i) {
      expect(moved.array[4 * i + 3]).toBe(rest.array[4 * i + 3]);
      expect(at(moved, i).length()).toBeCloseTo(1, 5);
      expect(at(moved, i).dot(at(made, i))).toBeGreaterThan(0.95);
      turned = Math.max(turned, at(moved, i).distanceTo(at(rest, i)));
    }
    expect(turned).toBeGreaterThan(0.1);
  });

  it("takes absolute morph targets along, and leaves relative ones", async () => {
    for (const relative of [false, true]) {
      const geometry = new THREE.CylinderGeometry(0.3, 0.3, 2, 16, 12);
      const rest = Float32Array.from(geometry.getAttribute("position").array);
      const target = new THREE.BufferAttribute(relative ? rest.map(() => 0.25) : rest.map((x) => x + 0.25), 3);
      geometry.morphAttributes.position = [target];
      geometry.morphTargetsRelative = relative;
      await bent(geometry);
      const moved = geometry.getAttribute("position").array;
      moved.forEach((x: number, i: number) => expect(target.array[i]).toBeCloseTo(relative ? 0.25 : x + 0.25, 5));
      expect(geometry.boundingBox!.max.x).toBeGreaterThan(1.4);
    }
  });

  it("takes positions from elsewhere", () => {
    const geometry = new THREE.PlaneGeometry(1, 1);
    const binding = new GeometryBinding(geometry as never);
    binding.write(Float32Array.from({ length: 12 }, (_, i) => i % 5));
    expect(geometry.getAttribute("position").getX(1)).toBe(3);
  });

  it("refuses what does not fit", async () => {
    const geometry = new THREE.PlaneGeometry(1, 1);
    expect((await errorOf(() => shapeOf(new THREE.BufferGeometry() as never))).code).toBe("invalid-shape");
    expect((await errorOf(() => shapeOf(undefined as never))).code).toBe("invalid-shape");
    const binding = new GeometryBinding(geometry as never);
    for (const nothing of [undefined, null, {}]) {
      expect(await errorOf(() => binding.update(nothing as never))).toMatchObject({
        code: "invalid-option", message: expect.stringContaining("deformer is"),
      });
    }
    expect((await errorOf(() => new GeometryBinding(geometry as never).write(new Float32Array(3)))).code).toBe(
      "invalid-option",
    );
  });
});
