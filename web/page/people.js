// People's own flips: the counts as they were typed, and what they say.
import { ask } from "./library.js";
import { byId, fill, later, svg } from "./dom.js";
import { degrees, short, signed } from "./format.js";
import { change, state } from "./state.js";

/** The drawing: its width, the place of its shares, and the height of a row. */
const WIDTH = 400;
const BOX = { left: 112, right: 380 };
const ROW = 18;
/** Longer names are cut. */
const LONGEST_NAME = 14;
/** Rows are drawn of so many people; the numbers are of all. */
const MOST_ROWS = 60;

/** The card. `explains` is told the angles ψ that explain the counts, or null. */
export class People {
  constructor(explains) {
    this.explains = explains;
    byId("people-counts").addEventListener("input", ({ target }) => change({ view: { people: target.value } }, "people"));
    this.update = later(200, () => this.compute());
  }

  /** Shows the counts of the view. */
  show() {
    const text = state.view.people;
    if (text === this.text) return;
    this.text = text;
    if (document.activeElement !== byId("people-counts")) byId("people-counts").value = text;
    this.update();
  }

  compute() {
    try {
      this.say(this.text.trim() ? ask({ ask: "people", text: this.text }) : null);
      this.refuse(null);
    } catch (refusal) {
      this.say(null);
      this.refuse(refusal);
    }
  }

  refuse(refusal) {
    byId("people-counts").toggleAttribute("aria-invalid", refusal !== null);
    byId("people-error").textContent = refusal?.message ?? "";
    byId("people-error").hidden = refusal === null;
  }

  say(found) {
    this.explains(found?.cone_angle_interval ?? null);
    fill(byId("people-plot"), found && plot(found));
    byId("people-words").textContent = found ? words(found) : "";
  }
}

const range = ([lo, hi], digits = 3) => `${lo.toFixed(digits)} to ${hi.toFixed(digits)}`.replaceAll("-", "\u2212");

function words({ same, tosses, share, people, absent, mean_over_people, interval, spread, next_person: next, practice, cone_angle, cone_angle_interval: ends }) {
  const said = [`${same} of ${tosses} flips landed on the side that had been up: ${short(share, 3)}.`];
  if (people.length > 1) said.push(`Over people like these the mean is ${short(mean_over_people, 3)}, from ${range(interval)} (95 %).`);
  else said.push(`The probability is from ${range(interval)} (95 %), for this hand.`);
  if (spread) said.push(spread.p_value < 0.05 ? "These people differ by more than chance." : "These people do not differ by more than chance.");
  if (next) said.push(`A next person's probability is from ${range(next)} (95 %).`);
  if (practice) said.push(`From the earlier half of the flips to the later the share changes by ${signed(practice.change, 2)}, from ${range(practice.interval)} (95 %).`);
  if (ends) said.push(`ψ = ${degrees(cone_angle, 3)}, from ${degrees(ends[0], 3)} to ${degrees(ends[1], 3)}, explains it: the band in the curve.`);
  else said.push("No ψ explains a share below 1/2.");
  if (absent > 0) said.push(`${absent} without a flip: passed over.`);
  if (people.length > MOST_ROWS) said.push(`The first ${MOST_ROWS} of ${people.length} people are drawn.`);
  return said.join(" ");
}

/** The forest plot: a row for each of several people, and below them all together. */
function plot(found) {
  const people = found.people.slice(0, MOST_ROWS).map(({ person: name, probability: at, interval }) => ({ name, at, interval, kind: "person" }));
  const all = [
    { name: "these flips", at: found.share, interval: found.these_flips, kind: "flips" },
    people.length > 1 && { name: "all people", at: found.mean_over_people, interval: found.interval, kind: "all" },
    found.next_person && { name: "next person", at: null, interval: found.next_person, kind: "next" },
  ];
  const lines = [...people, ...all.filter(Boolean)];
  const lo = Math.min(0.5, ...lines.map(({ interval }) => interval[0]));
  const hi = Math.max(0.5, ...lines.map(({ interval }) => interval[1]));
  const across = (share) => BOX.left + ((share - lo) / (hi - lo)) * (BOX.right - BOX.left);
  const height = ROW * lines.length + 26;
  const label = `The shares of ${people.length || 1} people with their 95 % intervals, and those of all`;
  const chart = svg("svg", { viewBox: `0 0 ${WIDTH} ${height}`, class: "forest", role: "img", "aria-label": label });
  chart.append(svg("line", { x1: across(0.5), x2: across(0.5), y1: 0, y2: height - 22, class: "fair" }));
  for (const [index, { name, at, interval, kind }] of lines.entries()) {
    const y = ROW * index + ROW / 2;
    const text = name.length > LONGEST_NAME ? `${name.slice(0, LONGEST_NAME)}…` : name;
    chart.append(svg("text", { x: BOX.left - 8, y: y + 4, "text-anchor": "end" }, text));
    chart.append(svg("line", { x1: across(interval[0]), x2: across(interval[1]), y1: y, y2: y, class: kind }));
    if (at !== null) chart.append(svg("circle", { cx: across(at), cy: y, r: 3.5, class: kind }));
  }
  for (const share of [lo, 0.5, hi]) {
    const isHidden = share !== 0.5 && Math.abs(across(share) - across(0.5)) < 40;
    if (!isHidden) chart.append(svg("text", { x: across(share), y: height - 6, "text-anchor": "middle" }, share.toFixed(2)));
  }
  return chart;
}
