// How fair such tosses are: P(heads) of long flights against ψ, the angle between n and S, with the launch on the curve; and
// the part of this flight that shows heads.
import { byId, fill, follow, svg } from "./dom.js";
import { degrees, percent, short, typed } from "./format.js";
import { column, flight } from "./flight.js";
import { POINT } from "./memory.js";
import { change } from "./state.js";

const QUARTER = Math.PI / 2;
/** The drawing's size, and the place of the curve in it. */
const SIZE = { width: 400, height: 190 };
const BOX = { left: 52, right: 388, top: 14, bottom: 150 };
/** A turn of the strip is at least a few pixels wide. */
const MOST_TURNS = 40;

/**
 * P(heads) of flights of many turns: the part of a turn in which cos θ = cos ψ cos Φ + sin ψ sin Φ cos φ is above 0. S is
 * Φ from the vertical, which is ψ if the coin is thrown flat, heads up.
 */
export function probability(psi, momentumTilt = psi) {
  const product = 1 / (Math.tan(psi) * Math.tan(momentumTilt));
  return 0.5 + Math.asin(Math.min(1, Math.max(-1, product))) / Math.PI;
}

/** Turns of n about S, or of a body with I1 ≠ I2 as many as it has at the rate of the launch. */
const turnsOf = ({ motion, input, flight_time }) =>
  ((motion?.precession_rate ?? Math.hypot(...input.rate)) * flight_time) / (2 * Math.PI);

/** What the curve says of this toss. */
function words(toss) {
  const { motion, input } = toss;
  const part = percent(probability(motion.cone_angle, motion.momentum_tilt), 1e-3);
  const found = [`ψ = ${degrees(motion.cone_angle)}: of such flights with many turns ${part} land heads.`];
  if (input.tilt !== 0) found.push("This one is tilted at launch, and lies beside the curve, which is for flat launches.");
  if (turnsOf(toss) < 3) found.push(`It turns ${short(turnsOf(toss), 2)} times only, too few for the curve to hold.`);
  return found.join(" ");
}

/** When the flight shows heads: the times at which it begins to show a side, as parts of the flight, and its end. */
function showing() {
  const [time, cosTilt] = [column(POINT.time), column(POINT.cosTilt)];
  const cuts = [{ at: 0, isHeads: cosTilt[0] > 0 }];
  let heads = 0;
  for (let index = 1; index < time.length; index++) {
    const [before, after] = [cosTilt[index - 1], cosTilt[index]];
    if (before > 0 === after > 0) continue;
    const at = (time[index - 1] + ((time[index] - time[index - 1]) * before) / (before - after)) / time.at(-1);
    if (before > 0) heads += at - cuts.at(-1).at;
    cuts.push({ at, isHeads: after > 0 });
  }
  if (cuts.at(-1).isHeads) heads += 1 - cuts.at(-1).at;
  cuts.push({ at: 1, isHeads: null });
  return { cuts, share: heads };
}

/** ψ and 180° - ψ are two senses of S about the same cone. */
const folded = (psi) => Math.min(psi, Math.PI - psi);

const across = (psi) => BOX.left + (psi / QUARTER) * (BOX.right - BOX.left);
const up = (part) => BOX.bottom - part * (BOX.bottom - BOX.top);

/** The curve, drawn through a point every quarter of a degree. */
function curve() {
  const points = Array.from({ length: 361 }, (_, index) => (index / 360) * QUARTER);
  return points.map((psi) => `${across(psi).toFixed(1)},${up(probability(psi)).toFixed(1)}`).join(" ");
}

