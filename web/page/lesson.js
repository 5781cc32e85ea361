// A lesson of five steps, each of a sentence and a card of the page, to be stepped through in front of a class.
import { byId } from "./dom.js";
import { change, ofPreset, state } from "./state.js";

const STEPS = [
  { card: "flight", preset: "quarter", words: "Throw the coin. It leaves the hand flat, heads up, and its normal n goes round S, which stays as it is. Who bets on heads?" },
  { card: "fair", preset: "quarter", words: "The angle ψ between n and S decides. Drag the point to 90°, end over end: fair. Drag it to 60°. Where is heads certain?" },
  { card: "hand", preset: "quarter", words: "No hand is exact. Throw 100 times, and again: does the share come to 1/2? How many throws would show 50.8 %?" },
  { card: "people", preset: "quarter", words: "Flip real coins, always heads up, and type each person's counts. Is 1/2 inside the interval of all people? Then nothing is shown yet." },
  { card: "answer", preset: "cheated", words: "A cheat keeps ψ small: this coin never turns over, and lands as it left. What would you look for in a referee's hand?" },
];

/** The bar with the step, and its buttons. */
export class Lesson {
  constructor() {
    byId("lesson-start").addEventListener("click", () => this.go(1));
    byId("lesson-back").addEventListener("click", () => this.go(this.step - 1));
    byId("lesson-next").addEventListener("click", () => this.go(this.step + 1));
    byId("lesson-end").addEventListener("click", () => this.go(0));
  }

  get step() {
    return Number(state.view.lesson);
  }

  /** Goes to a step with its launch; beyond the last one the lesson ends. */
  go(step) {
    const next = step > STEPS.length ? 0 : step;
    const preset = next > 0 ? ofPreset(STEPS[next - 1].preset) : {};
    change({ scene: preset.scene, view: { ...preset.view, lesson: String(next) } }, "lesson");
    this.show();
    if (next > 0) byId(STEPS[next - 1].card).scrollIntoView({ block: "center" });
  }

  /** Shows the step of the view. */
  show() {
    byId("lesson").hidden = this.step === 0;
    document.querySelectorAll("main section").forEach((card) => card.classList.remove("spotlight"));
    if (this.step === 0) return;
    const { card, words } = STEPS[this.step - 1];
    byId("lesson-words").textContent = `${this.step} of ${STEPS.length}: ${words}`;
    byId("lesson-back").disabled = this.step === 1;
    byId("lesson-next").textContent = this.step === STEPS.length ? "Finish" : "Next";
    byId(card).classList.add("spotlight");
  }
}
