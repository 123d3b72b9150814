// Shapes: what the door takes in, and selections over it.

import { describe, expect, it } from "vitest";
import { pliant } from "./support/package.js";
import { cloud, picture, sheet, torus, where } from "./support/shapes.js";

describe("the report", () => {
  it("counts a closed mesh by Euler's formula", () => {
    const { positions, triangles } = torus(12, 8);
    expect(pliant.shape({ positions, triangles }).report).toEqual({
      vertices: 96, triangles: 192, components: 1, boundaryEdges: 0, nonManifoldEdges: 0, degenerateTriangles: 0,
      weldedVertices: 0,
    });
  });

  it("counts the border of an open one", () => {
    const { positions, triangles } = sheet(5);
    expect(pliant.shape({ positions, triangles }).report).toMatchObject({
      triangles: 32, boundaryEdges: 16, components: 1,
    });
  });

  it("sees two triangles of a soup that touch as one component", () => {
    const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, /**/ 1, 0, 0, 1, 1, 0, 0, 1, 0];
    const { report } = pliant.shape({ positions, triangles: [0, 1, 2, 3, 4, 5] });
    expect(report).toMatchObject({ vertices: 6, weldedVertices: 2, components: 1, boundaryEdges: 4 });
  });

  it("accepts what is degenerate and says so", () => {
    const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 0, 0, 1, 0, 0, -1, 9, 9, 9];
    const triangles = [0, 1, 2, 0, 1, 4, 0, 1, 5, 0, 1, 3];
    const { report } = pliant.shape({ positions, triangles });
    expect(report).toMatchObject({ degenerateTriangles: 1, components: 2 });
    expect(report.nonManifoldEdges).toBeGreaterThanOrEqual(1);
  });

  it("takes every kind of array", () => {
    const { positions, triangles } = sheet(4);
    const kinds = [Float32Array.from(positions), positions, Array.from(positions)];
    const reports = kinds.map(
      (kind) => pliant.shape({ positions: kind, triangles: Uint16Array.from(triangles) }).report,
    );
    expect(new Set(reports.map((report) => JSON.stringify(report))).size).toBe(1);
  });

  it("takes points and pictures", () => {
    expect(pliant.shape({ positions: cloud(50) }).report).toMatchObject({ vertices: 50, triangles: 0, components: 50 });
    expect(pliant.shape({ ...picture(4), dimension: 2 })).toMatchObject({
      dimension: 2, report: { vertices: 16, triangles: 18 },
    });
  });

  it("cannot be changed", () => {
    const shape = pliant.shape(sheet(4));
    expect(Object.isFrozen(shape.report)).toBe(true);
  });
});

describe("selections", () => {
  const { positions, triangles } = sheet(9);
  const shape = pliant.shape({ positions, triangles });
  const left = { halfSpace: { normal: [-2, 0, 0], offset: -0.6 } };
  const near = { sphere: { center: [0.5, 0.5, 0], radius: 0.3 } };
  const isLeft = (x: number) => x <= 0.3;
  const isNear = (x: number, y: number, z: number) => Math.hypot(x - 0.5, y - 0.5, z) <= 0.3;

  it.each([
    ["vertices, ascending", { vertices: new Set([7, 3, 5]) }, [3, 5, 7]],
    ["a box", { box: { min: [0.2, 0.2, -1], max: [0.6, 0.9, 1] } },
      where(positions, (x, y) => x >= 0.2 && x <= 0.6 && y >= 0.2 && y <= 0.9)],
    ["a sphere", near, where(positions, isNear)],
    ["a half space, its normal as it is", left, where(positions, isLeft)],
    ["all", { all: true as const }, where(positions, () => true)],
    ["any", { any: [left, near] }, where(positions, (x, y, z) => isLeft(x) || isNear(x, y, z))],
    ["every", { every: [left, near] }, where(positions, (x, y, z) => isLeft(x) && isNear(x, y, z))],
    ["not", { not: left }, where(positions, (x) => !isLeft(x))],
  ])("select %s", (_, selection, expected) => {
    expect(expected.length).toBeGreaterThan(0);
    expect(Array.from(shape.select(selection))).toEqual(expected);
  });

  it("include their bounds", () => {
    const points = pliant.shape({ positions: [0, 0, 0, 1, 0, 0, 2, 0, 0] });
    expect(Array.from(points.select({ box: { min: [0, 0, 0], max: [1, 0, 0] } }))).toEqual([0, 1]);
    expect(Array.from(points.select({ sphere: { center: [0, 0, 0], radius: 1 } }))).toEqual([0, 1]);
    expect(Array.from(points.select({ halfSpace: { normal: [1, 0, 0], offset: 1 } }))).toEqual([1, 2]);
  });

  it("have two coordinates in the plane", () => {
    const flat = pliant.shape({ ...picture(3), dimension: 2 });
    expect(Array.from(flat.select({ box: { min: [-1, -1], max: [0.2, 2] } }))).toEqual([0, 1, 2]);
  });
});
