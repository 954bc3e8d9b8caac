// The canvas: one view for each mesh, beside each other, or above each other if the canvas is narrow.
class Views {
  constructor(canvas, number, orbit) {
    this.canvas = canvas;
    this.orbit = orbit;
    this.scenes = Array.from({ length: number }, () => new THREE.Scene());
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !hasSoftwareRendering() });
    this.renderer.setScissorTest(true);
    this.renderer.setClearColor(0xf4f3f0);
    this.frames = 0;
    this.motion = new Motion(this);
    this.isPending = false;
    this.redraw = this.redraw.bind(this);
    new ResizeObserver(this.redraw).observe(canvas.parentElement);
  }

  // Draws while the camera moves.
  move() {
    this.motion.start();
    this.redraw();
  }

  // Draws once, before the next frame of the screen.
  redraw() {
    if (this.isPending) return;
    this.isPending = true;
    requestAnimationFrame(() => {
      this.isPending = false;
      this.draw();
    });
  }

  get isStacked() {
    return this.canvas.clientWidth < this.canvas.clientHeight;
  }

  // Returns the rectangle of a view in the canvas, from the top left, in CSS pixels.
  rectangle(side) {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight, number = this.scenes.length;
    return this.isStacked ? { x: 0, y: side * height / number, width, height: height / number }
      : { x: side * width / number, y: 0, width: width / number, height };
  }

  draw() {
    this.motion.startFrame();
    const parent = this.canvas.parentElement, sharpest = 2;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, sharpest));
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== parent.clientWidth || size.y !== parent.clientHeight)
      this.renderer.setSize(parent.clientWidth, parent.clientHeight);
    this.scenes.forEach((scene, side) => {
      const { x, y, width, height } = this.rectangle(side);
      const bottom = this.canvas.clientHeight - y - height;
      this.renderer.setViewport(x, bottom, width, height);
      this.renderer.setScissor(x, bottom, width, height);
      this.orbit.apply(width / height);
      this.renderer.render(scene, this.orbit.camera);
    });
    ++this.frames;
  }

  // Returns the side at a place of the window, and the line of sight there.
  lineOfSight(clientX, clientY) {
    const canvas = this.canvas.getBoundingClientRect();
    const x = clientX - canvas.left, y = clientY - canvas.top;
    const side = this.scenes.findIndex((scene, n) => {
      const r = this.rectangle(n);
      return x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
    });
    return side < 0 ? null : this.lineInView(side, x - this.rectangle(side).x, y - this.rectangle(side).y);
  }

  // Returns the line of sight at a place of a view; by default, at its center.
  lineInView(side, x = this.rectangle(side).width / 2, y = this.rectangle(side).height / 2) {
    const { width, height } = this.rectangle(side);
    this.orbit.apply(width / height);
    const camera = this.orbit.camera, through = new THREE.Vector3(2 * x / width - 1, 1 - 2 * y / height, 0).unproject(camera);
    return { side, origin: camera.position.toArray(), direction: through.sub(camera.position).normalize().toArray() };
  }
}

// Returns whether the browser draws without a graphics card. Smooth edges would then be too slow.
function hasSoftwareRendering() {
  const context = document.createElement("canvas").getContext("webgl");
  const names = context && context.getExtension("WEBGL_debug_renderer_info");
  return Boolean(names) && /swiftshader|llvmpipe|software/i.test(context.getParameter(names.UNMASKED_RENDERER_WEBGL));
}
