// Colours, in light and dark. Those of lines and arrows are of Okabe and Ito's palette, as in the charts of the command
// line, so that they differ for every kind of colour vision; the map's are cividis.

const LIGHT = {
  background: "#ffffff", text: "#1c1c1e", faint: "#8e8e93", grid: "#e3e3e6",
  normal: "#0072b2", face: "#d55e00", momentum: "#00805d", exact: "#000000",
};
const DARK = {
  background: "#16181c", text: "#f2f2f4", faint: "#8b8f98", grid: "#31353d",
  normal: "#56b4e9", face: "#e69f00", momentum: "#2fc79b", exact: "#f2f2f4",
};

/** Heads and tails on the coin and on the map: both ends of the palette cividis, and its middle. */
export const CIVIDIS = [[0, 34, 78], [124, 123, 120], [254, 232, 56]];

const KEY = "unfair-toss-theme";

const wanted = matchMedia("(prefers-color-scheme: dark)");
const listeners = [];
let own = remembered();

export const isDark = () => (own === null ? wanted.matches : own === "dark");

export const colours = () => (isDark() ? DARK : LIGHT);

/** Calls `listener` when the theme changes. */
export const onTheme = (listener) => listeners.push(listener);

/** The theme that was chosen on an earlier visit; `null` if there was none. */
function remembered() {
  try {
    const theme = localStorage.getItem(KEY);
    return ["light", "dark"].includes(theme) ? theme : null;
  } catch {
    return null;
  }
}

/** The other theme than the one that is shown. */
export function toggle() {
  own = isDark() ? "light" : "dark";
  try {
    localStorage.setItem(KEY, own);
  } catch {
    // A browser that keeps nothing shows this theme until the page is left.
  }
  apply();
}

export function apply() {
  document.documentElement.dataset.theme = isDark() ? "dark" : "light";
  for (const listener of listeners) listener();
}

wanted.addEventListener("change", apply);

/** A colour of the registry, as the theme shows it: what is too dark for a dark page is lightened. */
export function ofSolver(color) {
  if (!color) return colours().faint;
  const [red, green, blue] = color;
  if (!isDark()) return `rgb(${red},${green},${blue})`;
  const light = (part) => Math.round(part + (255 - part) * (red + green + blue === 0 ? 0.95 : 0.35));
  return `rgb(${light(red)},${light(green)},${light(blue)})`;
}

/** The colour of P(heads), from 0 to 1. */
export function ofProbability(part) {
  const [from, to, rest] = part < 0.5 ? [0, 1, 2 * part] : [1, 2, 2 * part - 1];
  return CIVIDIS[from].map((start, index) => Math.round(start + rest * (CIVIDIS[to][index] - start)));
}
