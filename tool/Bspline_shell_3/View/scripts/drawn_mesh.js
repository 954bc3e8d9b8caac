// A mesh of the page: its triangles, edges, colors, and textures.
const plainColor = [206, 203, 196];

class DrawnMesh {
  constructor(side, redraw) {
    this.side = side;
    this.name = "mesh" + side;
    this.title = titleOf(this.name);
    this.points = arrayOf(this.name + ".points");
    this.triangles = arrayOf(this.name + ".triangles");
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.points, 3));
    geometry.setIndex(new THREE.BufferAttribute(this.triangles, 1));
    geometry.setAttribute("paint", new THREE.BufferAttribute(new Uint8Array(this.points.length), 3, true));
    if (hasData(this.name + ".texture"))
      geometry.setAttribute("uv", new THREE.BufferAttribute(arrayOf(this.name + ".texture"), 2));
    this.paintedMaterial = surfaceMaterial();
    this.ownMaterials = this.addGroups(geometry, redraw);
    this.fine = geometry;
    this.surface = new THREE.Mesh(geometry, this.ownMaterials);
    this.edges = new THREE.LineSegments(new THREE.BufferGeometry(), lineMaterial(0x202020));
    this.edges.visible = false;
    this.object = new THREE.Group().add(this.surface, this.edges);
  }

  // Returns the search tree of the triangles.
  get tree() {
    return this.searchTree || (this.searchTree = new TriangleTree(this.points, this.triangles));
  }

  hasOwnColors() {
    return hasData(this.name + ".colors") || hasData(this.name + ".texture");
  }

  ownColors() {
    return hasData(this.name + ".colors") ? arrayOf(this.name + ".colors") : null;
  }

  // Colors the vertices, or all of them plainly if there are no colors. Images are shown only on request.
  paint(colors, showsImages) {
    const attribute = this.fine.getAttribute("paint");
    if (colors) attribute.array.set(colors);
    else for (let n = 0; n < attribute.count; ++n) attribute.array.set(plainColor, 3 * n);
    attribute.needsUpdate = true;
    this.surface.material = showsImages ? this.ownMaterials : this.ownMaterials.map(() => this.paintedMaterial);
  }

  // Draws fewer triangles and no edges.
  setCoarse(isCoarse, radius) {
    if (isCoarse && !this.coarse) this.coarse = coarseGeometry(this.fine, radius);
    this.surface.geometry = isCoarse ? this.coarse : this.fine;
    this.edges.visible = this.showsEdges && this.surface.geometry === this.fine;
  }

  showEdges(isShown) {
    this.showsEdges = isShown;
    if (isShown && !this.edges.geometry.index) {
      this.edges.geometry.setAttribute("position", this.fine.getAttribute("position"));
      this.edges.geometry.setIndex(new THREE.BufferAttribute(uniqueEdges(this.triangles), 1));
    }
    this.edges.visible = isShown;
  }

  // Adds a group of triangles for each image, and one for no image. Returns their materials.
  addGroups(geometry, redraw) {
    const materials = [];
    let begin = 0;
    arrayOf(this.name + ".groups").forEach((size, n) => {
      geometry.addGroup(begin, 3 * size, n);
      begin += 3 * size;
      materials.push(n > 0 && size > 0 ? surfaceMaterial({ image: DrawnMesh.texture(n - 1, redraw) }) : this.paintedMaterial);
    });
    return materials;
  }

  static texture(number, redraw) {
    const loaded = DrawnMesh.textures || (DrawnMesh.textures = []);
    if (!loaded[number]) {
      const image = new Image();
      loaded[number] = new THREE.Texture();
      loaded[number].wrapS = loaded[number].wrapT = THREE.RepeatWrapping;
      image.addEventListener("load", () => {
        loaded[number].image = repeatableImage(image);
        loaded[number].needsUpdate = true;
        redraw();
      });
      image.src = imageURL("image" + number);
    }
    return loaded[number];
  }
}

// Returns pairs of vertices.
function uniqueEdges(triangles) {
  const keys = new Float64Array(triangles.length), size = 2 ** 26; // more vertices do not fit into a page
  for (let n = 0; n < triangles.length; ++n) {
    const a = triangles[n], b = triangles[n % 3 === 2 ? n - 2 : n + 1];
    keys[n] = a < b ? a * size + b : b * size + a;
  }
  keys.sort();
  const edges = [];
  for (let n = 0; n < keys.length; ++n)
    if (n === 0 || keys[n] !== keys[n - 1]) edges.push(Math.floor(keys[n] / size), keys[n] % size);
  return Uint32Array.from(edges);
}

// Returns an image whose sides are powers of two, because WebGL repeats no others.
function repeatableImage(image) {
  const largest = 4096; // all but very old graphics cards support this number of pixels
  const side = length => Math.min(2 ** Math.round(Math.log2(length)), largest);
  const canvas = document.createElement("canvas");
  canvas.width = side(image.width);
  canvas.height = side(image.height);
  if (canvas.width === image.width && canvas.height === image.height) return image;
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas;
}
