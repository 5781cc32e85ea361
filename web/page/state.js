// The state of the page: the scene, as the texts that a person typed, and what is shown of it. The address holds it, in the
// words of the command line's options.
import { write } from "./address.js";
import { PRESETS } from "./presets.js";

/** A scene of which nothing was said. */
export const BLANK = {
  body: "coin",
  coin: "paper",
  cylinder: "5.67g,12.13mm,1.75mm",
  moments: "5e-7,2.5e-7",
  by: "rate",
  rate: ["1", "1", "2.5"],
  turn: "38rev/s",
  psi: "60deg",
  flight: "speed",
  speed: "3",
  time: "0.6",
  gravity: "9.81",
  drop: "0",
  tilt: "0deg",
};

/** What is shown at first. */
const VIEW = {
  map: "rate_z",
  shade: "outcome",
  spread: "5%",
  solver: "all",
  scheme: "dop853",
  tolerance: "1e-9",
  step: "1ms",
  formulation: "momentum",
  pace: "0.1",
  people: "",
  lesson: "0",
  // How well an input is known.
  ...Object.fromEntries(["rate-x", "rate-y", "rate-z", "turn", "psi", "speed", "tilt"].map((name) => [`around-${name}`, ""])),
};

/** The scene and the view; they change by `change` alone. */
export const state = { scene: { ...BLANK }, view: { ...VIEW } };

const listeners = [];

/** Calls `listener` with what has changed, "scene" or "view", after each change. */
export const onChange = (listener) => listeners.push(listener);

/** Changes the scene or the view, tells everybody, and writes it into the address. */
export function change(changed, source = null) {
  take(changed, source);
  write(address());
}

/** The same, and leaves the address as it is. */
export function take({ scene, view }, source = null) {
  if (scene) state.scene = { ...state.scene, ...scene };
  if (view) state.view = { ...state.view, ...view };
  for (const listener of listeners) listener(scene ? "scene" : "view", source);
}

/** The scene as the library takes it: what does not apply or is blank is left out. */
export function question(scene = state.scene) {
  const asked = { [scene.body]: scene[scene.body] };
  if (scene.by === "rate") asked.rate = scene.rate;
  else Object.assign(asked, { turn: scene.turn, psi: scene.psi });
  if (scene.flight === "time") asked.time = scene.time;
  else {
    asked.speed = scene.speed;
    for (const name of ["gravity", "drop"]) if (isGiven(scene, name)) asked[name] = scene[name];
  }
  if (isGiven(scene, "tilt")) asked.tilt = scene.tilt;
  return asked;
}

/** What stands behind ± of the inputs that apply, by their names. */
export function around({ scene, view } = state) {
  const names = [...(scene.by === "rate" ? ["rate-x", "rate-y", "rate-z"] : ["turn", "psi"]), ...(scene.flight === "speed" ? ["speed"] : []), "tilt"];
  return Object.fromEntries(names.map((name) => [name, view[`around-${name}`].trim()]).filter(([, text]) => text !== ""));
}

/** Whether a text is neither blank nor what the library takes without it. */
const isGiven = (scene, name) => !["", BLANK[name]].includes(scene[name].trim());

/** The same toss on the command line, with further options. */
export function command(further = []) {
  const quoted = (text) => (/^[\w.,:+-]*$/.test(text) ? text : `'${text}'`);
  const options = Object.entries(question()).map(([name, value]) => `--${name} ${quoted(String(value))}`);
  return ["unfair-toss toss", ...options, ...further].join(" ");
}

/** The state as the part of the address behind the #. */
export function address() {
  const shown = Object.entries(state.view).filter(([name, value]) => value !== VIEW[name]);
  const pairs = [...Object.entries(question()), ...shown];
  // A comma that was typed into a rate is no comma between two.
  const text = (value) => (Array.isArray(value) ? value.map((part) => encodeURIComponent(part).replaceAll("%2F", "/")).join(",") : escaped(String(value)));
  return pairs.map(([name, value]) => `${name}=${text(value)}`).join("&");
}

const escaped = (text) => encodeURIComponent(text).replaceAll("%2F", "/").replaceAll("%2C", ",");

/** The values that a part of the view may have, where these are not numbers. */
export const CHOICES = { map: ["rate_z", "speed"], shade: ["outcome", "chance"], lesson: ["0", "1", "2", "3", "4", "5"] };

function decoded(name, text) {
  try {
    return decodeURIComponent(text);
  } catch {
    throw new Error(`the address has '${name}=${text}', in which a % does not begin an escaped letter`);
  }
}

/**
 * Reads an address. Gives what is `found`, a scene and a view, and what is wrong: `faults`, a sentence each. What is right
 * is kept. Nothing is found where nothing is right, or where two parts of a launch contradict each other.
 */
export function fromAddress(text) {
  const given = Object.create(null);
  const faults = [];
  for (const pair of text.split("&").filter(Boolean)) {
    try {
      readPair(given, ...pair.split(/=(.*)/s));
    } catch ({ message }) {
      faults.push(message);
    }
  }
  if (Object.keys(given).length === 0) return { found: null, faults };
  try {
    const preset = "preset" in given ? ofPreset(given.preset) : { scene: BLANK, view: VIEW };
    const view = { ...preset.view };
    for (const name of Object.keys(VIEW)) if (name in given) view[name] = given[name];
    return { found: { scene: sceneOf(given, preset.scene), view }, faults };
  } catch ({ message }) {
    return { found: null, faults: [...faults, message] };
  }
}

/** Puts what a pair of the address says into `given`, or throws an error that names what is wrong. */
function readPair(given, name, value = "") {
  if (name in given) throw new Error(`the address gives '${name}' twice`);
  const isKnown = name === "preset" || Object.hasOwn(BLANK, name) || Object.hasOwn(VIEW, name);
  if (!isKnown || ["body", "by", "flight"].includes(name)) throw new Error(`the address has '${name}', which is unknown`);
  let read = decoded(name, value);
  // Some programs escape the commas between the rates, too.
  if (name === "rate") {
    read = (value.includes(",") ? value : read).split(",").map((part) => decoded(name, part));
    if (read.length !== 3) throw new Error("the address has a rate that is not three numbers");
  }
  if (CHOICES[name] && !CHOICES[name].includes(read)) {
    throw new Error(`the address has '${name}=${read}': valid are ${CHOICES[name].join(", ")}`);
  }
  if (name === "pace" && !(Number(read) > 0 && Number(read) <= 1000)) {
    throw new Error(`the address has 'pace=${read}': valid is a number above 0 and at most 1000`);
  }
  given[name] = read;
}

/** The scene that `given` makes of another one. */
function sceneOf(given, begun) {
  const scene = { ...begun };
  for (const name of Object.keys(BLANK)) if (name in given) scene[name] = given[name];
  const one = (names, chosen) => {
    const found = names.filter((name) => name in given);
    if (found.length > 1) throw new Error(`the address gives ${found.join(" and ")}: only one of them can be used`);
    return found[0] ?? chosen;
  };
  scene.body = one(["coin", "cylinder", "moments"], begun.body);
  scene.flight = one(["speed", "time"], begun.flight);
  scene.by = one(["rate", "turn" in given ? "turn" : "psi"], begun.by).replace("psi", "turn");
  return scene;
}

/** The scene and the view of a preset. */
export function ofPreset(name) {
  const preset = PRESETS.find((preset) => preset.name === name);
  if (!preset) throw new Error(`the address has the preset '${name}', which is unknown`);
  return { scene: { ...BLANK, ...preset.scene }, view: { ...state.view, pace: String(preset.pace) } };
}
