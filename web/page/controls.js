// The launch: sliders and texts, the coin or body, presets.
import { byId, fill, make, options } from "./dom.js";
import { PRESETS } from "./presets.js";
import { QuantityInput } from "./quantity.js";
import { BLANK, change, ofPreset, state } from "./state.js";

const DEGREE = Math.PI / 180;
const sub = (letter, index) => ({ text: `${letter}${index}`, html: `${letter}<sub>${index}</sub>` });

/** The inputs of the scene that are one text each. */
const ONE = [
  { id: "turn", label: { text: "turn ωL", html: "turn ω<sub>L</sub>", title: "rate |S|/I1 at which n turns about S" }, kind: "rate", range: [0, 20] },
  { id: "psi", label: { text: "angle ψ", title: "between n and S" }, kind: "angle", range: [0, 180 * DEGREE], grows: false },
  { id: "speed", label: { text: "speed v0", html: "speed v<sub>0</sub>", title: "upward speed at launch" }, kind: "speed", range: [0, 6] },
  { id: "time", label: { text: "time T" }, kind: "time", range: [0, 2] },
  { id: "gravity", label: { text: "gravity g" }, kind: "acceleration", range: [1, 25] },
  { id: "drop", label: { text: "drop h", title: "height of the launch above the landing" }, kind: "length", range: [-1, 1] },
  { id: "tilt", label: { text: "tilt", title: "a turn about the lab's x axis, from horizontal with heads up" }, kind: "angle", range: [-180 * DEGREE, 180 * DEGREE], grows: false },
];

/** The input that a field of a refusal belongs to, by how its name begins. */
const FIELDS = [
  ["rate x", "rate-x"], ["rate y", "rate-y"], ["rate z", "rate-z"], ["rate", "rate-x"], ["turn", "turn"],
  ["psi", "psi"], ["speed", "speed"], ["time", "time"], ["gravity", "gravity"], ["drop", "drop"], ["tilt", "tilt"],
];

/** The controls of the launch. */
export class Controls {
  constructor(known) {
    this.inputs = new Map();
    for (const [index, axis] of ["x", "y", "z"].entries()) this.add(rateInput(index, axis));
    for (const one of ONE) {
      this.add(new QuantityInput({ ...one, around: around(one.id), read: () => state.scene[one.id], write: (text) => change({ scene: { [one.id]: text } }, one.id) }));
    }
    this.place();
    this.bodies(known);
    this.presets();
    this.choices("by", "rate");
    this.choices("flight", "speed");
  }

  add(input) {
    this.inputs.set(input.id, input);
  }

  place() {
    const of = (...ids) => ids.map((id) => this.inputs.get(id).element);
    fill(byId("rates"), ...of("rate-x", "rate-y", "rate-z"));
    fill(byId("precession"), ...of("turn", "psi"));
    fill(byId("thrown"), ...of("speed", "gravity", "drop"));
    fill(byId("given-time"), ...of("time"));
    fill(byId("attitude"), ...of("tilt"));
  }

  bodies(known) {
    const coins = known.coins.map(({ name, description }) => [name, `${name}: ${description}`]);
    const own = [["=cylinder", "a cylinder of your own"], ["=moments", "moments of inertia of your own"]];
    options(byId("coin"), [...coins, ...own], state.scene.coin);
    byId("coin").addEventListener("change", ({ target }) => {
      const own = target.value.match(/^=(.*)/);
      change({ scene: own ? { body: own[1] } : { body: "coin", coin: target.value } }, "coin");
    });
    byId("body").addEventListener("input", ({ target }) => change({ scene: { [state.scene.body]: target.value } }, "body"));
  }

  presets() {
    const buttons = PRESETS.map(({ name, title }) =>
      make("button", { type: "button", "data-preset": name, onclick: () => change(ofPreset(name), "preset") }, title));
    fill(byId("presets"), ...buttons);
    // On a phone, where five buttons would fill the screen.
    options(byId("preset"), [...PRESETS.map(({ name, title }) => [name, title]), ["", "A launch of your own"]], "");
    byId("preset").addEventListener("change", ({ target }) => target.value && change(ofPreset(target.value), "preset"));
  }

  choices(name, first) {
    for (const radio of document.querySelectorAll(`input[name=${name}]`)) {
      radio.addEventListener("change", () => change({ scene: { [name]: radio.value } }, name));
      radio.checked = radio.value === first;
    }
  }

  /** Shows the scene. */
  show() {
    const { scene } = state;
    for (const input of this.inputs.values()) input.show();
    for (const [name, boxes] of Object.entries({ by: { rate: "rates", turn: "precession" }, flight: { speed: "thrown", time: "given-time" } })) {
      for (const [value, box] of Object.entries(boxes)) byId(box).hidden = scene[name] !== value;
      for (const radio of document.querySelectorAll(`input[name=${name}]`)) radio.checked = radio.value === scene[name];
    }
    const isOwn = scene.body !== "coin";
    byId("coin").value = isOwn ? `=${scene.body}` : scene.coin;
    byId("own-body").hidden = !isOwn;
    if (isOwn && document.activeElement !== byId("body")) byId("body").value = scene[scene.body];
    byId("body-label").textContent = scene.body === "cylinder" ? "mass, radius, thickness" : "I1, I3 or I1, I2, I3 (kg·m²)";
    for (const button of byId("presets").children) {
      button.setAttribute("aria-pressed", String(isPreset(button.dataset.preset)));
    }
    const preset = PRESETS.find(({ name }) => isPreset(name));
    byId("preset").value = preset?.name ?? "";
    byId("preset-words").textContent = preset?.words ?? "A launch of your own.";
  }

  /** Shows what stands behind ±. */
  showAround() {
    for (const input of this.inputs.values()) input.showAround();
  }

  /** Shows a refusal beside the input that it is about, or nowhere without one. Gives whether there was a place for it. */
  refuse(refusal) {
    const id = refusal && FIELDS.find(([begins]) => refusal.field?.startsWith(begins))?.[1];
    for (const input of this.inputs.values()) input.refuse(input.id === id ? refusal.message : null);
    const isBody = Boolean(refusal) && !id && /^(coin|cylinder|moments|I[123]|mass|radius|thickness|inertia)/.test(refusal.field ?? "");
    byId("body").toggleAttribute("aria-invalid", isBody);
    const hasCommas = isBody && /\d,\d/.test(state.scene[state.scene.body]);
    const hint = hasCommas ? "; commas separate the numbers, and decimals take a point" : "";
    byId("body-error").textContent = isBody ? refusal.message + hint : "";
    byId("body-error").hidden = !isBody;
    return Boolean(id) || isBody;
  }
}

function rateInput(index, axis) {
  const write = (text) => change({ scene: { rate: state.scene.rate.with(index, text) } }, `rate-${axis}`);
  return new QuantityInput({
    id: `rate-${axis}`, label: sub("ω", axis), kind: "rate", range: [-5, 5], around: around(`rate-${axis}`), read: () => state.scene.rate[index], write,
  });
}

/** How the text behind ± of this input is read and written, if it has one. */
function around(id) {
  const name = `around-${id}`;
  return name in state.view ? { read: () => state.view[name], write: (text) => change({ view: { [name]: text } }, name) } : null;
}

/** Whether the scene is that of the preset. */
function isPreset(name) {
  const wanted = { ...BLANK, ...PRESETS.find((preset) => preset.name === name).scene };
  return JSON.stringify(wanted) === JSON.stringify({ ...wanted, ...state.scene });
}
