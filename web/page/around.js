// P(heads) of a launch that is not known exactly: as well as the texts behind ± say.
import { ask } from "./library.js";
import { byId, later } from "./dom.js";
import { percent, withPoint } from "./format.js";
import { around, question, state } from "./state.js";

/** The line below the outcome. */
export class Around {
  constructor() {
    this.update = later(120, (asked) => this.compute(asked));
  }

  /** Shows the launch of the state; a line that was of another one is taken away at once. */
  show() {
    const given = around();
    const asked = JSON.stringify([question(), given]);
    if (asked === this.asked) return;
    this.clear();
    this.asked = asked;
    if (Object.keys(given).length > 0) this.update(given);
  }

  clear() {
    this.update.drop();
    this.asked = null;
    this.say("");
  }

  /** Shows a line, with the kind of its interval as a hint. */
  say(text, kind = "", isRefused = false) {
    byId("around").textContent = text;
    byId("around").title = kind;
    byId("around").hidden = !text;
    delete byId("around").dataset.probability;
    byId("around").classList.toggle("error", isRefused);
  }

  compute(given) {
    try {
      const scene = { tilt: state.scene.tilt.trim() || "0", ...question() };
      const { probability, interval, interval_kind: kind } = ask({ ask: "around", scene, around: given });
      const error = interval ? (interval[1] - interval[0]) / 2 : 5e-5;
      const range = interval ? `${percent(interval[0], error)} to ${percent(interval[1], error)}` : kind;
      this.say(probability === null ? "Of launches within ±, the share of heads is not known." : `Launches within ±: ${percent(probability, error)} heads (${range}).`, kind);
      byId("around").dataset.probability = String(probability);
    } catch ({ message }) {
      this.say(`±: ${withPoint(message, Object.values(given).join(" "))}`, "", true);
    }
  }
}
