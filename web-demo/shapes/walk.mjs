// The order in which a closed mesh is packed and unpacked: from a first triangle across one edge after
// another, so that mostly either the next new point or a neighbour on the rim is met.
// After Touma & Gotsman, "Triangle mesh compression" (1998), and Rossignac, "Edgebreaker" (1999).

/** Directed edges that have a triangle on one side so far. */
class Rim {
  #from = new Map(); // point -> where its rim edges lead
  #to = new Map(); // point -> where rim edges that end in it come from

  #list(map, v) {
    if (!map.has(v)) map.set(v, []);
    return map.get(v);
  }
  has(a, b) {
    return this.#list(this.#from, a).includes(b);
  }
  add(a, b) {
    this.#list(this.#from, a).push(b);
    this.#list(this.#to, b).push(a);
  }
  remove(a, b) {
    const drop = (list, v) => list.splice(list.indexOf(v), 1);
    drop(this.#list(this.#from, a), b);
    drop(this.#list(this.#to, b), a);
  }
  /** Where the rim goes on from v, and where it came to v from; -1: nowhere. */
  after(v) {
    return this.#list(this.#from, v).at(-1) ?? -1;
  }
  before(v) {
    return this.#list(this.#to, v).at(-1) ?? -1;
  }
}

/**
 * Visits all triangles. `first()` gives the three corners of one that no other leads to;
 * `across(x, y, opposite, after, before)` the third corner of the triangle behind the edge x -> y, where
 * `opposite` is the third corner on this side and `after`, `before` are the points beside the edge on the
 * rim. Calls `visit(a, b, c)` for each.
 */
export function walk(count, first, across, visit) {
  const rim = new Rim();
  for (let done = 0; done < count;) {
    const [a, b, c] = first();
    const stack = [[a, b, c], [b, c, a], [c, a, b]];
    for (const [x, y] of stack) rim.add(x, y);
    visit(a, b, c);
    done++;
    while (stack.length > 0) {
      const [x, y, opposite] = stack.pop();
      if (!rim.has(x, y)) continue;
      const z = across(x, y, opposite, rim.after(y), rim.before(x));
      rim.remove(x, y);
      for (const [p, q, beside] of [[z, y, x], [x, z, y]]) {
        if (rim.has(q, p)) rim.remove(q, p);
        else {
          rim.add(p, q);
          stack.push([p, q, beside]);
        }
      }
      visit(y, x, z);
      done++;
    }
  }
}

/** How a third corner is written; what is `known` is followed by its distance from the newest point. */
export const symbols = { fresh: 0, after: 1, before: 2, known: 3 };
