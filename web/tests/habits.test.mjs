// How the page behaves: dragging, presets, the address, bad input, keys.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { address, answer, close, drawn, launchBrowser, open, text } from "./browser.mjs";

let browser;
before(async () => (browser = await launchBrowser()));
after(() => browser.close());

test("each preset is chosen, shown as chosen, and kept by the address", async () => {
  const page = await open(browser);
  const outcomes = { cheated: "heads", tails: "tails", keller: "tails", quarter: "tails", racket: "tails" };
  for (const [name, outcome] of Object.entries(outcomes)) {
    await page.click(`[data-preset=${name}]`);
    assert.equal(await page.getAttribute(`[data-preset=${name}]`, "aria-pressed"), "true");
    const shown = await answer(page);
    assert.equal(shown.outcome, outcome, name);
    assert.ok(shown.isProven, name);
    const again = await open(browser, await address(page));
    assert.deepEqual(await answer(again), shown);
    assert.equal(await again.getAttribute(`[data-preset=${name}]`, "aria-pressed"), "true");
    await close(again);
  }
  await close(page);
});

test("the address carries the scene and the view there and back", async () => {
  const given =
    "cylinder=5.67g,12.13mm,1.75mm&turn=38rev/s&wobble=60deg&speed=2.45m/s&gravity=1.62&drop=10cm&tilt=-3deg&map=speed&shade=chance&spread=2%25&scheme=taylor&tolerance=1e-6&pace=0.03";
  const page = await open(browser, given);
  assert.equal(await address(page), given);
  await page.selectOption("#map-over", "rate_z");
  assert.equal(await address(page), given.replace("&map=speed", ""));
  await close(page);
});

test("an address that is wrong is named, and not used in part", async () => {
  for (const [given, words] of [
    ["spede=3", "'spede', which is unknown"],
    ["rate=1,2", "not three numbers"],
    ["rate=1,2,3&turn=4", "rate and turn"],
    ["speed=3&speed=4", "'speed' twice"],
    ["preset=none", "preset 'none'"],
  ]) {
    const page = await open(browser, given);
    assert.ok((await text(page, "address-error")).includes(words), given);
    assert.equal((await answer(page)).outcome, "heads");
    await close(page);
  }
});

test("bad input is refused beside its field, in the library's words", async () => {
  const page = await open(browser);
  for (const [id, typed, words] of [
    ["rate-y", "3 parsecs", "expected a rate in rad/s"],
    ["speed", "-1", "speed [m/s] = -1.0 is outside its valid range"],
    ["gravity", "0", "gravity [m/s²] = 0.0 is outside its valid range"],
    ["drop", "-40", "drop [m] = -40.0 is outside its valid range"],
    ["tilt", "", null],
  ]) {
    const before = await page.inputValue(`#${id}`);
    await page.fill(`#${id}`, typed);
    const error = await text(page, `${id}-error`);
    if (words) assert.ok(error.includes(words), `${id}: ${error}`);
    assert.equal(await page.getAttribute(`#${id}`, "aria-invalid"), words ? "true" : null);
    assert.equal((await answer(page)).outcome, words ? "refused" : "heads");
    await page.fill(`#${id}`, before);
    assert.equal((await answer(page)).outcome, "heads");
  }
  await page.selectOption("#coin", "=moments");
  await page.fill("#body", "1,2,9");
  assert.ok((await text(page, "body-error")).includes("no body has such moments"));
  await close(page);
});

test("sliders write in the unit of their text", async () => {
  const page = await open(browser, "preset=quarter");
  await page.locator("#turn").evaluate((input) => {
    const slider = input.parentElement.querySelector("input[type=range]");
    slider.value = 500;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  });
  assert.match(await page.inputValue("#turn"), /^[\d.]+rev\/s$/);
  assert.notEqual(await page.inputValue("#turn"), "38rev/s");
  assert.ok((await address(page)).includes("turn="));
  await close(page);
});

test("dragging S turns the launch, and dragging elsewhere the camera", async () => {
  const page = await open(browser, "preset=tails", { until: "scene" });
  const box = await page.locator("#scene canvas").boundingBox();
  const letter = await page.locator(".letters span", { hasText: "S" }).boundingBox();
  const before = await answer(page);
  const drag = async ([x, y], [toX, toY]) => {
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(toX, toY, { steps: 4 });
    await page.mouse.up();
    await drawn(page);
  };
  await drag([box.x + 20, box.y + box.height - 20], [box.x + 90, box.y + box.height - 20]);
  assert.deepEqual(await answer(page), before);
  const tip = await page.locator(".letters span", { hasText: "S" }).boundingBox();
  assert.notDeepEqual(tip, letter);
  // Upwards, until S is near to n: then heads is certain.
  const middle = [box.x + box.width / 2, box.y + box.height / 2];
  const from = [tip.x + tip.width / 2, tip.y + tip.height / 2].map((place, axis) => place + 0.08 * (middle[axis] - place));
  await drag(from, [middle[0], box.y + 0.2 * box.height]);
  const now = await answer(page);
  assert.notEqual(now.cosTilt, before.cosTilt);
  assert.equal(now.outcome, "heads");
  assert.ok((await text(page, "facts")).includes("heads at every instant"));
  await close(page);
});

test("the launch is a point in the map, for the pointer and for keys", async () => {
  const page = await open(browser, "preset=tails", { until: "scene" });
  await page.locator("#map").scrollIntoViewIfNeeded();
  const box = await page.locator("#map").boundingBox();
  await page.mouse.click(box.x + 70, box.y + 40);
  await drawn(page);
  assert.equal((await answer(page)).outcome, "heads");
  const before = await page.inputValue("#rate-x");
  await page.locator("#map").focus();
  for (const key of ["ArrowRight", "Shift+ArrowRight"]) await page.keyboard.press(key);
  assert.ok(Number(await page.inputValue("#rate-x")) > Number(before));
  await close(page);
});

test("everything has a name and can be reached by the keyboard", async () => {
  const page = await open(browser);
  const nameless = await page.locator("input, select, button, canvas").evaluateAll((all) =>
    all.filter((one) => one.offsetParent && !one.closest(".plot") && !one.textContent.trim() && !one.ariaLabel && !one.getAttribute("aria-label") && !one.labels?.length).map((one) => one.outerHTML),
  );
  assert.deepEqual(nameless, []);
  const charts = await page.locator(".plot").evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
  assert.ok(charts.every((name) => name?.startsWith("chart: ")), charts.join());
  const reached = new Set();
  for (let step = 0; step < 60; step++) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.preset || document.activeElement.tagName));
  }
  for (const id of ["cheated", "play", "coin", "rate-x", "speed", "map", "spread", "solver"]) assert.ok(reached.has(id), id);
  await close(page);
});

test("it moves by itself only where motion is welcome", async () => {
  for (const reducedMotion of ["reduce", "no-preference"]) {
    const page = await open(browser, "preset=racket", { until: "scene", reducedMotion });
    if (reducedMotion === "no-preference") await page.waitForFunction(() => document.getElementById("clock").value > 0);
    else {
      await page.waitForTimeout(1200);
      assert.equal(await page.inputValue("#clock"), "0");
    }
    await close(page);
  }
});
