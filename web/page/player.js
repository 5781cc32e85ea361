// Play, pause, and the time of the flight.
import { byId, options } from "./dom.js";
import { short } from "./format.js";
import { flight } from "./flight.js";
import { change, state } from "./state.js";

const PACES = [["1", "true pace"], ["0.25", "¼ of it"], ["0.1", "1/10"], ["0.03", "1/33"], ["0.01", "1/100"]];
const STEPS = 1000;

/** How long the landing is looked at before the next throw (s of the clock). */
const PAUSE = 1.2;

/** The player. It calls `show` after each change of the time, and counts what these calls take. */
export class Player {
  constructor(show) {
    this.show = show;
    this.isPlaying = false;
    this.landed = 0;
    this.frames = [];
    options(byId("pace"), PACES, state.view.pace);
    byId("pace").addEventListener("change", ({ target }) => change({ view: { pace: target.value } }, "pace"));
    byId("play").addEventListener("click", () => (this.isPlaying ? this.pause() : this.play()));
    byId("clock").addEventListener("input", ({ target }) => {
      this.pause();
      if (!flight.answer) return;
      this.at((target.value / STEPS) * flight.answer.flight_time);
    });
  }

  play() {
    if (!flight.answer) return;
    this.isPlaying = true;
    if (flight.time >= flight.answer.flight_time) flight.time = 0;
    this.label();
    this.last = performance.now();
    requestAnimationFrame((now) => this.step(now));
  }

  pause() {
    this.isPlaying = false;
    this.label();
  }

  /** Shows that there is no flight. */
  clear() {
    this.pause();
    byId("clock").value = 0;
    byId("clock").removeAttribute("aria-valuetext");
    byId("clock-text").textContent = "–";
  }

  label() {
    byId("play").textContent = this.isPlaying ? "Pause" : "Throw";
    byId("play").setAttribute("aria-pressed", String(this.isPlaying));
  }

  step(now) {
    if (!this.isPlaying) return;
    const passed = Math.max(0, Math.min(0.1, (now - this.last) / 1000));
    this.last = now;
    const end = flight.answer.flight_time;
    if (flight.time >= end) {
      this.landed += passed;
      if (this.landed > PAUSE) [this.landed, flight.time] = [0, 0];
    } else {
      flight.time = Math.min(end, flight.time + passed * Number(state.view.pace));
    }
    this.at(flight.time);
    requestAnimationFrame((next) => this.step(next));
  }

  /** Looks at the flight at `time` (s). */
  at(time) {
    const started = performance.now();
    const end = flight.answer.flight_time;
    flight.time = Math.max(0, Math.min(end, time));
    byId("clock").value = end > 0 ? Math.round((flight.time / end) * STEPS) : 0;
    const text = `${short(flight.time, 3)} s of ${short(end, 3)} s`;
    byId("clock").setAttribute("aria-valuetext", text);
    byId("clock-text").textContent = text;
    const drawn = this.show() ?? 0;
    this.frames.push(performance.now() - started - drawn);
    if (this.frames.length > 600) this.frames.shift();
  }

  /** Shows the view, whose pace may have changed. */
  refresh() {
    if (!PACES.some(([value]) => value === state.view.pace)) options(byId("pace"), [...PACES, [state.view.pace, state.view.pace]], state.view.pace);
    byId("pace").value = state.view.pace;
  }
}
