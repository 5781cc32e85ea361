// Integrators side by side: how the error of each grows along the flight, what it costs, and where it fails.
import { ask } from "./library.js";
import { byId, fill, later, make, options } from "./dom.js";
import { duration, short, withPoint } from "./format.js";
import { Plot } from "./plot.js";
import { CHOICES, change, question, state } from "./state.js";
import { ofSolver } from "./theme.js";

const POINTS = 60;

/** A flight is repeated until its clock has run for so long (ms), and then as often again; the shortest counts. */
const LEAST = 2;

/** The smallest error of the chart: below it, all errors are rounding. */
const FLOOR = 1e-17;

/** The integrators. */
export class Integrators {
  constructor(known) {
    this.known = known.solvers.filter(({ schemes }) => schemes.length > 0);
    const schemes = new Map(this.known.flatMap(({ schemes }) => schemes.map((scheme) => [scheme.name, scheme])));
    const formulations = new Set(this.known.flatMap(({ formulations }) => formulations));
    this.schemes = schemes;
    options(byId("solver"), [["all", "all of them"], ...this.known.map(({ name, summary }) => [name, `${name}: ${summary}`])]);
    options(byId("scheme"), [...schemes.keys()].map((name) => [name, name]));
    options(byId("formulation"), [...formulations].map((name) => [name, FORMULATIONS[name] ?? name]));
    const names = (options) => [...options].map(({ value }) => value);
    for (const name of ["solver", "scheme", "formulation"]) CHOICES[name] = names(byId(name).options);
    for (const name of ["solver", "scheme", "tolerance", "step", "formulation"]) {
      byId(name).addEventListener("input", ({ target }) => change({ view: { [name]: target.value } }, "integrators"));
    }
    this.plot = new Plot(byId("plot-errors"), { title: "error of the attitude (rad)", logarithmic: true, height: 230, value: (value) => value.toExponential(1) });
    this.update = later(250, () => this.compute());
    // Nothing is computed before somebody can see it.
    new IntersectionObserver(([seen]) => this.see(seen.isIntersecting), { rootMargin: "200px" }).observe(byId("integrators"));
  }

  see(isSeen) {
    this.isSeen = isSeen;
    if (isSeen && this.isStale) this.update();
  }

  show() {
    for (const name of ["solver", "scheme", "tolerance", "step", "formulation"]) {
      if (byId(name).value !== state.view[name]) byId(name).value = state.view[name];
    }
    const isAdaptive = this.schemes.get(state.view.scheme)?.adaptive ?? true;
    byId("tolerance-box").hidden = !isAdaptive;
    byId("step-box").hidden = isAdaptive;
    // What else of the view has changed makes no other answer.
    const { solver, scheme, tolerance, step, formulation } = state.view;
    const asked = JSON.stringify([question(), solver, scheme, tolerance, step, formulation]);
    if (asked === this.asked) return;
    this.clear();
    this.asked = asked;
    this.isStale = true;
    if (this.isSeen) this.update();
  }

  /** Draws again, in other colours. */
  recolour() {
    this.asked = null;
    this.show();
  }

  /** Shows no answer, and computes none. */
  clear() {
    this.update.drop();
    this.isStale = false;
    this.asked = null;
    this.plot.clear();
    fill(byId("failures"));
    fill(byId("candidates"));
    this.refuse(null);
  }

  /** The settings of a solver: the chosen scheme, or `null` if it does not have it. */
  settings({ name, schemes, formulations }) {
    const { scheme, tolerance, step, formulation } = state.view;
    const own = schemes.find((one) => one.name === scheme);
    if (!own || (formulations.length > 0 && !formulations.includes(formulation))) return null;
    const control = own.adaptive ? { tolerance } : { step };
    return { solver: name, scheme, ...control, ...(formulations.length > 0 ? { formulation } : {}) };
  }

  compute() {
    this.isStale = false;
    try {
      this.drawGrowth();
      this.fillTable();
    } catch (refusal) {
      this.clear();
      this.refuse(refusal);
    }
  }

  refuse(refusal) {
    const typed = { tolerance: state.view.tolerance, step: state.view.step }[refusal?.field?.split(" ")[0]] ?? "";
    byId("integrators-error").textContent = refusal ? withPoint(refusal.message, typed) : "";
    byId("integrators-error").hidden = !refusal;
  }

  drawGrowth() {
    const chosen = this.known.filter(({ name }) => ["all", name].includes(state.view.solver));
    const without = chosen.filter((solver) => !this.settings(solver)).map(({ name }) => name);
    const curves = chosen.filter((solver) => this.settings(solver)).map((solver) => ({
      solver, growth: ask({ ask: "growth", scene: question(), by: this.settings(solver), points: POINTS }),
    }));
    const times = [...new Set(curves.flatMap(({ growth }) => growth.time))].sort((a, b) => a - b);
    const columns = curves.map(({ growth }) => {
      const at = new Map(growth.time.map((time, index) => [time, growth.attitude_error[index]]));
      return times.map((time) => (at.get(time) == null ? (at.has(time) ? null : undefined) : Math.max(FLOOR, at.get(time))));
    });
    const dashes = [[], [8, 4], [2, 3]];
    const series = curves.map(({ solver }, index) => ({ label: solver.name, colour: ofSolver(solver.color), dash: dashes[index % 3] }));
    const hasAny = columns.some((column) => column.some((value) => value != null));
    byId("plot-errors").hidden = !hasAny;
    if (hasAny) this.plot.draw([times, ...columns], series);
    const notes = [
      ...curves.filter(({ growth }) => growth.failure).map(({ solver, growth }) => make("li", {}, make("b", {}, solver.name), `: ${growth.failure}`)),
      ...without.map((name) => make("li", {}, make("b", {}, name), ": does not offer this choice")),
    ];
    fill(byId("failures"), ...notes);
  }

  fillTable() {
    const { tolerance, step, formulation } = state.view;
    const all = ask({ ask: "candidates", tolerance, step, formulation });
    fill(byId("candidates"), ...all.map((by) => this.row(by)));
  }

  row(by) {
    const landing = ask({ ask: "landing", scene: question(), by });
    const entry = this.known.find(({ name }) => name === by.solver);
    const swatch = make("span", { class: "swatch", style: `background:${ofSolver(entry?.color ?? [0, 0, 0])}` });
    const cells = landing.failure
      ? [make("td", { colspan: 5, class: "failure" }, landing.failure.message)]
      : [
          make("td", {}, landing.cos_tilt_error === null ? "the reference" : short(landing.cos_tilt_error, 2)),
          make("td", {}, landing.attitude_error === null ? "–" : short(landing.attitude_error, 2)),
          make("td", {}, landing.outcome),
          make("td", {}, landing.rhs_calls === null ? "–" : String(landing.rhs_calls)),
          make("td", {}, duration(this.time(by))),
        ];
    return make("tr", {}, make("th", { scope: "row" }, swatch, by.solver), make("td", {}, by.scheme ?? "–"), ...cells);
  }

  /** The time of one flight (ns): the best of three runs. */
  time(by) {
    let times = 1;
    for (;;) {
      const taken = this.run(by, times);
      if (taken >= LEAST || times >= 4096) break;
      times *= 4;
    }
    return (1e6 * Math.min(...[0, 1, 2].map(() => this.run(by, times)))) / times;
  }

  run(by, times) {
    const started = performance.now();
    ask({ ask: "repeat", scene: question(), by, times });
    return performance.now() - started;
  }
}

const FORMULATIONS = {
  momentum: "momentum: no flight is singular",
  vertical: "vertical: the paper's frame, with guards",
  raw: "raw: as the paper prints it",
};
