// rigid-cells: Botsch, Pauly, Wicke, Gross, Adaptive Space Deformations Based on Rigid Cells (2007).

import { type Fields, fields, filled, list, type Place, positive, vector } from "../boundary/check.js";
import { numbersOf, packLists, unpackLists } from "../boundary/lists.js";
import { type Extent, readSelection, type Select, selectedIds, type Selection } from "../shape/selection.js";
import { insideOf } from "../shape/shape.js";
import type { StateHatch } from "../boundary/state.js";
import { method } from "./method.js";
import { choice, flag, integer, option } from "./option.js";

/** A region that is softer (below 1) or stiffer than the rest. */
export interface Stiffness {
  select: Selection;
  factor: number;
}

interface ReadStiffness {
  select: Select;
  factor: number;
}

function readStiffness(place: Place, value: unknown, extent: Extent): ReadStiffness[] {
  return Array.from(filled(place, value, "regions with a factor"), (region, i) => {
    const at = place.item(i);
    const { select, factor } = fields(at, region, ["select", "factor"]);
    return { select: readSelection(at.at("select"), select, extent), factor: positive(at.at("factor"), factor) };
  });
}

/** How a cell is held in the tables: not, whole, or at a point, which is then `point`. */
interface PackedCell {
  held: number;
  point: number[];
}

function packCell(place: Place, value: unknown): Fields & PackedCell {
  const { held, ...cell } = fields(place, value, ["center", "size", "rotation", "translation", "factor", "held"]);
  if (held === null || held === "cell") return { ...cell, held: held === null ? 0 : 1, point: [0, 0, 0] };
  return { ...cell, held: 2, point: vector(place.at("held"), held, 3) };
}

/** A cell says by itself how it is held: null, "cell", or the point. */
const heldInWords: StateHatch = {
  show: (state) => ({
    ...state,
    cells: (state.cells as PackedCell[]).map(({ held, point, ...cell }) => ({
      ...cell, held: [null, "cell", point][held],
    })),
  }),
  read(place, state) {
    if (state.cells === undefined) return state;
    const at = place.at("cells");
    return { ...state, cells: Array.from(list(at, state.cells), (cell, i) => packCell(at.item(i), cell)) };
  },
};

export const rigidCells = method({
  name: "rigid-cells",
  title: "Rigid cells",
  short: "Cells",
  paper: "Botsch, Pauly, Wicke, Gross: Adaptive Space Deformations Based on Rigid Cells (2007)",
  help: "The space the shape fills, in rigid boxes glued elastically: bodies keep their volume.",
  carries: true,
  curves: false,
  draws: [],
  live: ["refine", "transfer", "hold", "stiffness"],
  loads: [],
  state: heldInWords,
  options: {
    resolution: integer(1, 256, "a number of cells", {
      title: "Cells", default: 16, min: 4, max: 32, step: 1,
      help: "How many cells lie along the longest side, before the boundary is refined.",
    }),
    boundaryLevels: integer(0, 4, "a number of levels", {
      title: "Boundary", default: 1, min: 0, max: 3, step: 1,
      help: "How often cells at the boundary are split: finer ones tell fingers and legs apart.",
    }),
    interior: flag({
      title: "Solid", default: true,
      help: "A solid body; without its inner cells the shape bends as a shell does.",
    }),
    transfer: choice(["rbf", "blend"], {
      title: "Carry", default: "rbf",
      help: "How points follow the cells: a smooth map of space, or the four nearest cells, sooner and coarser.",
    }),
    hold: choice(["cells", "points"], {
      title: "Hold", default: "cells",
      help: "Whether fixed regions and handles hold whole cells, or a point of each, about which it is free to turn.",
    }),
    refine: flag({
      title: "Refine", default: false, advanced: true,
      help: "Splits cells that differ much from their neighbours, once solve has converged.",
    }),
    align: flag({
      title: "Align", default: true, advanced: true,
      help: "The grid lies along the shape's principal axes, not the world's.",
    }),
    stiffness: option<readonly Stiffness[]>("stiffness", {
      title: "Stiffness", advanced: true,
      help: "Regions that are softer (factor below 1) or stiffer than the rest.",
    }, {
      read: readStiffness,
      pack: (name, regions: ReadStiffness[], place, shape) => ({
        ...packLists(name, regions.map(({ select }, i) =>
          selectedIds(place.item(i).at("select"), select, insideOf(shape).rest))),
        [`${name}/factors`]: regions.map(({ factor }) => factor),
      }),
      unpack(name, values) {
        const factors = numbersOf(values[`${name}/factors`]);
        const regions = unpackLists(name, values).map((vertices, i) => ({ select: { vertices }, factor: factors[i] }));
        return regions.length === 0 ? undefined : regions;
      },
    }),
  },
});
