// Builds the page. The first picture needs only the meshes.
const meshes = [];
const canvas = document.getElementById("canvas");

function largestRadius() {
  let square = 0;
  for (const mesh of meshes)
    for (let n = 0; n < mesh.points.length; n += 3)
      square = Math.max(square, mesh.points[n] ** 2 + mesh.points[n + 1] ** 2 + mesh.points[n + 2] ** 2);
  return Math.sqrt(square) || 1;
}

// Names the views; the names follow them when the window changes.
function placeTitles(views) {
  const titles = meshes.map(mesh => {
    const title = textElement("div", mesh.title);
    title.className = "view-title";
    canvas.parentElement.append(title);
    return title;
  });
  const place = () => titles.forEach((title, side) => {
    const { x, y, width } = views.rectangle(side);
    Object.assign(title.style, { left: x + "px", top: y + "px", maxWidth: width + "px" });
  });
  place();
  new ResizeObserver(place).observe(canvas.parentElement);
}

// For scripts that use the page: coordinates are those of the files.
function scriptAccess(views, orbit, cursor) {
  const center = arrayOf("center"), inFile = p => p && p.map((x, a) => x + center[a]);
  return {
    get frames() { return views.frames; },
    get cursor() {
      if (!cursor.at) return null;
      const { side, place, image, curve } = cursor.at;
      return { side, point: inFile(place.point), image: inFile(image && image.point), curve: curve && curve.map(inFile) };
    },
    numberOfVertices: side => meshes[side].points.length / 3,
    // Returns a vertex and its image on the other mesh, which is null if there is none.
    imageOfVertex(side, vertex) {
      const n = meshes[side].triangles.indexOf(vertex), weights = [0, 0, 0];
      weights[n % 3] = 1;
      const point = pointAt(meshes[side].points, vertex);
      const { image } = cursor.map(side, { point, triangle: Math.floor(n / 3), weights });
      return { point: inFile(point), image: image ? inFile(image.point) : null };
    },
    turn(angle) {
      orbit.turn(angle, 0);
      views.move();
    }
  };
}

function build() {
  const redraw = () => views.redraw();
  for (let side = 0; hasData("mesh" + side); ++side) meshes.push(new DrawnMesh(side, redraw));
  const orbit = new Orbit(largestRadius()), views = new Views(canvas, meshes.length, orbit), surfaces = new ShellSurfaces();
  meshes.forEach((mesh, side) => views.scenes[side].add(mesh.object));
  const bodies = meshes.map(({ title, points, triangles }, side) =>
    ({ title, color: meshColors[side], points: () => points, triangles: () => triangles }));
  for (const { name, color } of surfaces.list)
    bodies.push({ color, points: () => arrayOf(name + ".points"), triangles: () => arrayOf(name + ".triangles") });
  const section = new Section(views.scenes, bodies, orbit.radius), cursor = new Cursor(views, meshes, section);
  views.motion.bodies = [...meshes, surfaces].map(body => ({ setCoarse: isCoarse => body.setCoarse(isCoarse, orbit.radius) }));
  showPlaces(document.getElementById("places"), views, orbit);
  const panel = new Panel({ views, orbit, meshes, channels: new Channels(meshes), surfaces, section, cursor });
  listenToPointer(canvas, { orbit, views, cursor, changed: () => panel.describeCursor() });
  placeTitles(views);
  window.shellView = scriptAccess(views, orbit, cursor);
}

const narrowest = 700; // pixels; on smaller screens, the report is closed at first
document.getElementById("report").open = window.innerWidth >= narrowest;
try {
  build();
} catch (error) {
  document.getElementById("failure").hidden = false;
  document.getElementById("failure").append(" (" + error.message + ")");
}
