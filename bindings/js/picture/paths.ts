// Shortest paths along the edges of a mesh.

export class EdgePaths {
  /** Neighbours of vertex v: from `#begin[v]` to `#begin[v + 1]`, and how long the edge is. */
  readonly #begin: Uint32Array;
  readonly #neighbours: Uint32Array;
  readonly #lengths: Float64Array;
  readonly count: number;

  /** `dimension` numbers a vertex. */
  constructor(
    positions: ArrayLike<number>,
    dimension: number,
    readonly triangles: ArrayLike<number>,
  ) {
    this.count = positions.length / dimension;
    this.#begin = new Uint32Array(this.count + 1);
    this.#eachEdge((a) => ++this.#begin[a + 1]);
    for (let v = 0; v < this.count; ++v) this.#begin[v + 1] += this.#begin[v];
    const total = this.#begin[this.count];
    [this.#neighbours, this.#lengths] = [new Uint32Array(total), new Float64Array(total)];
    const next = this.#begin.slice();
    this.#eachEdge((a, b) => {
      let squares = 0;
      for (let k = 0; k < dimension; ++k) squares += (positions[dimension * a + k] - positions[dimension * b + k]) ** 2;
      this.#neighbours[next[a]] = b;
      this.#lengths[next[a]++] = Math.sqrt(squares);
    });
  }

  /** Both ways; an edge of two triangles twice each. */
  #eachEdge(visit: (a: number, b: number) => void): void {
    for (let corner = 0; corner < this.triangles.length; ++corner) {
      const [a, b] = [this.triangles[corner], this.triangles[corner % 3 === 2 ? corner - 2 : corner + 1]];
      visit(a, b);
      visit(b, a);
    }
  }

  /** Vertices of edges that only one triangle has. */
  boundary(): number[] {
    const found: number[] = [];
    for (let v = 0; v < this.count; ++v) {
      const own = this.#neighbours
        .subarray(this.#begin[v], this.#begin[v + 1])
        .slice()
        .sort();
      if (own.some((b, i) => b !== own[i - 1] && b !== own[i + 1])) found.push(v);
    }
    return found;
  }

  /** A number for each vertex, the same for all that hang together. */
  parts(): Int32Array {
    const parts = new Int32Array(this.count).fill(-1);
    for (let seed = 0; seed < this.count; ++seed) {
      if (parts[seed] >= 0) continue;
      const open = [seed];
      parts[seed] = seed;
      for (let v = open.pop(); v !== undefined; v = open.pop()) {
        for (let i = this.#begin[v]; i < this.#begin[v + 1]; ++i) {
          const other = this.#neighbours[i];
          if (parts[other] >= 0) continue;
          parts[other] = seed;
          open.push(other);
        }
      }
    }
    return parts;
  }

  /** Distance of each vertex from the closest of `seeds`; Infinity where no path leads. */
  from(seeds: Iterable<number>): Float64Array {
    const distances = new Float64Array(this.count).fill(Infinity);
    const heap = new Heap();
    for (const v of seeds) {
      distances[v] = 0;
      heap.push(0, v);
    }
    for (let top = heap.pop(); top; top = heap.pop()) {
      const [distance, v] = top;
      if (distance > distances[v]) continue;
      for (let i = this.#begin[v]; i < this.#begin[v + 1]; ++i) {
        const [other, reached] = [this.#neighbours[i], distance + this.#lengths[i]];
        if (reached >= distances[other]) continue;
        distances[other] = reached;
        heap.push(reached, other);
      }
    }
    return distances;
  }
}

/** The least first. */
class Heap {
  readonly #items: [key: number, value: number][] = [];

  push(key: number, value: number): void {
    const items = this.#items;
    let at = items.length;
    for (let parent = (at - 1) >> 1; at > 0 && items[parent][0] > key; at = parent, parent = (at - 1) >> 1)
      items[at] = items[parent];
    items[at] = [key, value];
  }

  pop(): [key: number, value: number] | undefined {
    const items = this.#items;
    const [top, last] = [items[0], items.pop()];
    if (!last || items.length === 0) return last;
    let at = 0;
    for (let child = 1; child < items.length; child = 2 * at + 1) {
      if (child + 1 < items.length && items[child + 1][0] < items[child][0]) ++child;
      if (items[child][0] >= last[0]) break;
      items[at] = items[child];
      at = child;
    }
    items[at] = last;
    return top;
  }
}
