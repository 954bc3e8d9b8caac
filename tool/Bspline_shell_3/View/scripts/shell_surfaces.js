// The inner and the outer surface of the shell.
const innerColor = 0x2f6fd0, outerColor = 0xd04a35;

class ShellSurfaces {
  constructor() {
    this.list = [["inner", innerColor, 0.9], ["outer", outerColor, 0.3]].filter(([name]) => hasData(name + ".points"))
      .map(([name, color, opacity]) => ({ name, color, opacity, object: null }));
    this.isShown = false;
  }

  get exist() {
    return this.list.length > 0;
  }

  // Adds the surfaces to scenes when they are shown first.
  show(isShown, scenes) {
    this.isShown = isShown;
    for (const surface of this.list) {
      if (isShown && !surface.objects) {
        const material = surfaceMaterial({ opacity: surface.opacity });
        surface.fine = ShellSurfaces.geometry(surface);
        surface.objects = scenes.map(scene => new THREE.Mesh(surface.fine, material));
        surface.objects.forEach((object, n) => scenes[n].add(object));
      }
      for (const object of surface.objects || []) object.visible = isShown;
    }
  }

  // Draws fewer triangles.
  setCoarse(isCoarse, radius) {
    for (const surface of this.list.filter(surface => surface.objects)) {
      if (isCoarse && !surface.coarse) surface.coarse = coarseGeometry(surface.fine, radius);
      for (const object of surface.objects) object.geometry = isCoarse ? surface.coarse : surface.fine;
    }
  }

  static geometry(surface) {
    const geometry = pointsGeometry(arrayOf(surface.name + ".points"));
    geometry.setIndex(new THREE.BufferAttribute(arrayOf(surface.name + ".triangles"), 1));
    const paint = new Uint8Array(3 * geometry.getAttribute("position").count);
    for (let n = 0; n < paint.length; ++n) paint[n] = surface.color >> 16 - 8 * (n % 3) & 255;
    geometry.setAttribute("paint", new THREE.BufferAttribute(paint, 3, true));
    return geometry;
  }
}
