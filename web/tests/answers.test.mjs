// What the page answers, beside what the program answers.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, test } from "node:test";
import { PROGRAM, address, answer, close, launchBrowser, open, text } from "./browser.mjs";
import { LAUNCHES, OF_BODIES, asAddress, asOptions } from "./launches.mjs";

let browser;
before(async () => (browser = await launchBrowser()));
after(() => browser.close());

const asked = (...given) => JSON.parse(execFileSync(PROGRAM, [...given, "--format", "json"], { encoding: "utf8" }));

/** Goes to another address, and waits until the page has read it. */
const goTo = (page, address) =>
  page.evaluate(
    (address) =>
      new Promise((done) => {
        addEventListener("hashchange", () => done(), { once: true });
        location.hash = address;
      }),
    address,
  );

/** Waits for margins, which take up to some seconds for a body with I1 ≠ I2. */
const searched = (page) => page.waitForFunction(() => document.querySelector("#margins tr"), null, { timeout: 120_000 });

/** The digits of the program's margins, under the names of the page. */
function margins({ time, speed, gravity, tilt, rate }, isThrown) {
  const text = (value) => (value === null ? "" : String(value));
  const flight = isThrown ? { "v₀": text(speed), g: text(gravity) } : { T: text(time) };
  return { ...flight, tilt: text(tilt), ωx: text(rate[0]), ωy: text(rate[1]), ωz: text(rate[2]) };
}

// The margins are found by sines and cosines, whose last digit may differ between two platforms; the library promises
// them to a relative 1e-12, and they are compared to that. Outcomes and cos θ have the same digits.
test("the page answers as the program does", async (context) => {
  const page = await open(browser);
  let same = 0;
  let compared = 0;
  for (const launch of [...LAUNCHES, ...OF_BODIES]) {
    const program = asked("toss", ...asOptions(launch), "--margin");
    await goTo(page, asAddress(launch));
    await searched(page);
    const wanted = {
      outcome: program.outcome,
      isProven: program.certified,
      cosTilt: String(program.cos_tilt),
      margins: margins(program.margin, "speed" in launch),
    };
    const shown = await answer(page);
    for (const [name, digits] of Object.entries(wanted.margins)) {
      compared++;
      same += shown.margins[name] === digits;
      const isClose = Math.abs(Number(shown.margins[name]) - Number(digits)) <= 1e-12 * Math.abs(Number(digits));
      if (digits && shown.margins[name] && isClose) shown.margins[name] = digits;
    }
    assert.deepEqual(shown, wanted, JSON.stringify(launch));
    context.diagnostic(`${shown.outcome.padEnd(9)} page ${shown.cosTilt.padEnd(22)} program ${String(program.cos_tilt).padEnd(22)} ${asOptions(launch).join(" ")}`);
  }
  context.diagnostic(`${same} of ${compared} margins have the same digits, too`);
  await close(page);
});

test("a search of margins ends when the launch changes, and its answer is never shown for another one", async () => {
  const page = await open(browser, asAddress(OF_BODIES[1]));
  await searched(page);
  const first = (await answer(page)).margins;
  // Back and forth, each time while the search of the last launch may be running.
  for (const wait of [0, 260, 300, 400]) {
    await goTo(page, asAddress(OF_BODIES[2]));
    assert.deepEqual((await answer(page)).margins, {});
    await page.waitForTimeout(wait);
    await goTo(page, asAddress(OF_BODIES[1]));
    assert.deepEqual((await answer(page)).margins, {});
  }
  await searched(page);
  assert.deepEqual((await answer(page)).margins, first);
  await goTo(page, asAddress({ ...OF_BODIES[1], speed: "-1" }));
  await page.waitForTimeout(600);
  assert.equal(await page.locator("#margins-table").isHidden(), true);
  await close(page);
});

test("P(heads) of a hand is the program's to rounding: sines of two platforms may differ in their last digit", async () => {
  for (const launch of [LAUNCHES[1], LAUNCHES[4]]) {
    const page = await open(browser, `${asAddress(launch)}&spread=5%25`);
    await page.waitForFunction(() => document.getElementById("chance").dataset.probability, null, { timeout: 120_000 });
    const shown = await page.evaluate(() => document.getElementById("chance").dataset.probability);
    const options = ["--method", "exact-speed", "--points", "4096", "--seed", "1", "--spread", "5%"];
    const { rate, ...rest } = launch;
    const rates = Object.fromEntries((rate ?? "").split(",").filter(Boolean).map((part, axis) => [`rate-${"xyz"[axis]}`, part]));
    const { probability } = asked("probability", ...asOptions({ ...rates, ...rest }), ...options);
    assert.ok(Math.abs(Number(shown) - probability) < 1e-14, `${shown}, ${probability}`);
    await close(page);
  }
});

