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

/** The most decimal places of a percentage. */
const MOST_PLACES = 12;

/**
 * A probability in percent, with as many digits as `error` leaves, and with more where it would be shown as 0 or 100
 * without being certain.
 */
export function percent(part, error = 5e-5) {
  const least = Math.max(0, Math.min(6, Math.ceil(-Math.log10(Math.max(error, 1e-9) * 100))));
  if (part === 0 || part === 1) return `${fixed(part, 2, least)} %`;
  for (let places = least; places <= MOST_PLACES; places++) {
    const shown = fixed(part, 2, places);
    if (Number(shown) !== 0 && Number(shown) !== 100) return `${shown} %`;
  }
  const end = 10n ** BigInt(MOST_PLACES);
  return part < 0.5 ? `below ${point(1n, MOST_PLACES)} %` : `above ${point(100n * end - 1n, MOST_PLACES)} %`;
}

/** The decimal of a number ≥ 0 times 10^`power`, rounded once, half up, to so many decimal places. */
function fixed(number, power, places) {
  const [mantissa, exponent] = number.toExponential().split("e");
  const [whole, fraction = ""] = mantissa.split(".");
  const shift = Number(exponent) - fraction.length + power + places;
  const digits = BigInt(whole + fraction);
  const unit = 10n ** BigInt(Math.abs(shift));
  return point(shift >= 0 ? digits * unit : (2n * digits + unit) / (2n * unit), places);
}

/** A whole number of units of the last decimal place. */
function point(units, places) {
  const text = String(units).padStart(places + 1, "0");
  return places === 0 ? text : `${text.slice(0, -places)}.${text.slice(-places)}`;
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
