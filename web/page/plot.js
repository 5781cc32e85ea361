// Charts of lines on a canvas, in the colours of the theme.
import { fill, make } from "./dom.js";
import { ticks } from "./format.js";
import { colours } from "./theme.js";

/** The place of the lines in the canvas. */
const BOX = { left: 58, right: 12, top: 8, bottom: 26 };

/** A chart with a line for each of `series` ({ label, colour, dash, width }), in the element `into`. */
export class Plot {
  constructor(into, { title, logarithmic = false, height = 150, value = (number) => number.toPrecision(4), unit = " s", range = null }) {
    Object.assign(this, { into, title, logarithmic, height, value, unit, range, data: null });
    into.setAttribute("role", "img");
    into.setAttribute("aria-label", `chart: ${title}`);
    new ResizeObserver(() => this.data && this.paint()).observe(into);
  }

  /** Draws `data`: the times, then the values of each series, which has a gap at a value of null and none at undefined. */
  draw(data, series) {
    Object.assign(this, { data, series });
    if (!this.into.firstChild) this.build();
    this.paint();
    this.read(null);
  }

  build() {
    this.canvas = make("canvas", { onpointermove: (event) => this.read(event.offsetX), onpointerleave: () => this.read(null) });
    this.marker = make("div", { class: "marker" });
    this.legend = make("p", { class: "series" });
    this.into.append(make("p", { class: "plot-title" }, this.title), make("div", { class: "chart" }, this.canvas, this.marker), this.legend);
  }

  /** Shows nothing. */
  clear() {
    this.data = null;
    this.into.replaceChildren();
  }

  /** Draws a line at `time`. */
  mark(time) {
    if (this.data) this.marker.style.transform = `translateX(${this.across(time)}px)`;
  }

  /** Shows the values below the pointer in the legend, or none. */
  read(left) {
    const [times, ...columns] = this.data;
    const part = left === null ? NaN : (left - BOX.left) / (this.width - BOX.left - BOX.right);
    const wanted = times[0] + part * (times.at(-1) - times[0]);
    const index = times.reduce((best, time, index) => (Math.abs(time - wanted) < Math.abs(times[best] - wanted) ? index : best), 0);
    const keys = this.series.map(({ label, colour }, number) => {
      const found = part >= 0 && part <= 1 ? columns[number][index] : null;
      return make("span", {}, make("i", { style: `background: ${colour}` }), found == null ? label : `${label} ${this.value(found)}`);
    });
    if (part >= 0 && part <= 1) keys.unshift(make("span", {}, `${Number(times[index].toPrecision(3))}${this.unit}`));
    fill(this.legend, ...keys);
  }

  across(time) {
    const [first, last] = [this.data[0][0], this.data[0].at(-1)];
    return BOX.left + ((time - first) / (last - first || 1)) * (this.width - BOX.left - BOX.right);
  }

  paint() {
    this.width = Math.max(200, this.into.clientWidth);
    const { width, height, data: [times, ...columns] } = this;
    const ratio = devicePixelRatio || 1;
    Object.assign(this.canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    this.canvas.style.height = `${height}px`;
    const size = (value) => (this.logarithmic ? Math.log10(value) : value);
    const [lo, hi] = this.range ?? this.rangeOf(columns.flat().filter(Number.isFinite).map(size));
    const up = (value) => height - BOX.bottom - ((size(value) - lo) / (hi - lo)) * (height - BOX.top - BOX.bottom);
    const pen = this.canvas.getContext("2d");
    pen.scale(ratio, ratio);
    this.drawAxes(pen, [lo, hi], up);
    pen.beginPath();
    pen.rect(BOX.left, 0, width - BOX.left - BOX.right, height - BOX.bottom + 2);
    pen.clip();
    for (const [index, { colour, dash = [], width = 2 }] of this.series.entries()) {
      Object.assign(pen, { strokeStyle: colour, lineWidth: width, lineJoin: "round" });
      pen.setLineDash(dash);
      pen.beginPath();
      let isDown = false;
      for (const [place, value] of columns[index].entries()) {
        if (value === undefined) continue;
        if (value !== null) pen[isDown ? "lineTo" : "moveTo"](this.across(times[place]), up(value));
        isDown = value !== null;
      }
      pen.stroke();
    }
  }

  /** The range of an axis: whole powers of ten, or a little more than the values. */
  rangeOf(values) {
    const [lo, hi] = values.reduce(([lo, hi], value) => [Math.min(lo, value), Math.max(hi, value)], [Infinity, -Infinity]);
    if (this.logarithmic) return [Math.floor(lo), Math.max(Math.ceil(hi), Math.floor(lo) + 1)];
    const room = hi > lo ? 0.06 * (hi - lo) : Math.max(1, Math.abs(lo));
    return [lo - room, hi + room];
  }

  drawAxes(pen, [lo, hi], up) {
    const { text, grid } = colours();
    const { width, height, data: [times] } = this;
    Object.assign(pen, { fillStyle: text, strokeStyle: grid, lineWidth: 1, font: "12px system-ui, sans-serif", textAlign: "center", textBaseline: "top" });
    const line = (...places) => {
      pen.beginPath();
      pen.moveTo(places[0], places[1]);
      pen.lineTo(places[2], places[3]);
      pen.stroke();
    };
    for (const tick of ticks(times[0], times.at(-1) || 1, Math.max(2, width / 110))) {
      line(this.across(tick), BOX.top, this.across(tick), height - BOX.bottom);
      pen.fillText(`${Number(tick.toPrecision(6))}${this.unit}`, this.across(tick), height - BOX.bottom + 6);
    }
    Object.assign(pen, { textAlign: "right", textBaseline: "middle" });
    for (const tick of ticks(lo, hi, Math.max(2, height / 50))) {
      if (this.logarithmic && !Number.isInteger(tick)) continue;
      const at = up(this.logarithmic ? 10 ** tick : tick);
      line(BOX.left, at, width - BOX.right, at);
      pen.fillText(this.logarithmic ? power(tick) : Number(tick.toPrecision(6)), BOX.left - 6, at);
    }
  }
}

/** -9 as 10⁻⁹. */
const power = (exponent) => `10${String(exponent).replace("-", "⁻").replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit])}`;
