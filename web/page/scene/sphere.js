// The unit sphere about the body: its outline, the horizon, and the paths of n and of a vector in the face on it.
import { Group, Mesh, MeshBasicMaterial, SphereGeometry, CircleGeometry, DoubleSide } from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { POINT } from "../memory.js";

const CIRCLE = Array.from({ length: 121 }, (_, step) => (step * Math.PI) / 60);

/** A path on the sphere: all of it faint, and what has been flown. */
class Path {
  constructor(of) {
    this.of = of;
    this.whole = line(1.2, 0.3);
    this.flown = line(3, 1);
    this.lines = [this.whole, this.flown];
  }

  draw(trace) {
    const count = trace.length / POINT.length;
    const positions = new Float32Array(3 * count);
    for (let index = 0; index < count; index++) {
      for (let axis = 0; axis < 3; axis++) positions[3 * index + axis] = trace[index * POINT.length + this.of + axis];
    }
    for (const one of this.lines) {
      one.geometry.dispose();
      one.geometry = new LineGeometry().setPositions(positions);
    }
    this.segments = count - 1;
  }

  /** Shows the part from the launch on. */
  show(part) {
    this.flown.geometry.instanceCount = Math.max(0, Math.round(part * (this.segments ?? 0)));
  }

  colour(value) {
    for (const one of this.lines) one.material.color.set(value);
  }
}

function line(linewidth, opacity) {
  const made = new Line2(new LineGeometry(), new LineMaterial({ linewidth, transparent: opacity < 1, opacity }));
  made.frustumCulled = false;
  return made;
}

export class Sphere {
  constructor() {
    this.group = new Group();
    this.normal = new Path(POINT.normal);
    this.face = new Path(POINT.face);
    this.ball = new Mesh(new SphereGeometry(1, 48, 32), new MeshBasicMaterial({ transparent: true, opacity: 0.06, depthWrite: false }));
    this.plane = new Mesh(new CircleGeometry(1, 96), new MeshBasicMaterial({ transparent: true, opacity: 0.1, side: DoubleSide, depthWrite: false }));
    this.horizon = circle((angle) => [Math.cos(angle), Math.sin(angle), 0]);
    this.meridians = [circle((angle) => [Math.cos(angle), 0, Math.sin(angle)]), circle((angle) => [0, Math.cos(angle), Math.sin(angle)])];
    this.group.add(this.ball, this.plane, this.horizon, ...this.meridians, ...this.normal.lines, ...this.face.lines);
  }

  draw(trace) {
    this.normal.draw(trace);
    this.face.draw(trace);
  }

  show(part) {
    this.normal.show(part);
    this.face.show(part);
  }

  recolour({ normal, face, faint }) {
    this.normal.colour(normal);
    this.face.colour(face);
    for (const one of [this.ball, this.plane, this.horizon, ...this.meridians]) one.material.color.set(faint);
  }
}

function circle(at) {
  const made = line(1.2, 0.55);
  made.geometry.setPositions(CIRCLE.flatMap(at));
  return made;
}
