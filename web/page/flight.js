// The flight that is shown: its trace, and the time at which it is looked at.
import { ask, numbers } from "./library.js";
import { POINT } from "./memory.js";
import { question } from "./state.js";

/** The flight; `trace` holds `POINT.length` numbers a point. */
export const flight = { answer: null, trace: null, time: 0 };

/** Points of a trace: so many a turn, within limits; a body with I1 ≠ I2 costs more. */
const A_TURN = 60;
const FEWEST = 240;
const MOST = { coin: 2400, rigid: 600 };

/** Asks for the flight of the scene. `turns` is a guess of how far it turns. */
export function fly(toss) {
  const motion = toss.motion;
  const turns = motion ? (motion.precession_rate * toss.flight_time) / (2 * Math.PI) : 10;
  const points = Math.round(Math.min(motion ? MOST.coin : MOST.rigid, Math.max(FEWEST, A_TURN * turns)));
  flight.answer = ask({ ask: "fly", scene: question(), points });
  flight.trace = numbers(points);
  flight.time = Math.min(flight.time, flight.answer.flight_time);
}

/** Forgets the flight: the scene has none. */
export function land() {
  Object.assign(flight, { answer: null, trace: null, time: 0 });
}

/** The column of the trace that begins at `of`, such as `POINT.cosTilt`. */
export function column(of) {
  const { points } = flight.answer;
  return Array.from({ length: points }, (_, index) => flight.trace[index * POINT.length + of]);
}

const COLUMNS = [
  "time [s]", "cos_tilt", "height [m]", "normal_x", "normal_y", "normal_z", "face_x", "face_y", "face_z",
  "rate_x [rad/s]", "rate_y [rad/s]", "rate_z [rad/s]",
];

/** The trace as a table: n and the vector in the face in the laboratory frame, the rates in the body frame. */
export function table() {
  const lines = Array.from({ length: flight.answer.points }, (_, index) =>
    flight.trace.subarray(index * POINT.length, (index + 1) * POINT.length).join(","));
  return [COLUMNS.join(","), ...lines, ""].join("\n");
}