test("P(heads) within ± is the program's, in each of its forms, and is kept by the address", async () => {
  const launch = { coin: "us-quarter", turn: "38rev/s", psi: "70deg", speed: "2.4m/s" };
  for (const [typed, options, method] of [
    [{ psi: "2deg", turn: "0.5rev/s", speed: "5cm/s" }, ["--turn=normal:38rev/s:0.5rev/s", "--psi=normal:70deg:2deg", "--speed=normal:2.4m/s:5cm/s"], "exact-speed"],
    [{ psi: "66deg:74deg", tilt: "normal:1deg:2deg" }, ["--turn=38rev/s", "--psi=66deg:74deg", "--speed=2.4m/s", "--tilt=normal:1deg:2deg"], "sobol"],
  ]) {
    const page = await open(browser, asAddress(launch));
    for (const [name, text] of Object.entries(typed)) await page.fill(`#around-${name}`, text);
    await page.waitForFunction((name) => document.getElementById("around").dataset.probability && document.activeElement.id.endsWith(name), Object.keys(typed).at(-1));
    await page.waitForTimeout(300);
    const shown = Number(await page.getAttribute("#around", "data-probability"));
    const { probability } = asked("probability", "--coin=us-quarter", ...options, "--method", method, "--points", "4096", "--seed", "1");
    assert.ok(Math.abs(shown - probability) < 1e-14, `${shown}, ${probability}`);
    const again = await open(browser, await address(page));
    await again.waitForFunction((shown) => Number(document.getElementById("around").dataset.probability) === shown, shown);
    await close(again);
    await page.fill("#around-psi", "2 parsecs");
    await page.waitForFunction(() => document.getElementById("around").textContent.includes("psi"));
    assert.match(await text(page, "around"), /expected an angle/);
    for (const name of Object.keys(typed)) await page.fill(`#around-${name}`, "");
    assert.ok(await page.locator("#around").isHidden());
    await close(page);
  }
});

test("P(heads) of a body with I1 ≠ I2 is the program's", async () => {
  const page = await open(browser, "moments=1e-7,1.2e-7,2e-7&rate=9,4,3&speed=3&spread=5%25");
  await page.waitForFunction(() => document.getElementById("chance").dataset.probability, null, { timeout: 120_000 });
  const shown = await page.evaluate(() => document.getElementById("chance").dataset.probability);
  const options = ["--moments", "1e-7,1.2e-7,2e-7", "--rate-x=9", "--rate-y=4", "--rate-z=3", "--speed=3", "--spread", "5%"];
  const { probability } = asked("probability", ...options, "--method", "sobol", "--points", "4096", "--seed", "1");
  assert.equal(Number(shown), probability);
  await close(page);
});

test("integrators have the program's errors and calls, and the raw formulation fails in its words", async () => {
  const launch = LAUNCHES[4];
  const page = await open(browser, `${asAddress(launch)}&tolerance=1e-6`);
  await page.locator("#integrators").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelectorAll("#candidates tr").length > 5, null, { timeout: 120_000 });
  const shown = await page.locator("#candidates tr").evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
  const { rows } = asked("compare", ...asOptions(launch), "--tolerance", "1e-6", "--repeats", "0");
  assert.equal(shown.length, rows.length);
  for (const [index, row] of rows.entries()) {
    const [solver, scheme, error, , outcome, calls] = shown[index];
    assert.deepEqual([solver, scheme, outcome, calls], [row.solver, row.scheme ?? "–", row.outcome, String(row.rhs_calls ?? "–")]);
    if (row.cos_tilt_error) assert.ok(Math.abs(Number(error.replace("\u2212", "-")) / row.cos_tilt_error - 1) < 0.06, `${error}, ${row.cos_tilt_error}`);
  }
  await page.selectOption("#formulation", "raw");
  await page.waitForFunction(() => document.getElementById("failures").textContent.length > 0, null, { timeout: 120_000 });
  const failing = asked("compare", ...asOptions(launch), "--tolerance", "1e-6", "--repeats", "0", "--formulation", "raw").rows;
  const expected = failing.find(({ solver, scheme, failure }) => scheme === "dop853" && failure && solver === "euler");
  assert.ok((await text(page, "failures")).includes(expected.failure.message), await text(page, "failures"));
  await close(page);
});
