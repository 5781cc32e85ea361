// The scene in three dimensions: the body in flight, its normal n, a vector in its face, the angular momentum S with the
// cone of precession, and the paths on the sphere. The laboratory's z axis is up; the camera stays with the centre of mass.
import {
  AmbientLight, ConeGeometry, DirectionalLight, DoubleSide, Group, Mesh, MeshBasicMaterial, PerspectiveCamera, Quaternion,
  Scene, Vector3, WebGLRenderer,
} from "three";
import { FRAME } from "../memory.js";
import { Arrow } from "./arrow.js";
import { makeBody } from "./body.js";
import { Pointer } from "./pointer.js";
import { Sphere } from "./sphere.js";

class View {
  constructor(element, { aimed, colours }) {
    this.element = element;
    this.canvas = element.querySelector("canvas");
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    this.camera = new PerspectiveCamera(34, 1, 0.1, 20);
    this.camera.up.set(0, 0, 1);
    this.world = new Scene();
    this.light = new DirectionalLight("#ffffff", 2.2);
    this.world.add(new AmbientLight("#ffffff", 1.4), this.light);
    this.furnish(element.querySelector(".letters"));
    this.pointer = new Pointer(this, aimed);
    this.recolour(colours);
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
  }

  furnish(labels) {
    this.sphere = new Sphere();
    this.normal = new Arrow({ length: 1, width: 0.016, letter: "n", labels });
    this.face = new Arrow({ length: 1, width: 0.011, letter: "x", labels });
    this.momentum = new Arrow({ length: 1.28, width: 0.022, letter: "S", labels });
    this.cone = new Mesh(new ConeGeometry(), new MeshBasicMaterial({ transparent: true, opacity: 0.16, side: DoubleSide, depthWrite: false }));
    this.body = new Group();
    this.arrows = [this.normal, this.face, this.momentum];
    this.world.add(this.sphere.group, this.body, this.cone, ...this.arrows.map(({ group }) => group));
  }

  recolour(colours) {
    this.sphere.recolour(colours);
    this.normal.colour(colours.normal);
    this.face.colour(colours.face);
    this.momentum.colour(colours.momentum);
    this.cone.material.color.set(colours.momentum);
    this.render();
  }

  resize() {
    const { clientWidth, clientHeight } = this.element;
    if (!clientWidth || !clientHeight) return;
    // Kept, because asking for them would lay out the page at every frame.
    this.size = [clientWidth, clientHeight];
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    // All of the sphere and of S is seen, also where the page is narrow.
    this.far = 4.9 * Math.max(1, 1 / this.camera.aspect);
    this.camera.updateProjectionMatrix();
    this.render();
  }

  /** Takes a flight, and the answer about it. */
  launch(flight, toss) {
    const { momentum, moments } = flight.answer;
    const shape = moments.join();
    if (this.shape !== shape) {
      this.shape = shape;
      this.body.clear();
      this.body.add(makeBody(moments));
    }
    this.sphere.draw(flight.trace);
    this.momentum.point(momentum);
    this.shapeCone(momentum, toss.motion?.cone_angle);
  }

  /** The cone that n describes about S; none if the angle between them varies. */
  shapeCone(momentum, angle) {
    this.cone.visible = Boolean(momentum) && angle > 0.001 && angle < Math.PI - 0.001;
    if (!this.cone.visible) return;
    const [radius, height] = [Math.sin(angle), Math.cos(angle)];
    this.cone.geometry.dispose();
    // The tip of three's cone is up; it belongs to the origin, and the opening to S, or opposite of it beyond 90°.
    const geometry = new ConeGeometry(radius, Math.abs(height), 96, 1, true).translate(0, -Math.abs(height) / 2, 0);
    this.cone.geometry = height > 0 ? geometry.rotateX(Math.PI) : geometry;
    this.cone.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...momentum)));
  }

  /** Shows a frame, when so much of the flight has passed. Gives the time (ms) that three.js took to draw it. */
  at(frame, part) {
    const [w, x, y, z] = frame.subarray(FRAME.attitude, FRAME.attitude + 4);
    this.body.quaternion.set(x, y, z, w);
    this.normal.point(frame.subarray(FRAME.normal, FRAME.normal + 3));
    this.face.point(frame.subarray(FRAME.face, FRAME.face + 3));
    this.sphere.show(Number.isFinite(part) ? part : 1);
    return this.render();
  }

  /** The scene with its letters, on this ground, as a blob of PNG. */
  picture(ground) {
    this.render();
    const picture = document.createElement("canvas");
    Object.assign(picture, { width: this.canvas.width, height: this.canvas.height });
    const pen = picture.getContext("2d");
    pen.fillStyle = ground;
    pen.fillRect(0, 0, picture.width, picture.height);
    pen.drawImage(this.canvas, 0, 0);
    const box = this.canvas.getBoundingClientRect();
    const scale = picture.width / box.width;
    Object.assign(pen, { font: `italic 700 ${18 * scale}px Georgia, "DejaVu Serif", serif`, textAlign: "center", textBaseline: "middle" });
    for (const letter of this.element.querySelectorAll(".letters span")) {
      const { left, top, width, height } = letter.getBoundingClientRect();
      pen.fillStyle = getComputedStyle(letter).color;
      if (width > 0) pen.fillText(letter.textContent, (left + width / 2 - box.left) * scale, (top + height / 2 - box.top) * scale);
    }
    return new Promise((done) => picture.toBlob(done, "image/png"));
  }

  render() {
    const { yaw, pitch } = this.pointer ?? { yaw: -0.9, pitch: 0.42 };
    this.camera.position.set(Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch)).multiplyScalar(this.far ?? 4.9);
    this.camera.lookAt(0, 0, 0.05);
    this.camera.updateMatrixWorld();
    this.light.position.copy(this.camera.position).add(new Vector3(0, 0, 3));
    for (const arrow of this.arrows) arrow.letter(this.camera, ...(this.size ?? [1, 1]));
    const started = performance.now();
    this.renderer.render(this.world, this.camera);
    return performance.now() - started;
  }
}

window.makeScene = (element, options) => new View(element, options);
