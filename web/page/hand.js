// P(heads) for a hand that varies, and how precise a hand must be.
import { ask } from "./library.js";
import { byId, later } from "./dom.js";
import { percent, short, withPoint } from "./format.js";
import { Plot } from "./plot.js";
import { change, question, state } from "./state.js";
import { colours } from "./theme.js";

const THROWS = 100;

/** The hand. */
export class Hand {
  constructor() {
    const take = (text) => change({ view: { spread: text } }, "spread");
    byId("spread").addEventListener("input", ({ target }) => take(target.value));
    byId("spread-slider").addEventListener("input", ({ target }) => take(`${target.value}%`));
    byId("find-precision").addEventListener("click", () => this.find());
    byId("wanted").addEventListener("input", () => (byId("precision").textContent = ""));
    byId("throw-many").addEventListener("click", () => this.throwMany());
    this.plot = new Plot(byId("plot-throws"), { title: "share of heads after so many throws", unit: "", range: [0, 1], value: (value) => value.toFixed(3) });
    this.update = later(120, () => this.compute());
  }

  /** Shows the spread of the view. */
  show() {
    const { spread } = state.view;
    if (document.activeElement !== byId("spread")) byId("spread").value = spread;
    const number = Number.parseFloat(spread) * (spread.includes("%") ? 1 : 100);
    if (Number.isFinite(number) && document.activeElement !== byId("spread-slider")) byId("spread-slider").value = number;
    // What else of the view has changed makes no other probability.
    const asked = JSON.stringify([question(), spread]);
    if (asked === this.asked) return;
    this.clear();
    this.asked = asked;
    byId("chance").textContent = "…";
    this.update();
  }

  /** Shows no answer, and computes none. */
  clear() {
    this.update.drop();
    this.asked = null;
    this.say("–");
    byId("precision").textContent = "";
    this.refuse(null);
    this.forget();
  }

  /** Forgets the throws: they were of another hand. */
  forget() {
    this.thrown = "";
    byId("thrown-count").textContent = "";
    this.plot.clear();
  }

  /** Throws another hundred times, each with a seed of its own, and counts. */
  throwMany() {
    try {
      const seed = crypto.getRandomValues(new Uint32Array(1))[0];
      this.thrown += ask({ ask: "throws", scene: question(), spread: state.view.spread, number: THROWS, seed }).outcomes;
    } catch (refusal) {
      byId("thrown-count").textContent = refusal.message;
      return;
    }
    const of = (outcome) => [...this.thrown].filter((thrown) => thrown === outcome).length;
    const heads = of("H"), decided = heads + of("T");
    const share = decided ? percent(heads / decided, 5e-3) : "on their edge";
    byId("thrown-count").textContent = `${heads} heads in ${decided} throws: ${share}`;
    this.drawThrows();
  }

  drawThrows() {
    if (!this.thrown) return;
    let heads = 0, decided = 0;
    const shares = [...this.thrown].map((outcome) => {
      heads += outcome === "H" ? 1 : 0;
      decided += outcome === "-" ? 0 : 1;
      return decided ? heads / decided : null;
    });
    const probability = Number(byId("chance").dataset.probability ?? NaN);
    const { normal, faint } = colours();
    this.plot.draw([shares.map((_, index) => index + 1), shares, shares.map(() => (Number.isFinite(probability) ? probability : null))], [
      { label: "share of heads", colour: normal }, { label: "P(heads)", colour: faint, dash: [4, 4], width: 1 },
    ]);
  }

  /** Draws again, in other colours. */
  recolour() {
    this.drawThrows();
  }

  say(chance, note = "", probability = null) {
    byId("chance").textContent = chance;
    byId("chance-note").textContent = note;
    if (probability === null) delete byId("chance").dataset.probability;
    else byId("chance").dataset.probability = String(probability);
  }

  compute() {
    try {
      const { probability, interval, interval_kind, points } = ask({ ask: "hand", scene: question(), spread: state.view.spread });
      const error = interval ? (interval[1] - interval[0]) / 2 : 5e-5;
      const range = interval ? `${percent(interval[0], error)} to ${percent(interval[1], error)} (${interval_kind})` : interval_kind;
      this.say(probability === null ? "not known" : percent(probability, error), `${range}; ${points} launches, each at all its speeds`, probability);
      this.refuse(null);
    } catch (refusal) {
      this.say("–");
      this.refuse(refusal);
    }
  }

  refuse(refusal) {
    byId("spread").toggleAttribute("aria-invalid", refusal?.field === "spread");
    byId("spread-error").textContent = refusal ? withPoint(refusal.message, state.view.spread) : "";
    byId("spread-error").hidden = !refusal;
  }

  find() {
    const heads = byId("wanted").value;
    try {
      const found = ask({ ask: "precision", scene: question(), heads });
      const between =
        `; looked at ${found.looks} spreads from 1e-7 % on, with P(heads) ≥ ` +
        `${Math.floor(1e4 * found.at_least) / 1e4} in between`;
      const text = {
        up_to: `a spread of up to ${short(100 * found.spread, 3)} % of each rate and of the speed${between}`,
        at_least: `a spread of up to ${short(100 * found.spread, 3)} % at least, where the search ended${between}`,
        any: `any spread up to 12 %, the largest that is tried${between}`,
        toss_is_not_heads: "none: the toss itself does not land heads",
        below_smallest: "none that can be told from 0: the toss lands next to its edge",
      }[found.answer];
      byId("precision").textContent = text;
    } catch (refusal) {
      byId("precision").textContent = withPoint(refusal.message, heads);
    }
  }
}
