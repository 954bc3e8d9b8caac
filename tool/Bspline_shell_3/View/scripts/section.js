// The clipping plane, and the lines in which it cuts meshes and surfaces.
const meshColors = [0x151515, 0x1d9a4a]; // of the first mesh and of the result

class Section {
  // `bodies` have points, triangles, and a color.
  constructor(scenes, bodies, radius) {
    this.radius = radius;
    this.axis = null; // 0, 1, or 2; null if nothing is clipped
    this.position = 0; // from -1 to 1
    this.isFlipped = false;
    this.bodies = bodies.map(body => ({ ...body, geometry: new THREE.BufferGeometry() }));
    for (const body of this.bodies) {
      const material = lineMaterial(body.color, { isClipped: false });
      body.lines = scenes.map(scene => {
        const lines = new THREE.LineSegments(body.geometry, material);
        lines.frustumCulled = false;
        scene.add(lines);
        return lines;
      });
    }
  }

  // Sets the plane of the materials, and computes the lines.
  update() {
    const isOn = this.axis !== null, sign = this.isFlipped ? -1 : 1, height = this.position * this.radius;
    const normal = [0, 0, 0];
    if (isOn) normal[this.axis] = sign;
    clipping.value.set(...normal, isOn ? sign * height : 1);
    for (const body of this.bodies) {
      if (isOn) {
        const lines = planeSection(body.points(), body.triangles(), this.axis, height);
        body.geometry.setAttribute("position", new THREE.BufferAttribute(lines, 3));
      }
      for (const lines of body.lines) lines.visible = isOn;
    }
  }

  // Returns the part of the parameters of a line that is not clipped.
  visibleRange(origin, direction) {
    const plane = clipping.value, normal = [plane.x, plane.y, plane.z];
    const height = plane.w - dot(origin, normal), slope = dot(direction, normal);
    if (slope === 0) return height >= 0 ? [0, Infinity] : [0, -1];
    return slope > 0 ? [0, height / slope] : [Math.max(height / slope, 0), Infinity];
  }
}

// Returns the segments in which a plane across an axis cuts triangles.
function planeSection(points, triangles, axis, height) {
  const ends = [];
  for (let n = 0; n < triangles.length; n += 3) {
    const a = points[3 * triangles[n] + axis], b = points[3 * triangles[n + 1] + axis], c = points[3 * triangles[n + 2] + axis];
    if (a >= height === b >= height && b >= height === c >= height) continue;
    for (let i = 0; i < 3; ++i) {
      const p = pointAt(points, triangles[n + i]), q = pointAt(points, triangles[n + (i + 1) % 3]);
      if (p[axis] >= height !== q[axis] >= height)
        ends.push(...add(p, subtract(q, p), (height - p[axis]) / (q[axis] - p[axis])));
    }
  }
  return Float32Array.from(ends);
}
