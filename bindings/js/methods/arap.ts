// arap: Sorkine, Alexa, As-Rigid-As-Possible Surface Modeling (2007).

import { fraction, positive } from "../boundary/check.js";
import { method } from "./method.js";
import { choice, number, numberOrNull } from "./option.js";

export const arap = method({
  name: "arap",
  title: "As rigid as possible",
  short: "ARAP",
  paper: "Sorkine, Alexa: As-Rigid-As-Possible Surface Modeling (2007)",
  help: "Every vertex turns with its neighbours.",
  carries: false,
  curves: false,
  draws: [],
  live: true,
  loads: [],
  options: {
    energy: choice(["spokes", "spokes-and-rims"], {
      title: "Energy", default: "spokes",
      help: "Which edges one rotation has to fit: those of its vertex, or all of the triangles around it.",
    }),
    constraintWeight: numberOrNull(positive, {
      title: "Softness", min: 0.1, max: 1000, step: 0.1, log: true, advanced: true,
      help:
        "Makes handles soft: the weight of the squared distances from their targets. " +
        "Left out, or null: they are exact.",
    }),
    smoothness: number(fraction, {
      title: "Smoothness", default: 0, start: 0.05, min: 0, max: 0.3, step: 0.01,
      help: "The part of the size below which bending is kept away: from 0.05 no spike grows under a small handle.",
    }),
  },
});
