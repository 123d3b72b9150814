// Edit scripts and their selections, as plain objects.

export const half = (normal: number[], offset: number) => ({ halfSpace: { normal, offset } });
export const script = (steps: unknown, more: object = {}) => ({ format: "pliant-edit", version: 1, steps, ...more });
