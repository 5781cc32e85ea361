// The body to look at: a coin with heads and tails, or something with the moments of inertia that were given. Its z axis is
// the normal n of the heads side.
import {
  BoxGeometry, CanvasTexture, CircleGeometry, CylinderGeometry, DoubleSide, Group, Mesh, MeshLambertMaterial, SRGBColorSpace,
  TorusGeometry,
} from "three";

const HEADS = "#fee838";
const TAILS = "#00224e";
const EDGE = "#9a9a94";
const RADIUS = 0.62;

/** Thickness of a drawn coin, in radii: that of coins, or more where their moments are those of a longer cylinder. */
const THIN = 0.145;
const LONG = 12;

/** The body with these moments (kg m²). */
export function makeBody([x, y, z]) {
  if (x === y) return coin(z / x);
  // The sides of a cuboid with such moments, relative to the longest.
  const squares = [y + z - x, x + z - y, x + y - z].map((square) => Math.max(0, square));
  const longest = Math.sqrt(Math.max(...squares));
  const sides = squares.map((square) => Math.sqrt(square) / longest);
  return sides[2] < 0.15 && sides[1] > 2.5 * sides[0] ? racket() : cuboid(sides);
}

/** A uniform cylinder with the ratio k = I3/I1 of its moments: k = 6 r²/(3 r² + h²). */
function coin(k) {
  const body = new Group();
  const thickness = Math.min(LONG, Math.max(THIN, Math.sqrt(Math.max(0, 6 / k - 3))));
  const radius = RADIUS / Math.max(1, thickness / 2);
  const geometry = new CylinderGeometry(radius, radius, radius * thickness, 72).rotateX(Math.PI / 2);
  const side = new MeshLambertMaterial({ color: EDGE });
  body.add(new Mesh(geometry, [side, face("H", HEADS, TAILS), face("T", TAILS, HEADS)]));
  return body;
}

/** A face with a letter and a rim. */
function face(letter, ground, ink) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 256;
  const pen = canvas.getContext("2d");
  Object.assign(pen, { fillStyle: ground, strokeStyle: ink, lineWidth: 8, textAlign: "center", textBaseline: "middle" });
  pen.fillRect(0, 0, 256, 256);
  pen.beginPath();
  pen.arc(128, 128, 108, 0, 2 * Math.PI);
  pen.stroke();
  Object.assign(pen, { fillStyle: ink, font: "bold 140px system-ui, sans-serif" });
  pen.translate(128, 136);
  pen.rotate(Math.PI / 2);
  pen.fillText(letter, 0, 0);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  return new MeshLambertMaterial({ map });
}

function cuboid(sides) {
  const [x, y, z] = sides.map((side) => Math.max(0.07, 1.5 * side));
  const of = (color) => new MeshLambertMaterial({ color });
  const [side, heads, tails] = [of(EDGE), of(HEADS), of(TAILS)];
  const body = new Group();
  body.add(new Mesh(new BoxGeometry(x, y, z), [side, side, side, side, heads, tails]));
  return body;
}

/** A flat body with its long axis along y, as a racket: one side of its strings is heads. */
function racket() {
  const body = new Group();
  const frame = new MeshLambertMaterial({ color: EDGE });
  const head = new Mesh(new TorusGeometry(0.36, 0.035, 12, 60), frame);
  head.scale.set(1, 1.3, 1);
  const strings = [[0.012, HEADS, 0], [-0.012, TAILS, Math.PI]].map(([z, color, turn]) => {
    const side = new Mesh(new CircleGeometry(0.36, 48), new MeshLambertMaterial({ color, side: DoubleSide }));
    side.scale.set(1, 1.3, 1);
    side.rotation.y = turn;
    side.position.z = z;
    return side;
  });
  const handle = new Mesh(new CylinderGeometry(0.045, 0.055, 0.62, 16), frame);
  handle.position.y = -0.77;
  body.add(head, ...strings, handle);
  for (const part of body.children) part.position.y += 0.2;
  return body;
}
