// Starts the page: the library, the first answer, then what is slower.
import { ask, frame, start } from "./library.js";
import { read } from "./address.js";
import { Around } from "./around.js";
import { showAnswer, showRefusal } from "./answer.js";
import { Controls } from "./controls.js";
import { byId, later, onceAFrame, save } from "./dom.js";
import { Fair } from "./fair.js";
import { flight, fly, land, table } from "./flight.js";
import { typed } from "./format.js";
import { Hand } from "./hand.js";
import { Lesson } from "./lesson.js";
import { People } from "./people.js";
import { Integrators } from "./integrators.js";
import { MapView } from "./map.js";
import { FRAME } from "./memory.js";
import { Player } from "./player.js";
import { address, change, fromAddress, ofPreset, onChange, question, state, take } from "./state.js";
import { apply, colours, onTheme, toggle } from "./theme.js";
import { Traces } from "./traces.js";

const STILL = matchMedia("(prefers-reduced-motion: reduce)");
const parts = {};
/** For the tests: what was measured. */
const measured = (window.measured = { firstAnswer: null, map: null, frames: null });
let toss = null;

async function main() {
  apply();
  await start();
  const known = ask({ ask: "known" });
  Object.assign(parts, { controls: new Controls(known), around: new Around(), fair: new Fair(), map: new MapView(), hand: new Hand(), traces: new Traces(), lesson: new Lesson() });
  parts.people = new People((angles) => parts.fair.explain(angles));
  parts.integrators = new Integrators(known);
  parts.player = new Player(show);
  Object.assign(measured, { map: parts.map.timing, frames: parts.player.frames });
  byId("version").textContent = known.version;
  onChange((what) => {
    byId("address-error").hidden = true;
    if (what === "scene") sceneChanged();
    else viewChanged();
  });
  onTheme(recolour);
  byId("theme").addEventListener("click", toggle);
  byId("copy").addEventListener("click", copy);
  byId("save-picture").addEventListener("click", savePicture);
  byId("save-data").addEventListener("click", () => toss && save("flight.csv", new Blob([table()], { type: "text/csv" })));
  addEventListener("hashchange", () => (location.hash.slice(1) === address() ? read() : readAddress()));
  // The page is at its place only when it has its height; the address chooses what it shows.
  readAddress();
  viewChanged();
  measured.firstAnswer = performance.now();
  document.documentElement.dataset.ready = "answer";
  requestAnimationFrame(() => setTimeout(loadScene));
}

/** Takes what the address says, or else the first preset. An address with a fault stays as it is until the next change. */
function readAddress() {
  const { found, faults } = fromAddress(read());
  (faults.length > 0 ? take : change)(found ?? ofPreset("quarter"));
  const rest = found ? "the rest is shown" : "this is a quarter as people flip it instead";
  byId("address-error").textContent = faults.length > 0 ? `${faults.join("; ")}; ${rest}` : "";
  byId("address-error").hidden = faults.length === 0;
}

const announce = later(700, (text) => (byId("announcement").textContent = text));

/** Answers the scene. What is quick is done at once; the map follows before the next frame is shown. */
function sceneChanged() {
  parts.controls.show();
  parts.player.refresh();
  parts.around.clear();
  parts.hand.clear();
  parts.integrators.clear();
  try {
    toss = ask({ ask: "toss", scene: question() });
    fly(toss);
    showAnswer(toss);
    parts.controls.refuse(null);
    announce(`${byId("outcome").textContent}, ${byId("proof").textContent}`);
  } catch (refusal) {
    toss = null;
    land();
    parts.player.clear();
    parts.fair.clear();
    parts.map.clear();
    parts.traces.clear();
    byId("ruler").hidden = true;
    showRefusal(refusal);
    parts.controls.refuse(refusal);
    announce(refusal.message);
    document.body.classList.add("unanswered");
    return;
  }
  document.body.classList.remove("unanswered");
  parts.scene?.launch(flight, toss);
  parts.player.at(flight.time);
  restOfAnswer();
}

const restOfAnswer = onceAFrame(() => {
  if (!toss) return;
  parts.around.show();
  parts.fair.show(toss);
  parts.map.update(toss);
  parts.traces.draw();
  parts.traces.mark(flight.time);
  parts.hand.show();
  parts.integrators.show();
});

function viewChanged() {
  parts.player.refresh();
  parts.lesson.show();
  parts.people.show();
  parts.controls.showAround();
  if (!toss) return;
  parts.around.show();
  parts.map.update(toss);
  parts.hand.show();
  parts.integrators.show();
}

/** Shows the flight at its time. Gives the time (ms) that drawing by three.js took, which is not our own. */
function show() {
  const now = frame(flight.time).slice();
  parts.traces.mark(flight.time);
  showHeight(now[FRAME.height]);
  return parts.scene?.at(now, flight.time / flight.answer.flight_time) ?? 0;
}

function showHeight(height) {
  const { apex, drop } = flight.answer;
  byId("ruler").hidden = apex === 0;
  if (apex === 0) return;
  const bottom = Math.min(0, -drop);
  byId("ruler").style.setProperty("--part", String((height - bottom) / (apex - bottom)));
  byId("height").textContent = `${height.toFixed(apex < 1 ? 3 : 2)} m`;
}

function recolour() {
  if (!toss) return;
  parts.traces.recolour();
  parts.map.draw();
  parts.integrators.recolour();
  parts.hand.recolour();
  parts.scene?.recolour(colours());
  parts.player.at(flight.time);
}

const forgetCopy = later(6000, () => (byId("copied").textContent = ""));

async function copy() {
  const text = new URL(`#${address()}`, location.href).href;
  const isHosted = location.protocol !== "file:";
  try {
    await navigator.clipboard.writeText(text);
    byId("copied").textContent = isHosted ? "Copied." : "Copied; it opens on this computer only, where the page is.";
  } catch {
    byId("copied").textContent = "This browser does not let the page copy: take the link from the address bar.";
  }
  forgetCopy();
}

async function savePicture() {
  if (toss && parts.scene) save("flight.png", await parts.scene.picture(colours().background));
}

/** Loads three.js with the scene, after the first answer. */
function loadScene() {
  const script = document.createElement("script");
  script.src = "scene.js";
  script.onload = () => {
    try {
      parts.scene = window.makeScene(byId("scene"), { aimed: onceAFrame(aimed), colours: colours() });
      if (toss) parts.scene.launch(flight, toss);
      if (toss) parts.player.at(flight.time);
      if (!STILL.matches) parts.player.play();
    } catch (error) {
      byId("scene-message").textContent = `The scene needs WebGL 2, which this browser does not offer (${error.message}).`;
      byId("scene-message").hidden = false;
    }
    document.documentElement.dataset.ready = "scene";
  };
  script.onerror = () => (document.documentElement.dataset.ready = "scene");
  document.head.append(script);
}

/** Takes the launch whose S was dragged in this direction (LF). */
function aimed(direction) {
  if (!toss) return;
  let rate;
  try {
    ({ rate } = ask({ ask: "aim", scene: question(), direction }));
  } catch ({ message }) {
    announce(message);
    return;
  }
  parts.player.pause();
  flight.time = 0;
  change({ scene: { by: "rate", rate: rate.map((part) => typed(part)) } }, "scene");
}

main().catch((error) => {
  byId("outcome").textContent = "The page can't start";
  byId("proof").textContent = error.message;
  document.documentElement.dataset.ready = "never";
});
window.tossState = state;
window.tossAddress = address;
