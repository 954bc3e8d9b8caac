// Integral curves of the field, and the places where they meet a mesh.
const stepsThroughShell = 64; // errors of the Runge-Kutta method are then far below those of single precision

// Returns the curve through a point of the shell, as points from the inner to the outer surface, or null outside of the
// shell. If the curve leaves the shell's cells, it ends there.
function integralCurve(field, p) {
  const at = field.values(p);
  const tolerance = 1e-4; // relative to the thickness: on surfaces, coordinates are rounded
  if (!at) return null;
  const slack = tolerance * (at.outer - at.inner);
  if (at.field < at.inner - slack || at.field > at.outer + slack) return null;
  const step = (at.outer - at.inner) / stepsThroughShell;
  const inward = halfCurve(field, p, -step), outward = halfCurve(field, p, step);
  return [...inward.reverse(), p, ...outward];
}

// Returns the points after `p` in one direction.
function halfCurve(field, p, step) {
  const most = 4 * stepsThroughShell; // where thresholds vary, the shell may be thicker than at the start
  const points = [];
  const excess = q => {
    const v = field.values(q);
    return v && (step > 0 ? v.field - v.outer : v.inner - v.field);
  };
  let before = excess(p);
  while (points.length < most) {
    const q = curveStep(field, p, step), after = q && excess(q);
    if (after === null) break;
    if (after >= 0) {
      if (before < 0) points.push(add(p, subtract(q, p), before / (before - after)));
      break;
    }
    points.push(q);
    p = q;
    before = after;
  }
  return points;
}

// Moves a point along the curve until the field has changed by a step, with the Runge-Kutta method of order four.
// Returns null outside of the shell's cells.
function curveStep(field, p, step) {
  const velocity = q => {
    const jet = field.jet(q);
    const square = jet && dot(jet.gradient, jet.gradient);
    return square > 0 ? jet.gradient.map(x => step * x / square) : null;
  };
  const a = velocity(p), b = a && velocity(add(p, a, 0.5)), c = b && velocity(add(p, b, 0.5)), d = c && velocity(add(p, c));
  return d && p.map((x, i) => x + (a[i] + 2 * b[i] + 2 * c[i] + d[i]) / 6);
}

// Returns the point where a curve meets a mesh, or null. Of several points, this is the outermost one, because polygons
// behind it are hidden.
function meetMesh(curve, tree) {
  const margin = 1e-6; // of the length of a segment, so that no point is lost between two of them
  for (let n = curve.length - 1; n > 0; --n) {
    const direction = subtract(curve[n - 1], curve[n]);
    const hit = tree.hit(curve[n], direction, -margin, 1 + margin);
    if (hit) return { point: add(curve[n], direction, hit.t), triangle: hit.triangle, weights: hit.weights };
  }
  return null;
}
