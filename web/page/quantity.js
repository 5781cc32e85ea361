// An input for a quantity: a slider, and a text with a unit. The text is what counts; the library reads it.
import { ask } from "./library.js";
import { make } from "./dom.js";
import { niceAbove, typed, withPoint } from "./format.js";

const STEPS = 1000;

/** The unit that `text` has, a quantity of this kind: its name, and its size in SI units. */
export function unitOf(kind, text) {
  const { unit } = ask({ ask: "quantity", kind, text });
  return { name: unit, size: ask({ ask: "quantity", kind, text: `1${unit}` }).si };
}

/**
 * A labelled slider and text. `range` is the slider's range in SI units; `grows` lets it follow a larger value. `read`
 * gives the text of the state, `write` takes a new one. `around`, if given, reads and writes the text behind ±.
 */
export class QuantityInput {
  constructor({ id, label, kind, range, grows = true, read, write, around = null }) {
    Object.assign(this, { id, kind, range, least: range, grows, read, write, around });
    this.text = make("input", {
      id, type: "text", autocomplete: "off", spellcheck: "false", inputmode: "text", "aria-describedby": `${id}-error`,
      oninput: () => this.write(this.text.value), onchange: () => this.follow(),
    });
    this.slider = make("input", {
      type: "range", min: 0, max: STEPS, step: 1, "aria-label": `${label.text}, slider`,
      oninput: () => this.slide(), onchange: () => this.follow(),
    });
    this.unit = make("span", { class: "unit", "aria-hidden": "true" });
    this.error = make("p", { class: "error", id: `${id}-error`, hidden: true });
    const caption = make("label", { for: id, title: label.title ?? null });
    caption.innerHTML = label.html ?? label.text;
    this.element = make("div", { class: "quantity" }, caption, this.text, this.unit, around && this.aroundInput(label), this.slider, this.error);
  }

  /** The text behind ±: how well the quantity is known. */
  aroundInput({ text }) {
    this.deviation = make("input", {
      type: "text", id: `around-${this.id}`, autocomplete: "off", spellcheck: "false", placeholder: "0", "aria-label": `${text}, known to within`,
      oninput: () => this.around.write(this.deviation.value),
    });
    return make("span", { class: "around" }, make("span", { "aria-hidden": "true" }, "±"), this.deviation);
  }

  /** Shows the text of the state. */
  show() {
    this.showAround();
    if (document.activeElement !== this.text && this.text.value !== this.read()) this.text.value = this.read();
    this.follow(document.activeElement === this.slider);
  }

  /** Shows the text behind ±. */
  showAround() {
    if (this.deviation && document.activeElement !== this.deviation) this.deviation.value = this.around.read();
  }

  /** Marks the text as refused, with the reason; or as good, without one. */
  refuse(reason) {
    this.text.toggleAttribute("aria-invalid", Boolean(reason));
    if (reason) this.text.setAttribute("aria-invalid", "true");
    this.error.textContent = reason ? withPoint(reason, this.read()) : "";
    this.error.hidden = !reason;
  }

  /** The quantity as the library reads it; `null` if it cannot. */
  parsed() {
    try {
      return ask({ ask: "quantity", kind: this.kind, text: this.read() });
    } catch {
      return null;
    }
  }

  /** Moves the slider to the text, and lets its range follow if it is not held. */
  follow(isHeld = false) {
    const given = this.parsed();
    // A number that was typed with its unit shows it already.
    this.unit.textContent = given && !this.read().trim().endsWith(given.unit) ? given.unit : "";
    if (!given || !Number.isFinite(given.si)) return;
    if (this.grows && !isHeld) {
      const [lo, hi] = this.least;
      const far = Math.max(hi, given.si === 0 ? hi : niceAbove(1.5 * Math.abs(given.si)));
      this.range = [lo < 0 ? -far : lo, far];
    }
    const [lo, hi] = this.range;
    if (!isHeld) this.slider.value = Math.round(((given.si - lo) / (hi - lo)) * STEPS);
    this.slider.setAttribute("aria-valuetext", this.read());
  }

  /** Writes the slider's value in the unit that the text has. */
  slide() {
    const given = this.parsed();
    const [lo, hi] = this.range;
    const si = lo + ((hi - lo) * this.slider.value) / STEPS;
    const unit = given && given.value !== 0 ? given.si / given.value : 1;
    const named = this.read().match(/[^\d.eE+\s-].*$/)?.[0] ?? "";
    const size = given ? ask({ ask: "quantity", kind: this.kind, text: `1${named}` }).si : unit;
    this.text.value = `${typed(si / size, 3)}${given ? named : ""}`;
    this.write(this.text.value);
  }
}
