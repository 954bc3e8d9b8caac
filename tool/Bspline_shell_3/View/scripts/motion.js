// Draws coarse geometries while the camera moves, if the computer is slow.
class Motion {
  static slowestFrame = 1000 / 30; // milliseconds
  static rest = 250; // milliseconds after which the camera no longer moves
  static tolerated = 3; // slow frames before coarse ones: single frames are slow for other reasons

  constructor(views) {
    this.views = views;
    this.isMoving = false;
    this.slowFrames = 0;
    this.lastFrame = 0;
    this.bodies = []; // have a function setCoarse()
  }

  start() {
    if (!this.isMoving) this.lastFrame = 0;
    this.isMoving = true;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.isMoving = false;
      this.views.redraw();
    }, Motion.rest);
  }

  startFrame() {
    const now = performance.now();
    if (this.isMoving && this.lastFrame > 0 && now - this.lastFrame > Motion.slowestFrame) ++this.slowFrames;
    this.lastFrame = now;
    for (const body of this.bodies) body.setCoarse(this.isMoving && this.slowFrames >= Motion.tolerated);
  }
}
