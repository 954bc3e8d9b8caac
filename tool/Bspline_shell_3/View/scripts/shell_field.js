// The spline field of the shell and its two thresholds, which have the same cells of several levels.
class ShellField {
  static FIELD = 0;
  static INNER = 1;
  static OUTER = 2;

  constructor() {
    const frame = arrayOf("field.frame");
    this.origin = frame.slice(0, 3);
    this.width = frame[3];
    this.coefficients = arrayOf("field.coefficients");
    this.cells = ShellField.byLevel(arrayOf("field.cells"));
    this.points = ShellField.byLevel(arrayOf("field.points"));
  }

  // Returns a cell that contains a point, or null outside of the shell's cells.
  locate(p) {
    for (let level = this.cells.length - 1; level >= 0; --level) {
      const width = this.width / 2 ** level;
      const corner = [0, 1, 2].map(a => Math.floor((p[a] - this.origin[a]) / width));
      if (this.cells[level].has(ShellField.key(corner))) return this.cell(level, corner, width);
    }
    return null;
  }

  // Returns the value and the gradient at a point, or null outside of the shell's cells.
  jet(p, spline = ShellField.FIELD) {
    const cell = this.locate(p);
    if (!cell) return null;
    const weights = [], slopes = [];
    for (let a = 0; a < 3; ++a) {
      const t = (p[a] - this.origin[a]) / cell.width - cell.corner[a];
      weights.push(ShellField.weights(t));
      slopes.push(ShellField.slopes(t));
    }
    let value = 0;
    const gradient = [0, 0, 0];
    for (let k = 0, n = 0; k < 4; ++k)
      for (let j = 0; j < 4; ++j)
        for (let i = 0; i < 4; ++i, ++n) {
          const c = this.coefficients[3 * cell.points[n] + spline];
          value += c * weights[0][i] * weights[1][j] * weights[2][k];
          gradient[0] += c * slopes[0][i] * weights[1][j] * weights[2][k];
          gradient[1] += c * weights[0][i] * slopes[1][j] * weights[2][k];
          gradient[2] += c * weights[0][i] * weights[1][j] * slopes[2][k];
        }
    return { value, gradient: gradient.map(x => x / cell.width) };
  }

  // Returns the values of the field and of the thresholds, or null outside of the shell's cells.
  values(p) {
    const field = this.jet(p);
    return field && { field: field.value, inner: this.jet(p, ShellField.INNER).value, outer: this.jet(p, ShellField.OUTER).value };
  }

  // Returns the cell with the points of its 64 coefficients, and stores the last one, because points that follow each
  // other are close.
  cell(level, corner, width) {
    const last = this.lastCell;
    if (last && last.level === level && last.corner.every((x, a) => x === corner[a])) return last;
    const points = [];
    for (let k = -1; k < 3; ++k)
      for (let j = -1; j < 3; ++j)
        for (let i = -1; i < 3; ++i)
          points.push(this.points[level].get(ShellField.key([corner[0] + i, corner[1] + j, corner[2] + k])));
    return this.lastCell = { level, corner, width, points };
  }

  // Returns a map from the keys of lattice points to their numbers, for each level.
  static byLevel(items) {
    const levels = [];
    for (let n = 0; n < items.length / 4; ++n) {
      const [level, ...point] = items.subarray(4 * n, 4 * n + 4);
      while (levels.length <= level) levels.push(new Map());
      levels[level].set(ShellField.key(point), n);
    }
    return levels;
  }

  // Lattice coordinates have fewer than 17 bits, so that the key is exact.
  static key(point) {
    const half = 2 ** 16;
    return ((point[0] + half) * 2 * half + point[1] + half) * 2 * half + point[2] + half;
  }

  static weights(t) {
    const s = 1 - t;
    return [s ** 3 / 6, (3 * t ** 3 - 6 * t ** 2 + 4) / 6, (3 * s ** 3 - 6 * s ** 2 + 4) / 6, t ** 3 / 6];
  }

  static slopes(t) {
    const s = 1 - t;
    return [-(s ** 2) / 2, (3 * t ** 2 - 4 * t) / 2, (4 * s - 3 * s ** 2) / 2, t ** 2 / 2];
  }
}
