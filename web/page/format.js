// Numbers as texts.

const MINUS = "\u2212";

/** All digits that tell the number from its neighbours, as the command line prints them in JSON. */
export const all = (number) => String(number).replace("-", MINUS);

/** `digits` significant digits, with a typographic minus and without an exponent where it is not needed. */
export function short(number, digits = 4) {
  if (number === 0) return "0";
  const size = Math.abs(number);
  const text = size >= 1e-3 && size < 1e6 ? trimmed(number.toPrecision(digits)) : number.toExponential(digits - 1);
  return text.replace("-", MINUS).replace("e-", `e${MINUS}`);
}

/** The same with its sign. */
export const signed = (number, digits = 4) => (number > 0 ? "+" : "") + short(number, digits);

function trimmed(text) {
  const plain = text.includes("e") ? String(Number(text)) : text;
  return plain.includes(".") ? plain.replace(/\.?0+$/, "") : plain;
}

/** A number for an input: as short as four digits allow, with a plain minus. */
export const typed = (number, digits = 4) => String(Number(number.toPrecision(digits)));

/** The reason why `text` is refused, with the same text by a decimal point if it has one decimal comma. */
export function withPoint(reason, text) {
  const hasComma = /^[^,]*\d,\d[^,]*$/.test(text);
  return hasComma ? `${reason}; decimals take a point: ${text.trim().replace(",", ".")}` : reason;
}

/** An angle in degrees. */
export const degrees = (radians, digits = 4) => `${short((radians * 180) / Math.PI, digits)}°`;

/** A probability in percent, with as many digits as `error` leaves. */
export function percent(part, error = 5e-5) {
  const digits = Math.max(0, Math.min(6, Math.ceil(-Math.log10(Math.max(error, 1e-9) * 100))));
  return `${(100 * part).toFixed(digits)} %`;
}

/** A time in the unit that suits it. */
export function duration(nanoseconds) {
  for (const [unit, size] of [["ns", 1], ["µs", 1e3], ["ms", 1e6]]) {
    if (nanoseconds < 1000 * size) return `${short(nanoseconds / size, 3)} ${unit}`;
  }
  return `${short(nanoseconds / 1e9, 3)} s`;
}

/** Steps of an axis from `lo` to `hi` at which a person would put its ticks. */
export function ticks(lo, hi, about = 5) {
  const rough = (hi - lo) / about;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((part) => part * power).find((step) => step >= rough * 0.999);
  const found = [];
  for (let index = Math.ceil(lo / step - 1e-9); index * step <= hi + 1e-9 * step; index++) found.push(index * step);
  return found.map((tick) => Number(tick.toPrecision(12)));
}

/** The number of the list 1, 2, 5, 10, … at or above `number`. */
export function niceAbove(number) {
  const power = 10 ** Math.floor(Math.log10(number));
  return [1, 2, 5, 10].map((part) => part * power).find((nice) => nice >= number * 0.999);
}
