// An arrow from the origin, with a letter at its tip.
import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshLambertMaterial, Quaternion, Vector3 } from "three";

const Y = new Vector3(0, 1, 0);

export class Arrow {
  constructor({ length, width, letter, labels }) {
    Object.assign(this, { length, group: new Group(), direction: new Vector3(0, 0, 1) });
    this.material = new MeshLambertMaterial();
    const head = 5 * width;
    const shaft = new Mesh(new CylinderGeometry(width, width, length - head, 12).translate(0, (length - head) / 2, 0), this.material);
    const tip = new Mesh(new ConeGeometry(2.4 * width, head, 20).translate(0, length - head / 2, 0), this.material);
    this.group.add(shaft, tip);
    this.label = document.createElement("span");
    this.label.textContent = letter;
    labels.append(this.label);
  }

  colour(value) {
    this.material.color.set(value);
    this.label.style.color = value;
  }

  /** Points to a unit vector; hidden without one. */
  point(direction) {
    this.group.visible = Boolean(direction);
    this.label.hidden = !direction;
    if (!direction) return;
    this.direction.fromArray(direction);
    this.group.quaternion.copy(new Quaternion().setFromUnitVectors(Y, this.direction));
  }

  /** Where its tip is. */
  tip() {
    return this.direction.clone().multiplyScalar(this.length);
  }

  /** Puts the letter beside the tip, in the pixels of a canvas. */
  letter(camera, width, height) {
    const at = this.direction.clone().multiplyScalar(this.length + 0.1).project(camera);
    this.label.style.transform = `translate(-50%, -50%) translate(${((at.x + 1) / 2) * width}px, ${((1 - at.y) / 2) * height}px)`;
  }
}
