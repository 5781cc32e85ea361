// The map: proven outcomes, or P(heads), over ωx and a second input, with the lines that have a formula. The launch is a
// point in it, which can be dragged and moved by the arrow keys.
import { ask, cells } from "./library.js";
import { byId, follow, onceAFrame } from "./dom.js";
import { niceAbove, short, ticks, typed } from "./format.js";
import { change, question, state } from "./state.js";
import { colours, ofProbability } from "./theme.js";

const SIZE = 200; // columns and rows: 40 000 outcomes
const COARSE = 60; // of a body whose outcomes cost more
const MARGIN = { left: 58, right: 14, top: 12, bottom: 40 };
const ROWS_A_TURN = 10; // rows that are computed before the page may do something else

/** The map on the canvas `#map`. */
export class MapView {
  constructor() {
    this.canvas = byId("map");
    this.image = document.createElement("canvas");
    this.grid = null;
    this.timing = [];
    this.move = onceAFrame((x, up) => this.launchAt(x, up));
    follow(this.canvas, (event) => this.point(event), () => this.release());
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    for (const [id, name] of [["map-over", "map"], ["map-shade", "shade"]]) {
      byId(id).addEventListener("change", ({ target }) => change({ view: { [name]: target.value } }, "map"));
    }
    new ResizeObserver(() => this.draw()).observe(this.canvas.parentElement);
  }

  /** Computes the map of a toss, and draws it. */
  update(toss) {
    byId("map-over").value = state.view.map;
    byId("map-shade").value = state.view.shade;
    this.toss = toss;
    this.grid = this.gridOf(toss);
    const turn = (this.turn = (this.turn ?? 0) + 1);
    try {
      this.lines = ask({ ask: "lines", scene: question(), grid: this.grid });
      this.say("");
      const isQuick = toss.motion && state.view.shade === "outcome";
      if (isQuick) this.compute([0, this.grid.rows]);
      else this.inParts(turn, 0);
    } catch (refusal) {
      this.clear();
      this.say(refusal.message);
    }
    this.draw();
  }

  /** Shows that there is no map. */
  clear() {
    this.turn = (this.turn ?? 0) + 1;
    this.grid = null;
    this.isHeld = false;
    byId("map-lines").textContent = "";
    this.say("");
    this.draw();
  }

  /** The ranges around a launch. While it is dragged they stay. */
  gridOf(toss) {
    const { rate, speed } = toss.input;
    const flips = toss.margin?.rate ?? [];
    const over = state.view.map === "speed" ? [0, niceAbove(Math.max(1.6 * (speed ?? 0), 0.5))] : around(rate[2], flips[2], rate[0]);
    const wanted = { across: around(rate[0], flips[0], rate[2]), over };
    if (this.isHeld && this.grid && this.grid.up === state.view.map) Object.assign(wanted, { across: this.grid.across, over: this.grid.over });
    const size = toss.motion ? (state.view.shade === "outcome" ? SIZE : SIZE / 2) : COARSE;
    const spread = state.view.shade === "chance" ? state.view.spread : null;
    return { up: state.view.map, ...wanted, columns: size, rows: size, part: [0, size], spread };
  }

  compute(part) {
    const { columns, rows } = this.grid;
    const started = performance.now();
    const answer = ask({ ask: "map", scene: question(), grid: { ...this.grid, part } });
    const found = cells(answer.cells);
    const taken = performance.now() - started;
    if (part[1] - part[0] === rows) this.timing.push(taken);
    if (this.image.width !== columns || part[0] === 0) Object.assign(this.image, { width: columns, height: rows });
    const pixels = new ImageData(columns, part[1] - part[0]);
    for (let index = 0; index < found.length; index++) {
      const row = part[1] - part[0] - 1 - Math.floor(index / columns);
      const at = 4 * (row * columns + (index % columns));
      const [red, green, blue] = PALETTE[found[index]];
      pixels.data.set([red, green, blue, 255], at);
    }
    this.image.getContext("2d").putImageData(pixels, 0, rows - part[1]);
    return answer;
  }

  /** Computes some rows, lets the page live, and goes on, until another map is asked for. */
  inParts(turn, first) {
    if (turn !== this.turn || !this.grid) return;
    const next = Math.min(this.grid.rows, first + (this.toss.motion ? ROWS_A_TURN : 2));
    try {
      this.compute([first, next]);
    } catch (refusal) {
      this.clear();
      this.say(refusal.message);
    }
    this.draw();
    if (this.grid && next < this.grid.rows) setTimeout(() => this.inParts(turn, next));
  }

  say(text) {
    byId("map-message").textContent = text;
    byId("map-message").hidden = !text;
  }

  /** The place of (ωx, up) on the canvas, in CSS pixels. */
  place([x, up]) {
    const { across, over } = this.grid;
    const { width, height } = this.box();
    return [
      MARGIN.left + ((x - across[0]) / (across[1] - across[0])) * width,
      MARGIN.top + (1 - (up - over[0]) / (over[1] - over[0])) * height,
    ];
  }

  box() {
    const { clientWidth, clientHeight } = this.canvas;
    return { width: clientWidth - MARGIN.left - MARGIN.right, height: clientHeight - MARGIN.top - MARGIN.bottom };
  }

