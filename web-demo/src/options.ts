// What the controls of a method hold.

/** Polylines on the surface at rest, painted by the visitor. */
export type Strokes = readonly (readonly (readonly [number, number, number])[])[];
export type OptionValue = number | boolean | string | Strokes;
/** As the controls show them; `scriptOptions` gives what the package takes. */
export type Options = Readonly<Record<string, OptionValue>>;
