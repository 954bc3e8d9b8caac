// A point of one mesh, the integral curve through it, and its image on the other mesh.
const pointColor = 0xe8650a, imageColor = 0x7a2fd0, curveColor = 0xff8a1a;

class Cursor {
  constructor(views, meshes, section) {
    Object.assign(this, { views, meshes, section, isFixed: false, at: null });
    this.field = null;
    this.curveGeometry = new THREE.BufferGeometry();
    this.marks = [pointColor, imageColor].map(color => ({ geometry: new THREE.BufferGeometry(), material: discMaterial(color, 11) }));
    this.objects = views.scenes.map(scene => {
      const line = new THREE.Line(this.curveGeometry, lineMaterial(curveColor, { isClipped: false, isAlwaysVisible: true }));
      const marks = this.marks.map(mark => new THREE.Points(mark.geometry, mark.material));
      const group = new THREE.Group().add(line, ...marks);
      group.traverse(object => { object.frustumCulled = false; });
      group.visible = false;
      scene.add(group);
      return { group, line, marks };
    });
  }

  // Finds the visible point of a mesh on a line of sight, and moves the cursor there. Returns whether there is one.
  pick(sight) {
    const mesh = sight && this.meshes[sight.side];
    const hit = mesh && mesh.object.visible
      && mesh.tree.hit(sight.origin, sight.direction, ...this.section.visibleRange(sight.origin, sight.direction));
    if (hit) this.set(sight.side, { point: add(sight.origin, sight.direction, hit.t), triangle: hit.triangle, weights: hit.weights });
    else this.clear();
    return Boolean(hit);
  }

  set(side, place) {
    this.at = { side, place, ...this.map(side, place) };
    const { curve, image } = this.at, points = [place.point, image && image.point];
    if (curve) this.curveGeometry.setAttribute("position", pointsGeometry(curve.flat()).getAttribute("position"));
    this.marks.forEach((mark, n) => {
      if (points[n]) mark.geometry.setAttribute("position", pointsGeometry(points[n]).getAttribute("position"));
    });
    this.objects.forEach((object, n) => {
      object.group.visible = true;
      object.line.visible = Boolean(curve);
      object.marks[0].visible = n === side;
      object.marks[1].visible = n !== side && Boolean(image);
    });
    this.views.redraw();
  }

  clear() {
    this.at = null;
    this.isFixed = false;
    for (const object of this.objects) object.group.visible = false;
    this.views.redraw();
  }

  // Returns the curve and the image of a place, or the reason why there is none.
  map(side, place) {
    const other = this.meshes[1 - side];
    if (!hasData("field.frame")) return this.interpolate(side, place);
    this.field = this.field || new ShellField();
    const curve = integralCurve(this.field, place.point);
    if (!curve) return { reason: "The point is outside of the shell." };
    if (!other) return { curve };
    const image = meetMesh(curve, other.tree);
    return image ? { curve, image } : { curve, reason: "The curve does not meet the other mesh." };
  }

  // Returns the image between those of the corners, which the library has computed.
  interpolate(side, place) {
    const name = this.meshes[side].name + ".images";
    if (!hasData(name)) return { reason: this.meshes.length > 1 ? "There is no shell." : "" };
    const point = [0, 0, 0];
    for (let i = 0; i < 3; ++i) {
      const image = pointAt(arrayOf(name), this.meshes[side].triangles[3 * place.triangle + i]);
      for (let a = 0; a < 3; ++a) point[a] += place.weights[i] === 0 ? 0 : place.weights[i] * image[a];
    }
    return point.every(isFinite) ? { image: { point } } : { reason: "A corner of the facet has no image." };
  }
}

// Looks at the cursor from the side, so near that its curve is large.
function focusOnCursor(orbit, cursor) {
  if (!cursor.at) return;
  const { place, curve } = cursor.at;
  if (!curve) {
    orbit.focus(place.point, orbit.radius / 20);
    return;
  }
  const first = curve[0], last = curve[curve.length - 1];
  orbit.focus(place.point, 1.5 * distance(first, last));
  orbit.faceSideways(subtract(last, first));
}
