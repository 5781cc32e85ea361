// cos θ, the height and the body rates along the flight.
import { byId } from "./dom.js";
import { POINT } from "./memory.js";
import { column, flight } from "./flight.js";
import { Plot } from "./plot.js";
import { colours } from "./theme.js";

/** The charts of the flight. */
export class Traces {
  constructor() {
    const unit = (unit) => (value) => `${value.toPrecision(4)}${unit}`;
    this.plots = {
      tilt: new Plot(byId("plot-tilt"), { title: "cos θ: above 0 the coin shows heads", value: unit("") }),
      height: new Plot(byId("plot-height"), { title: "height above the launch", value: unit(" m"), height: 120 }),
      rates: new Plot(byId("plot-rates"), { title: "body rates", value: unit(" rad/s"), height: 150 }),
    };
  }

  /** Shows that there is no flight. */
  clear() {
    for (const plot of Object.values(this.plots)) plot.clear();
  }

  /** Draws the flight. */
  draw() {
    const { normal, face, momentum, faint } = colours();
    const time = column(POINT.time);
    const zero = time.map(() => 0);
    this.plots.tilt.draw([time, column(POINT.cosTilt), zero], [
      { label: "cos θ", colour: normal }, { label: "edge", colour: faint, dash: [4, 4], width: 1 },
    ]);
    byId("plot-height").hidden = flight.answer.apex === 0;
    if (flight.answer.apex > 0) this.plots.height.draw([time, column(POINT.height)], [{ label: "height", colour: momentum }]);
    this.plots.rates.draw([time, ...[0, 1, 2].map((axis) => column(POINT.rate + axis))], [
      { label: "ωx", colour: normal }, { label: "ωy", colour: face, dash: [8, 4] }, { label: "ωz", colour: momentum, dash: [2, 3] },
    ]);
  }

  /** Draws again, in other colours. */
  recolour() {
    if (flight.answer) this.draw();
  }

  mark(time) {
    for (const plot of Object.values(this.plots)) plot.mark(time);
  }
}
