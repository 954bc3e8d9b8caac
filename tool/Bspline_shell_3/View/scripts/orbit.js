// The camera of both views: it turns around a point.
class Orbit {
  static angle = 30; // vertical angle of view, in degrees

  constructor(radius) {
    this.radius = radius;
    this.camera = new THREE.PerspectiveCamera(Orbit.angle, 1, 1, 1000);
    this.target = new THREE.Vector3();
    this.rotation = new THREE.Quaternion();
    this.reset();
  }

  // Shows everything, from above on the right.
  reset() {
    this.target.set(0, 0, 0);
    this.distance = 1.05 * this.radius / Math.sin(Orbit.angle / 2 * Math.PI / 180);
    this.rotation.setFromEuler(new THREE.Euler(-0.35, 0.5, 0, "YXZ"));
  }

  // Turns by angles around the vertical and the horizontal axis of the screen.
  turn(horizontal, vertical) {
    const axis = (x, y) => new THREE.Vector3(x, y, 0);
    this.rotation.multiply(new THREE.Quaternion().setFromAxisAngle(axis(0, 1), -horizontal));
    this.rotation.multiply(new THREE.Quaternion().setFromAxisAngle(axis(1, 0), -vertical)).normalize();
  }

  // Moves the target by fractions of the height of the view.
  move(right, up) {
    const height = 2 * this.distance * Math.tan(Orbit.angle / 2 * Math.PI / 180);
    this.target.add(new THREE.Vector3(right * height, up * height, 0).applyQuaternion(this.rotation));
  }

  zoom(factor) {
    const closest = 1e-4, farthest = 10; // relative to the radius
    this.distance = Math.min(Math.max(this.distance / factor, closest * this.radius), farthest * this.radius);
  }

  // Turns around a point, and shows a part of this radius.
  focus(point, radius) {
    this.target.set(...point);
    this.distance = radius / Math.sin(Orbit.angle / 2 * Math.PI / 180);
  }

  // Looks from the side at a direction, which becomes upright on the screen.
  faceSideways(direction) {
    const elevation = 25 * Math.PI / 180, up = new THREE.Vector3(...direction).normalize();
    const levelOf = (x, y, z) => new THREE.Vector3(x, y, z).applyQuaternion(this.rotation).projectOnPlane(up);
    const towardsCamera = levelOf(0, 0, 1), level = towardsCamera.length() > 0.5 ? towardsCamera : levelOf(0, -1, 0);
    const back = level.normalize().multiplyScalar(Math.cos(elevation)).addScaledVector(up, Math.sin(elevation));
    const right = new THREE.Vector3().crossVectors(up, back).normalize();
    this.rotation.setFromRotationMatrix(new THREE.Matrix4().makeBasis(right, new THREE.Vector3().crossVectors(back, right), back));
  }

  // Sets the camera for a view with a ratio of width and height. In narrow views, the width counts.
  apply(aspect) {
    const distance = this.distance / Math.min(aspect, 1), reach = this.radius + this.target.length();
    this.camera.position.set(0, 0, distance).applyQuaternion(this.rotation).add(this.target);
    this.camera.quaternion.copy(this.rotation);
    this.camera.aspect = aspect;
    this.camera.near = Math.max(distance - reach, 0.01 * distance);
    this.camera.far = distance + reach;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }
}
