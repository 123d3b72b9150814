// Line icons on a 24 x 24 grid.

const paths = {
  sketch:
    "M3.500 20.500l1.200-4.700L15.900 4.600a1.900 1.900 0 0 1 2.700 0l.8.8" +
    "a1.900 1.900 0 0 1 0 2.700L8.200 19.300zM14 6.500l3.500 3.500M13 20.500h7.500",
  grain: "M4 7c5-3 11 3 16 0M4 12c5-3 11 3 16 0M4 17c5-3 11 3 16 0",
  pose:
    "M8 13V6.5a1.5 1.5 0 0 1 3 0V11m0-1V4.8a1.5 1.5 0 0 1 3 0V11m0-.5V6.3a1.5 1.5 0 0 1 3 0" +
    "V14c0 4-2.2 6.5-5.5 6.5-2.6 0-4-1-5.3-3.3l-2-3.6c-.9-1.6 1.2-2.8 2.3-1.4L8 14",
  handle: "M12 5v14M5 12h14M12 12m-9.5 0a9.5 9.5 0 1 0 19 0a9.5 9.5 0 1 0-19 0",
  fix:
    "M14.5 4.5l5 5M9.5 14.5 18 6a1.8 1.8 0 0 1 2.500 2.500L12 17" +
    "c-.6 2.6-3.400 4-8 3.500 1.800-1 1.800-2.500 2.200-3.700.5-1.700 1.700-2.300 3.300-2.300z",
  free: "M4.500 15.500 13 7l6 6-6.500 6.500H8zM9 11l6 6M12 20h8",
  undo: "M9 14 4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3",
  redo: "m15 14 5-5-5-5M20 9H10a6 6 0 0 0 0 12h3",
  reset: "M4 12a8 8 0 1 0 2.500-5.800M4 4v5h5",
  home:
    "M4 8V5.500A1.500 1.500 0 0 1 5.500 4H8M16 4h2.500A1.500 1.500 0 0 1 20 5.500V8M20 16" +
    "v2.500a1.500 1.500 0 0 1-1.500 1.500H16M8 20H5.500A1.500 1.500 0 0 1 4 18.500V16M12 12h.01",
  help:
    "M9.200 9.200a2.900 2.900 0 1 1 4.300 2.500c-1 .6-1.500 1.200-1.500 2.300" +
    "M12 17.500h.01M12 12m-9 0a9 9 0 1 0 18 0a9 9 0 1 0-18 0",
  close: "m6 6 12 12M18 6 6 18",
} as const;

export type IconName = keyof typeof paths;

export function icon(name: IconName): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", paths[name]);
  svg.append(path);
  return svg;
}