/** The card with the curve. */
export class Fair {
  constructor() {
    const chart = svg("svg", { viewBox: `0 0 ${SIZE.width} ${SIZE.height}`, class: "fair-chart" });
    for (const part of [0, 0.25, 0.5, 0.75, 1]) {
      chart.append(svg("line", { x1: BOX.left, x2: BOX.right, y1: up(part), y2: up(part), class: "grid" }));
      chart.append(svg("text", { x: BOX.left - 8, y: up(part) + 4, "text-anchor": "end" }, `${100 * part} %`));
    }
    for (const angle of [0, 15, 30, 45, 60, 75, 90]) {
      chart.append(svg("text", { x: across((angle / 90) * QUARTER), y: BOX.bottom + 18, "text-anchor": "middle" }, `${angle}°`));
    }
    const name = svg("text", { x: (BOX.left + BOX.right) / 2, y: SIZE.height - 4, "text-anchor": "middle" }, "ψ, the angle between n and S");
    this.dot = svg("circle", { r: 8, class: "dot" });
    this.band = svg("rect", { y: BOX.top, height: BOX.bottom - BOX.top, width: 0, class: "band" });
    chart.append(name, this.band, svg("polyline", { points: curve(), class: "curve" }), this.dot);
    this.handle = byId("fair-curve");
    this.handle.append(chart);
    this.chart = chart;
    follow(this.handle, (event) => this.point(event));
    this.handle.addEventListener("keydown", (event) => this.step(event));
  }

  /** Shows the toss, or that the curve does not hold for its body. */
  show(toss) {
    const { motion } = toss;
    this.motion = motion;
    this.handle.hidden = !motion;
    byId("fair-words").textContent = motion ? words(toss) : "The curve is for bodies with I1 = I2: the normal of others moves on no cone.";
    this.strip(turnsOf(toss));
    if (!motion) return;
    const [psi, part] = [folded(motion.cone_angle), probability(motion.cone_angle, motion.momentum_tilt)];
    this.dot.setAttribute("cx", across(psi));
    this.dot.setAttribute("cy", up(part));
    const angle = ((psi / QUARTER) * 90).toFixed(1);
    for (const [name, value] of Object.entries({ min: 0, max: 90, now: angle, text: `ψ ${angle}°, ${percent(part, 1e-3)} heads` })) {
      this.handle.setAttribute(`aria-value${name}`, value);
    }
  }

  /** Shows no toss. */
  clear() {
    this.handle.hidden = true;
    for (const id of ["fair-words", "fair-share"]) byId(id).textContent = "";
    byId("fair-strip").toggleAttribute("hidden", true);
  }

  /** Shows the angles that explain people's counts, or none. */
  explain(angles) {
    const [from, to] = (angles ?? [0, 0]).map(across);
    this.band.setAttribute("x", from);
    this.band.setAttribute("width", to - from);
  }

  /** Draws when this flight shows heads, and when tails, unless its turns are too many to be seen. */
  strip(turns) {
    const isDrawn = flight.answer.flight_time > 0 && turns <= MOST_TURNS;
    // An SVG element has no property `hidden`.
    byId("fair-strip").toggleAttribute("hidden", !isDrawn);
    byId("fair-share").textContent = isDrawn ? "" : "It turns too often for its sides to be drawn.";
    if (!isDrawn) return;
    const { cuts, share } = showing();
    const shown = cuts.slice(0, -1).map(({ at, isHeads }, index) =>
      svg("rect", { x: at * SIZE.width, width: (cuts[index + 1].at - at) * SIZE.width, height: 16, class: isHeads ? "heads" : "tails" }));
    fill(byId("fair-strip"), ...shown);
    byId("fair-share").textContent = `It shows heads ${percent(share, 1e-3)} of this flight, which ends at the right.`;
  }

  /** Throws the coin with the ψ below the pointer. */
  point({ clientX }) {
    const { left, width } = this.chart.getBoundingClientRect();
    const place = ((clientX - left) / width) * SIZE.width;
    this.take(((place - BOX.left) / (BOX.right - BOX.left)) * 90);
  }

  step(event) {
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[event.key];
    if (!by) return;
    event.preventDefault();
    this.take((folded(this.motion.cone_angle) / QUARTER) * 90 + by);
  }

  /** Throws the coin with this ψ (degrees), and the turn that it has. */
  take(angle) {
    const psi = `${typed(Math.min(90, Math.max(0, angle)), 3)}deg`;
    const turn = `${typed(this.motion.precession_rate / (2 * Math.PI))}rev/s`;
    change({ scene: { by: "turn", turn, psi } }, "fair");
  }
}
