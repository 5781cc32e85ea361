// The pointer and the keys on the scene: dragging the tip of S turns the launch, dragging elsewhere turns the camera.
import { Raycaster, Sphere, Vector2, Vector3 } from "three";

/** How near to the tip of S a pointer takes hold of it (pixels). */
const REACH = 30;

export class Pointer {
  constructor(view, aimed) {
    Object.assign(this, { view, aimed, yaw: -0.9, pitch: 0.42, held: null });
    const { canvas } = view;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => (this.held = null));
    canvas.addEventListener("keydown", (event) => this.key(event));
    // A finger on S drags it; elsewhere it may scroll the page.
    canvas.addEventListener("touchstart", (event) => this.isOnTip(event.touches[0]) && event.preventDefault(), { passive: false });
  }

  /** Where a pointer is, from -1 to 1. */
  place({ clientX, clientY }) {
    const { left, top, width, height } = this.view.canvas.getBoundingClientRect();
    return new Vector2((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
  }

  isOnTip(event) {
    if (!this.view.momentum.group.visible) return false;
    const { width, height } = this.view.canvas.getBoundingClientRect();
    const tip = this.view.momentum.tip().project(this.view.camera);
    const at = this.place(event);
    return Math.hypot(((tip.x - at.x) * width) / 2, ((tip.y - at.y) * height) / 2) < REACH;
  }

  down(event) {
    this.held = this.isOnTip(event) ? "S" : "camera";
    this.last = [event.clientX, event.clientY];
    this.view.canvas.setPointerCapture(event.pointerId);
  }

  move(event) {
    this.view.canvas.style.cursor = this.held === "S" ? "grabbing" : this.isOnTip(event) ? "grab" : "move";
    if (this.held === "S") this.aimed(this.direction(event).toArray());
    if (this.held === "camera") {
      const [x, y] = this.last;
      this.turn(-(event.clientX - x) * 0.008, (event.clientY - y) * 0.008);
    }
    this.last = [event.clientX, event.clientY];
  }

  /** The direction of the point of the tip's sphere under the pointer, or of its nearest point. */
  direction(event) {
    const { camera, momentum } = this.view;
    const caster = new Raycaster();
    caster.setFromCamera(this.place(event), camera);
    const sphere = new Sphere(new Vector3(), momentum.length);
    const hit = caster.ray.intersectSphere(sphere, new Vector3());
    // A tip on the far side stays there, so that it does not jump when it is taken.
    const isFar = momentum.direction.dot(camera.position) < 0;
    if (!hit) return caster.ray.closestPointToPoint(sphere.center, new Vector3()).normalize();
    if (!isFar) return hit.normalize();
    const along = caster.ray.closestPointToPoint(sphere.center, new Vector3());
    return along.multiplyScalar(2).sub(hit).normalize();
  }

  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + pitch));
    this.view.render();
  }

  key(event) {
    const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    if (!turns) return;
    event.preventDefault();
    this.turn(...turns);
  }
}
