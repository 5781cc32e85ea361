// Charts by uPlot, in the colours of the theme.
import uPlot from "uplot";
import { colours } from "./theme.js";
import { make } from "./dom.js";

/** A chart with a line for each of `series` ({ label, colour, dash }), in the element `into`. */
export class Plot {
  constructor(into, { title, series, logarithmic = false, height = 150, value, unit = " s", across = "t", range = null }) {
    Object.assign(this, { into, title, series, logarithmic, height, value, unit, across, range, chart: null, data: null });
    into.setAttribute("role", "img");
    into.setAttribute("aria-label", `chart: ${title}`);
    new ResizeObserver(() => this.resize()).observe(into);
  }

  /** Draws `data`: the times, then the values of each series. */
  draw(data, series = this.series) {
    this.data = data;
    const isSame = this.chart && series.length === this.series.length && !this.isStale;
    this.series = series;
    if (isSame) this.chart.setData(data);
    else this.rebuild();
  }

  rebuild() {
    if (!this.data) return;
    this.chart?.destroy();
    this.isStale = false;
    this.into.replaceChildren();
    if (this.title) this.into.append(make("p", { class: "plot-title" }, this.title));
    this.chart = new uPlot(this.settings(), this.data, this.into);
    this.marker = make("div", { class: "marker" });
    this.chart.over.append(this.marker);
  }

  /** Shows nothing. */
  clear() {
    this.chart?.destroy();
    Object.assign(this, { chart: null, data: null });
    this.into.replaceChildren();
  }

  resize() {
    const width = this.into.clientWidth;
    if (this.chart && width > 40 && width !== this.chart.width) this.chart.setSize({ width, height: this.height });
  }

  /** Draws a line at `time`. It is no cursor of uPlot's, which would lay out its legend at every frame. */
  mark(time) {
    if (!this.chart) return;
    const left = this.chart.valToPos(time, "x");
    if (Number.isFinite(left)) this.marker.style.transform = `translateX(${left}px)`;
  }

  settings() {
    const { text, grid, faint } = colours();
    const axis = { stroke: text, grid: { stroke: grid, width: 1 }, ticks: { stroke: faint, width: 1 }, font: "12px system-ui, sans-serif" };
    const format = this.value ?? ((value) => value.toPrecision(4));
    // Away from the pointer there is no value.
    const shown = (format) => (_, value) => (value == null ? "" : format(value));
    return {
      width: Math.max(200, this.into.clientWidth),
      height: this.height,
      legend: { live: true },
      cursor: { y: false, drag: { x: false, y: false } },
      scales: { x: { time: false }, y: { distr: this.logarithmic ? 3 : 1, ...(this.range ? { range: this.range } : {}) } },
      axes: [
        { ...axis, size: 30, values: (_, ticks) => ticks.map((tick) => `${Number(tick.toPrecision(6))}${this.unit}`) },
        { ...axis, size: 58, ...(this.logarithmic ? { values: (_, ticks) => ticks.map(power) } : {}) },
      ],
      series: [
        { label: this.across, value: shown((value) => `${Number(value.toPrecision(3))}${this.unit}`) },
        ...this.series.map(({ label, colour, dash, width = 2 }) => ({
          label, stroke: colour, width, dash, points: { show: false }, value: shown(format),
        })),
      ],
    };
  }
}

/** 1e-9 as 10⁻⁹, and nothing at ticks that are not powers of ten. */
function power(tick) {
  if (tick == null || tick <= 0) return "";
  const exponent = Math.log10(tick);
  if (Math.abs(exponent - Math.round(exponent)) > 1e-6) return "";
  const digits = String(Math.round(exponent)).replace("-", "⁻").replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]);
  return `10${digits}`;
}
