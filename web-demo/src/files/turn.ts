// A turn of the event loop: between two pieces of work over a large file the page draws and listens.
export const turn = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));
