// The answer: heads or tails, proven, and how far each input is from the other outcome.
import { askAside, dropAside } from "./aside.js";
import { byId, fill, later, make } from "./dom.js";
import { all, degrees, short, signed } from "./format.js";
import { unitOf } from "./quantity.js";
import { command, question, state } from "./state.js";

/** Shows the answer of the question "toss". */
export function showAnswer(answer) {
  const outcome = byId("outcome");
  outcome.className = answer.outcome;
  outcome.textContent = { heads: "Heads", tails: "Tails", undecided: "On its edge" }[answer.outcome];
  byId("proof").textContent = proof(answer);
  byId("cos-tilt").textContent = all(answer.cos_tilt);
  fill(byId("facts"), ...facts(answer).flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]));
  byId("command").textContent = command(answer.margin ? [] : ["--margin"]);
  stop();
  if (answer.margin) return showMargins(answer, answer.margin);
  showMargins(answer, null, "The nearest flip of this body is searched …");
  search(answer);
}

/** Shows the changes to the nearest flips, or `words` if there are none. */
function showMargins(answer, margin, words = "") {
  fill(byId("margins"), ...(margin ? rows(answer, margin) : []));
  byId("margins-table").hidden = !margin;
  byId("no-margins").textContent = words;
  byId("no-margins").hidden = !words;
}

function stop() {
  search.drop();
  dropAside();
}

/** Searches the nearest flips of a body with I1 ≠ I2, when the launch has stayed the same for a while. */
const search = later(250, (answer) =>
  askAside({ ask: "margins", scene: question() }, (margin) => showMargins(answer, margin), ({ message }) => showMargins(answer, null, message)));

/** Shows that there is no answer, and why. */
export function showRefusal(refusal) {
  byId("outcome").className = "refused";
  byId("outcome").textContent = "No answer";
  byId("proof").textContent = refusal.message;
  byId("cos-tilt").textContent = "–";
  byId("command").textContent = "–";
  fill(byId("facts"));
  stop();
  showMargins(null, null);
}

function proof({ certified, outcome, stage }) {
  if (certified) return outcome === "undecided" ? "proven: an exact tie" : `proven; ${DIGITS[stage] ?? stage}`;
  if (outcome === "undecided") return "not decided, as far as 832 digits can tell";
  return "not proven: the conversion of a unit may have changed it";
}

/** With how many digits a stage of the proof computes. */
const DIGITS = { f64: "16 digits were enough", "double-double": "it took 32 digits", "more digits": "it took 58 digits or more" };

function facts({ flight_time, apex, motion, coin, regime }) {
  const found = [["time of flight", `${short(flight_time, 5)} s`]];
  if (apex !== null) found.push(["apex", `${short(apex, 4)} m`]);
  if (motion) {
    const { cone_angle, precession_rate, least_cos_tilt, k } = motion;
    found.push(["ψ, between n and S", degrees(cone_angle, 5)], ["turns of n about S", turns(precession_rate * flight_time)]);
    found.push(["k = I3/I1", short(k, 5)], ["lowest cos θ", `${short(least_cos_tilt, 4)}: ${least_cos_tilt >= 0 ? "heads at every instant" : "below 0 it shows tails"}`]);
  } else {
    found.push(["I1, I2, I3", `${["i1", "i2", "i3"].map((name) => short(coin[name])).join(", ")} kg·m²`]);
    found.push(["motion", REGIMES[regime] ?? regime]);
  }
  return found;
}

const REGIMES = {
  AroundLargest: "S circles the axis of the largest moment",
  AroundSmallest: "S circles the axis of the smallest moment",
  Separatrix: "S approaches the axis of the middle moment for ever",
  Uniform: "even",
};

const turns = (phase) => short(phase / (2 * Math.PI), 4);

function rows({ input, flight_time }, margin) {
  const { rate, speed, gravity, tilt } = input;
  const { scene } = state;
  const none = flights(margin.time_range, flight_time);
  const given = speed === null
    ? [["T", unitOf("time", scene.time), margin.time, flight_time, none]]
    : [["v₀", unitOf("speed", scene.speed), margin.speed, speed, none], ["g", unitOf("acceleration", scene.gravity || "1"), margin.gravity, gravity, none]];
  const rates = ["ωx", "ωy", "ωz"].map((name, axis) => {
    const unit = unitOf("rate", scene.by === "rate" ? scene.rate[axis] : "1");
    return [name, unit, margin.rate[axis], rate[axis], `none within ±${short(margin.rate_range[axis] / unit.size, 4)} ${unit.name}`];
  });
  return [...given, ["tilt", unitOf("angle", scene.tilt || "1"), margin.tilt, tilt], ...rates].map((one) => row(...one));
}

/** The flights that were searched in vain: of a body with I1 ≠ I2, some times only. */
function flights(range, time) {
  if (!range || range[1] === null) return "none";
  const earliest = Math.max(0, time - range[0]);
  return `none of a flight of ${short(earliest)} to ${short(time + range[1])} s`;
}

/** A row in the unit that was typed; its `data-change` is in SI units. */
function row(name, { name: unit, size }, change, value, none = "none") {
  const cells = change === null
    ? [make("td", { colspan: 2, class: "none" }, none)]
    : [make("td", {}, `${signed(change / size, 5)} ${unit}`), make("td", {}, value === null ? "" : `${short((value + change) / size, 5)} ${unit}`)];
  const number = change === null ? "" : String(change);
  return make("tr", { "data-input": name, "data-change": number }, make("th", { scope: "row" }, name), ...cells);
}