  draw() {
    const ratio = devicePixelRatio || 1;
    const { clientWidth, clientHeight } = this.canvas;
    if (!clientWidth) return;
    Object.assign(this.canvas, { width: Math.round(clientWidth * ratio), height: Math.round(clientHeight * ratio) });
    const pen = this.canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, clientWidth, clientHeight);
    if (!this.grid) return;
    const { width, height } = this.box();
    pen.imageSmoothingEnabled = false;
    pen.drawImage(this.image, MARGIN.left, MARGIN.top, width, height);
    this.drawAxes(pen, width, height);
    pen.save();
    pen.beginPath();
    pen.rect(MARGIN.left, MARGIN.top, width, height);
    pen.clip();
    this.drawLine(pen, this.lines.certain, []);
    this.drawLine(pen, this.lines.first_flip, [6, 4]);
    this.drawLaunch(pen);
    pen.restore();
    this.describe();
  }

  drawAxes(pen, width, height) {
    const { text, faint } = colours();
    const { across, over, up } = this.grid;
    const bottom = MARGIN.top + height;
    Object.assign(pen, { fillStyle: text, strokeStyle: faint, lineWidth: 1, font: "12px system-ui, sans-serif" });
    pen.strokeRect(MARGIN.left - 0.5, MARGIN.top - 0.5, width + 1, height + 1);
    Object.assign(pen, { textAlign: "center", textBaseline: "top" });
    for (const tick of ticks(...across)) pen.fillText(short(tick), this.place([tick, over[0]])[0], bottom + 5);
    pen.fillText("ωx (rad/s)", MARGIN.left + width / 2, bottom + 22);
    Object.assign(pen, { textAlign: "right", textBaseline: "middle" });
    for (const tick of ticks(...over)) pen.fillText(short(tick), MARGIN.left - 6, this.place([across[0], tick])[1]);
    pen.save();
    pen.translate(12, MARGIN.top + height / 2);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = "center";
    pen.fillText(up === "speed" ? "v₀ (m/s)" : "ωz (rad/s)", 0, 0);
    pen.restore();
  }

  /** White below, so that the line is seen on every colour. */
  drawLine(pen, points, dash) {
    for (const [colour, width] of [["#fff", 5], ["#d55e00", 2.5]]) {
      Object.assign(pen, { strokeStyle: colour, lineWidth: width });
      pen.setLineDash(colour === "#fff" ? [] : dash);
      pen.beginPath();
      let isDown = false;
      for (const point of points) {
        if (point) pen[isDown ? "lineTo" : "moveTo"](...this.place(point));
        isDown = Boolean(point);
      }
      pen.stroke();
    }
    pen.setLineDash([]);
  }

  drawLaunch(pen) {
    const [x, y] = this.place(this.launch());
    for (const [colour, width, size] of [["#fff", 6, 8], ["#000", 3, 8]]) {
      Object.assign(pen, { strokeStyle: colour, lineWidth: width });
      pen.beginPath();
      pen.arc(x, y, size, 0, 2 * Math.PI);
      pen.stroke();
    }
  }

  launch() {
    const { rate, speed } = this.toss.input;
    return [rate[0], this.grid.up === "speed" ? speed ?? 0 : rate[2]];
  }

  describe() {
    const { certain, first_flip, is_certain_everywhere } = this.lines;
    const lines = [
      certain.some(Boolean) && "solid line: beyond it heads is certain at every instant",
      first_flip.some(Boolean) && "dashed line: below it the coin is caught before its first flip",
      is_certain_everywhere && "every launch of this map shows heads at every instant",
    ].filter(Boolean);
    byId("map-lines").textContent = lines.join("; ");
  }

  release() {
    if (!this.isHeld) return;
    this.isHeld = false;
    this.update(this.toss);
  }

  point(event) {
    if (!this.grid) return;
    this.isHeld = true;
    const box = this.canvas.getBoundingClientRect();
    const { width, height } = this.box();
    const part = (value) => Math.max(0, Math.min(1, value));
    const right = part((event.clientX - box.left - MARGIN.left) / width);
    const upwards = part(1 - (event.clientY - box.top - MARGIN.top) / height);
    const { across, over } = this.grid;
    this.move(across[0] + right * (across[1] - across[0]), over[0] + upwards * (over[1] - over[0]));
  }

  key(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!steps || !this.grid) return;
    event.preventDefault();
    const { across, over } = this.grid;
    const [x, up] = this.launch();
    const step = ([lo, hi]) => ((hi - lo) / 100) * (event.shiftKey ? 10 : 1);
    this.launchAt(x + steps[0] * step(across), Math.max(over[0], up + steps[1] * step(over)));
  }

  /** Makes this the launch: the rates as numbers in rad/s, and the speed in m/s. */
  launchAt(x, up) {
    if (!this.grid) return;
    const { rate } = this.toss.input;
    const isSpeed = this.grid.up === "speed";
    const rates = [x, rate[1], isSpeed ? rate[2] : up].map((part) => typed(part));
    change({ scene: { by: "rate", rate: rates, ...(isSpeed ? { flight: "speed", speed: typed(up) } : {}) } }, "map");
  }
}

/** The colours of the cells; 255 is a launch without an outcome. */
const PALETTE = Array.from({ length: 256 }, (_, cell) => (cell === 255 ? [213, 94, 0] : ofProbability(cell / 254)));

/** A range that holds a rate, 0, the nearest flip unless it is far, and about as much as the `other` rate needs. */
function around(rate, flip, other) {
  const flipped = flip == null ? 0 : Math.abs(rate + flip);
  const isNear = flipped < 10 * Math.max(Math.abs(rate), Math.abs(other), 1);
  const far = niceAbove(Math.max(1.5 * Math.abs(rate), 0.75 * Math.abs(other), isNear ? 1.3 * flipped : 0, 1));
  return rate < 0 ? [-far, far] : [0, far];
}
