// Finds the triangles that a line meets, in a binary tree of boxes.
class TriangleTree {
  static leafSize = 4; // largest number of triangles of a node without children

  constructor(points, triangles) {
    this.points = points;
    this.triangles = triangles;
    const size = triangles.length / 3;
    this.order = new Uint32Array(size);
    this.centers = new Float32Array(3 * size);
    for (let t = 0; t < size; ++t) {
      this.order[t] = t;
      for (let a = 0; a < 3; ++a)
        for (let i = 0; i < 3; ++i) this.centers[3 * t + a] += points[3 * triangles[3 * t + i] + a];
    }
    this.boxes = []; // six numbers for each node
    this.nodes = []; // three numbers for each node: begin and end in the order, and the second child, or 0 for a leaf
    if (size > 0) this.build(0, size);
    this.centers = null;
  }

  // Returns the triangle that the segment from `origin + first * direction` to `origin + last * direction` meets first,
  // as { triangle, t, weights }, or null.
  hit(origin, direction, first, last) {
    const found = { triangle: -1, t: last, weights: null };
    const inverse = direction.map(x => 1 / x);
    const stack = this.nodes.length > 0 ? [0] : [];
    while (stack.length > 0) {
      const node = stack.pop();
      if (!this.meetsBox(node, origin, inverse, first, found.t)) continue;
      const second = this.nodes[3 * node + 2];
      if (second > 0) stack.push(node + 1, second);
      else
        for (let n = this.nodes[3 * node]; n < this.nodes[3 * node + 1]; ++n)
          this.meetTriangle(this.order[n], origin, direction, first, found);
    }
    return found.triangle < 0 ? null : found;
  }

  build(begin, end) {
    const node = this.nodes.length / 3;
    this.nodes.push(begin, end, 0);
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let n = begin; n < end; ++n) {
      const t = this.order[n];
      for (let a = 0; a < 3; ++a) {
        for (let i = 0; i < 3; ++i) {
          const x = this.points[3 * this.triangles[3 * t + i] + a];
          if (x < box[a]) box[a] = x;
          if (x > box[3 + a]) box[3 + a] = x;
        }
        const c = this.centers[3 * t + a];
        if (c < low[a]) low[a] = c;
        if (c > high[a]) high[a] = c;
      }
    }
    this.boxes.push(...box);
    if (end - begin <= TriangleTree.leafSize) return;
    const sides = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
    const middle = begin + end >> 1;
    this.select(begin, end - 1, middle, sides.indexOf(Math.max(...sides)));
    this.build(begin, middle);
    this.nodes[3 * node + 2] = this.nodes.length / 3;
    this.build(middle, end);
  }

  // Reorders triangles such that those before the middle have smaller centers, along an axis, than those after it.
  select(begin, end, middle, axis) {
    const order = this.order, key = n => this.centers[3 * order[n] + axis];
    while (begin < end) {
      const pivot = key(begin + end >> 1);
      let i = begin, j = end;
      while (i <= j) {
        while (key(i) < pivot) ++i;
        while (key(j) > pivot) --j;
        if (i > j) break;
        const t = order[i];
        order[i++] = order[j];
        order[j--] = t;
      }
      if (middle <= j) end = j;
      else if (middle >= i) begin = i;
      else return;
    }
  }

  meetsBox(node, origin, inverse, first, last) {
    for (let a = 0; a < 3; ++a) {
      const low = this.boxes[6 * node + a] - origin[a], high = this.boxes[6 * node + 3 + a] - origin[a];
      if (!isFinite(inverse[a])) {
        if (low > 0 || high < 0) return false;
        continue;
      }
      const enter = Math.min(low * inverse[a], high * inverse[a]), leave = Math.max(low * inverse[a], high * inverse[a]);
      first = Math.max(first, enter - 1e-9 * Math.abs(enter));
      last = Math.min(last, leave + 1e-9 * Math.abs(leave));
      if (first > last) return false;
    }
    return true;
  }

  meetTriangle(triangle, origin, direction, first, found) {
    const p = this.corner(triangle, 0), u = subtract(this.corner(triangle, 1), p), v = subtract(this.corner(triangle, 2), p);
    const n = cross(direction, v), determinant = dot(u, n);
    if (determinant === 0) return;
    const tolerance = 1e-9; // of weights, so that lines do not pass between neighbors
    const w = subtract(origin, p), b = dot(w, n) / determinant;
    const m = cross(w, u), c = dot(direction, m) / determinant, t = dot(v, m) / determinant;
    if (b < -tolerance || c < -tolerance || b + c > 1 + tolerance || t < first || t > found.t) return;
    Object.assign(found, { triangle, t, weights: [1 - b - c, b, c] });
  }

  corner(triangle, i) {
    return pointAt(this.points, this.triangles[3 * triangle + i]);
  }
}
