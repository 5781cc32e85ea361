// How the page behaves: dragging, presets, the address, bad input, keys.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
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
    "cylinder=5.67g,12.13mm,1.75mm&turn=38rev/s&psi=60deg&speed=2.45m/s&gravity=1.62&drop=10cm&tilt=-3deg&map=speed&shade=chance&spread=2%25&scheme=taylor&tolerance=1e-6&pace=0.03";
  const page = await open(browser, given, { until: "scene" });
  assert.equal(await address(page), given);
  await page.selectOption("#map-over", "rate_z");
  assert.equal(await address(page), given.replace("&map=speed", ""));
  await close(page);
});

test("an address that contradicts itself is named, and stays until the next change", async () => {
  for (const [given, words] of [
    ["toString=1", "'toString', which is unknown"],
    ["rate=1,2,3&psi=1", "rate and psi"],
    ["spede=3", "'spede', which is unknown"],
    ["rate=1,2", "not three numbers"],
    ["rate=1,2,3&turn=4", "rate and turn"],
    ["preset=none", "preset 'none'"],
    ["speed=%zz", "'speed=%zz'"],
    ["pace=fast", "'pace=fast'"],
  ]) {
    const page = await open(browser, given);
    assert.ok((await text(page, "address-error")).includes(words), given);
    assert.equal(await page.getAttribute("[data-preset=quarter]", "aria-pressed"), "true");
    assert.equal(await page.evaluate(() => location.hash.slice(1)), given);
    await page.click("[data-preset=tails]");
    assert.ok(await page.locator("#address-error").isHidden());
    await close(page);
  }
});

test("what an address has right is kept beside what is wrong, and a preset can be changed", async () => {
  for (const [given, words, id, value] of [
    ["foo=1&speed=5", "'foo', which is unknown; the rest is shown", "speed", "5"],
    ["speed=3&speed=4", "'speed' twice", "speed", "3"],
    ["rate=1,2,3&map=none", "'map=none': valid are rate_z, speed", "rate-y", "2"],
    ["speed=4&scheme=none", "'scheme=none': valid are dop853", "speed", "4"],
    ["preset=quarter&speed=9m/s", "", "speed", "9m/s"],
    ["preset=quarter&speed=9m/s", "", "turn", "38rev/s"],
    ["preset=keller&turn=9&psi=1", "", "psi", "1"],
  ]) {
    const page = await open(browser, given);
    assert.ok((await page.locator("#address-error").textContent()).includes(words), given);
    assert.equal(await page.locator("#address-error").isHidden(), words === "", given);
    assert.equal(await page.inputValue(`#${id}`), value, given);
    await close(page);
  }
});

test("bad input is refused beside its field, in the library's words", async () => {
  const page = await open(browser, "preset=cheated");
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

/** What is shown that depends on the scene, besides the answer. */
const shown = (page) =>
  page.evaluate(() => {
    const text = (id) => document.getElementById(id).textContent;
    const map = document.getElementById("map");
    const blank = Object.assign(document.createElement("canvas"), { width: map.width, height: map.height });
    return {
      chance: [text("chance"), text("chance-note"), document.getElementById("chance").dataset.probability ?? ""],
      precision: text("precision"),
      candidates: document.querySelectorAll("#candidates tr").length,
      failures: text("failures"),
      charts: document.querySelectorAll(".plot canvas").length,
      mapIsDrawn: map.toDataURL() !== blank.toDataURL(),
      mapLines: text("map-lines"),
      command: text("command"),
      clock: text("clock-text"),
      scene: getComputedStyle(document.querySelector("#scene canvas")).visibility,
      rulerIsHidden: document.getElementById("ruler").hidden,
    };
  });

const NOTHING = {
  chance: ["–", "", ""], precision: "", candidates: 0, failures: "", charts: 0, mapIsDrawn: false, mapLines: "", command: "–", clock: "–",
  scene: "hidden", rulerIsHidden: true,
};

/** Waits until everything is shown, also what is slow. */
async function all(page) {
  await page.locator("#integrators").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.getElementById("chance").dataset.probability, null, { timeout: 120_000 });
  await page.waitForFunction(() => document.querySelectorAll("#candidates tr").length > 5, null, { timeout: 120_000 });
  await page.click("#find-precision");
}

test("where there is no answer, nothing of the last one is left, also not later", async () => {
  const page = await open(browser, "preset=cheated", { until: "scene" });
  for (const [id, typed] of [["rate-x", "x"], ["speed", "-1"], ["rate-z", "1e300"]]) {
    await all(page);
    const before = await shown(page);
    assert.notEqual(before.chance[2], "");
    assert.ok(before.mapIsDrawn && before.charts >= 4 && before.precision && before.command.includes("unfair-toss"));
    const good = await page.inputValue(`#${id}`);
    await page.fill(`#${id}`, typed);
    assert.equal((await answer(page)).outcome, "refused");
    assert.deepEqual(await shown(page), NOTHING);
    await page.click("#play");
    await page.locator("#clock").evaluate((clock) => clock.dispatchEvent(new Event("input", { bubbles: true })));
    await page.waitForTimeout(700);
    assert.deepEqual(await shown(page), NOTHING, `after ${id}`);
    await page.fill(`#${id}`, good);
    await page.locator(`#${id}`).blur();
    assert.equal((await answer(page)).outcome, "heads");
  }
  await all(page);
  await close(page);
});

test("no old probability, precision or error is shown beside another launch or setting", async () => {
  const page = await open(browser, "preset=cheated");
  await all(page);
  // What is shown as soon as another one is typed, before anything else is computed.
  const typed = (id, value, ids) =>
    page.evaluate(([id, value, ids]) => {
      const input = document.getElementById(id);
      input.value = value;
      input.dispatchEvent(new Event("input", { bubbles: true }));
      return ids.map((id) => document.getElementById(id).textContent);
    }, [id, value, ids]);
  assert.deepEqual(await typed("wanted", "90%", ["precision"]), [""]);
  await page.click("#find-precision");
  assert.deepEqual(await typed("spread", "3%", ["chance", "chance-note", "precision"]), ["…", "", ""]);
  await all(page);
  assert.deepEqual(await typed("rate-x", "1.5", ["chance", "chance-note", "precision", "candidates", "failures"]), ["–", "", "", "", ""]);
  await all(page);
  // Solvers are compared only where somebody can see it.
  await page.locator("#integrators").scrollIntoViewIfNeeded();
  assert.deepEqual(await typed("tolerance", "1e-7", ["candidates", "failures"]), ["", ""]);
  await page.waitForFunction(() => document.querySelectorAll("#candidates tr").length > 5, null, { timeout: 120_000 });
  await typed("tolerance", "7", []);
  await page.waitForFunction(() => !document.getElementById("integrators-error").hidden, null, { timeout: 120_000 });
  assert.equal(await text(page, "candidates"), "");
  await typed("spread", "x", []);
  await page.waitForFunction(() => !document.getElementById("spread-error").hidden);
  assert.deepEqual(await typed("spread", "x", ["chance", "chance-note"]), ["–", ""]);
  await close(page);
});

test("a map that is dragged and the answer beside it are of the same launch in every frame", async () => {
  const page = await open(browser, "preset=tails", { until: "scene" });
  await page.locator("#map").scrollIntoViewIfNeeded();
  const box = await page.locator("#map").boundingBox();
  // The map is drawn where the charts are. A frame that begins between an answer and its charts would show old ones.
  await page.evaluate(() => {
    window.seen = [];
    const charts = document.getElementById("plot-rates");
    new MutationObserver(() => window.seen.push("answer")).observe(document.getElementById("cos-tilt"), { childList: true });
    new MutationObserver(() => window.seen.push("charts")).observe(charts, { childList: true, subtree: true, characterData: true, attributes: true });
    const frame = () => {
      window.seen.push("frame");
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });
  await page.mouse.move(box.x + 100, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 200, box.y + 100, { steps: 10 });
  await page.mouse.up();
  await drawn(page);
  const seen = (await page.evaluate(() => window.seen)).join(" ");
  assert.ok(seen.includes("answer charts") && !seen.includes("answer frame"), seen);
  await close(page);
});

test("the answer does not depend on the address bar, which browsers refuse to write too often", async () => {
  const never = () => {
    History.prototype.replaceState = () => {
      throw new DOMException("Attempt to use history.replaceState() more than 100 times per 30 seconds", "SecurityError");
    };
  };
  const page = await open(browser, "preset=cheated", { before: never });
  const other = await open(browser, "rate=2,2,0.5&speed=3");
  await page.click("[data-preset=tails]");
  assert.deepEqual(await answer(page), await answer(other));
  await page.fill("#speed", "x");
  assert.equal((await answer(page)).outcome, "refused");
  await page.fill("#speed", "3");
  assert.deepEqual(await answer(page), await answer(other));
  await close(other);
  await close(page);
});

test("of many changes the address is written a few times, and the last one is", async () => {
  const few = () => {
    const write = History.prototype.replaceState;
    const times = (window.writes = []);
    History.prototype.replaceState = function (...given) {
      times.push(performance.now());
      if (times.filter((time) => time > performance.now() - 30_000).length > 100) throw new DOMException("too often", "SecurityError");
      return write.apply(this, given);
    };
  };
  const page = await open(browser, "preset=tails", { before: few });
  await page.evaluate(() => {
    for (let change = 0; change < 300; change++) document.getElementById("map").dispatchEvent(new KeyboardEvent("keydown", { key: change % 2 ? "ArrowUp" : "ArrowRight" }));
  });
  assert.ok((await address(page)).includes("rate="));
  assert.ok((await page.evaluate(() => window.writes.length)) <= 4);
  // An address that a person writes meanwhile is read, and not written over.
  await page.evaluate(() => {
    const key = () => document.getElementById("map").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowUp" }));
    for (let change = 0; change < 5; change++) key();
    location.hash = "preset=cheated";
  });
  await page.waitForFunction(() => document.querySelector("[data-preset=cheated]").getAttribute("aria-pressed") === "true");
  assert.ok((await address(page)).startsWith("coin=paper&rate=1,1,2.5&speed=3"));
  await close(page);
});

test("a decimal comma is refused with the point in its place, and the address keeps it", async () => {
  const page = await open(browser, "preset=cheated");
  await page.fill("#speed", "2,5m/s");
  assert.match(await text(page, "speed-error"), /decimals take a point: 2\.5m\/s/);
  await page.fill("#speed", "3");
  await page.fill("#rate-y", "0,5");
  assert.match(await text(page, "rate-y-error"), /decimals take a point: 0\.5/);
  const again = await open(browser, await address(page));
  assert.equal(await again.inputValue("#rate-y"), "0,5");
  assert.match(await text(again, "rate-y-error"), /decimals take a point: 0\.5/);
  assert.equal((await answer(again)).outcome, "refused");
  await close(again);
  await page.fill("#rate-y", "1");
  await page.fill("#spread", "2,5%");
  await page.waitForFunction(() => document.getElementById("spread-error").textContent.includes("decimals take a point: 2.5%"));
  await page.fill("#wanted", "95,5%");
  await page.click("#find-precision");
  assert.match(await text(page, "precision"), /decimals take a point: 95\.5%/);
  await page.locator("#integrators").scrollIntoViewIfNeeded();
  await page.fill("#tolerance", "0,001");
  await page.waitForFunction(() => document.getElementById("integrators-error").textContent.includes("decimals take a point: 0.001"), null, { timeout: 60_000 });
  await page.selectOption("#coin", "=cylinder");
  await page.fill("#body", "5,67g,12.13mm,1.75mm");
  assert.match(await text(page, "body-error"), /commas separate the numbers, and decimals take a point/);
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
  await drag(from, [middle[0], box.y + 0.1 * box.height]);
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

const AXE = readFileSync(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8");

test("in light and dark, on a screen and a phone, no rule of WCAG 2.2 AA is broken that axe can check", async () => {
  const full = "preset=quarter&lesson=2&around-psi=2deg&people=Ada,11,20%0ABen,9,20%0ACem,12,20";
  for (const [colorScheme, width] of [["light", 1280], ["light", 390], ["dark", 1280], ["dark", 390]]) {
    for (const given of [full, "foo=1&rate=1,2,x&speed=3&people=x&spread=x&tolerance=7", "moments=1,2,2.5&rate=9,4,3&speed=3"]) {
      const page = await open(browser, given, { until: "scene", colorScheme, viewport: { width, height: 844 } });
      await page.waitForFunction(() => document.querySelector("#people-plot svg") || !document.getElementById("people-error").hidden || !location.hash.includes("people"));
      await page.evaluate(AXE);
      const broken = await page.evaluate(async () => {
        const { violations } = await axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"], preload: false });
        return violations.flatMap(({ id, nodes }) => nodes.map(({ target }) => `${id}: ${target.join(" ")}`));
      });
      assert.deepEqual(broken, [], `${colorScheme}, ${width}, ${given}`);
      await close(page);
    }
  }
});

test("controls and lines stand out by 3 : 1, and what has the focus is outlined and in the order of the page", async () => {
  for (const colorScheme of ["light", "dark"]) {
    const page = await open(browser, "preset=cheated", { until: "scene", colorScheme });
    const faint = await page.evaluate(() => {
      const luminance = (colour) => {
        const parts = colour.match(/[\d.]+/g).slice(0, 3).map((part) => (part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4));
        return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
      };
      const ratio = (a, b) => (Math.max(luminance(a), luminance(b)) + 0.05) / (Math.min(luminance(a), luminance(b)) + 0.05);
      const card = getComputedStyle(document.querySelector("section")).backgroundColor;
      const probe = document.body.appendChild(document.createElement("i"));
      const lines = ["normal", "face", "momentum", "accent", "edge", "soft"].map((name) => {
        probe.style.color = `var(--${name})`;
        return [name, ratio(getComputedStyle(probe).color, card)];
      });
      const controls = [...document.querySelectorAll("main button, main select, main input[type=text], textarea")];
      const borders = controls.map((one) => [one.id, ratio(getComputedStyle(one).borderTopColor, card)]);
      return [...lines, ...borders].filter(([, found]) => !(found >= 3));
    });
    assert.deepEqual(faint, []);
    const reached = [];
    for (let step = 0; step < 60; step++) {
      await page.keyboard.press("Tab");
      reached.push(
        await page.evaluate(() => {
          const one = document.activeElement;
          const [last, style] = [window.lastFocus, getComputedStyle(one)];
          window.lastFocus = one;
          const isNext = !last || one === document.body || last === document.body || Boolean(last.compareDocumentPosition(one) & 4);
          const isOutlined = one === document.body || (style.outlineStyle !== "none" && Number.parseFloat(style.outlineWidth) >= 2);
          return [one.id || one.dataset.preset || one.tagName, isNext && isOutlined];
        }),
      );
    }
    assert.deepEqual(reached.filter(([, isRight]) => !isRight), []);
    const ids = reached.map(([id]) => id);
    for (const id of ["cheated", "play", "coin", "rate-x", "around-rate-x", "speed", "map", "spread", "solver"]) assert.ok(ids.includes(id), id);
    await close(page);
  }
});

test("a class's page is printed on one sheet, on white", async () => {
  const people = Array.from({ length: 61 }, (_, index) => `Pupil ${index + 1};${9 + (index % 5)};20`).join("\n");
  for (const colorScheme of ["light", "dark"]) {
    const page = await open(browser, `people=${encodeURIComponent(people)}`, { until: "scene", colorScheme });
    await page.waitForFunction(() => document.querySelectorAll("#people-plot line.person").length === 60);
    const sheet = String(await page.pdf({ format: "A4" }));
    assert.equal(sheet.match(/\/Type\s*\/Page\b(?!s)/g).length, 1);
    await page.emulateMedia({ media: "print", colorScheme });
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).color), "rgb(28, 28, 30)");
    for (const id of ["#scene canvas", "#outcome", "#fair-curve", "#people-words"]) assert.ok(await page.locator(id).isVisible(), id);
    await close(page);
  }
});

test("presets say what they show, a bare number its unit, and margins are in the unit that was typed", async () => {
  const page = await open(browser);
  assert.match(await text(page, "preset-words"), /350 757 flips/);
  const margin = (name) => page.locator(`#margins tr[data-input="${name}"]`).innerText();
  assert.match(await margin("tilt"), /deg.*deg/s);
  await page.fill("#tilt", "0.1");
  assert.match(await margin("tilt"), /rad.*rad/s);
  assert.equal(await text(page, "preset-words"), "A launch of your own.");
  const units = await page.locator("#thrown .unit").allInnerTexts();
  assert.deepEqual(units, ["", "m/s²", "m"]);
  await page.fill("#speed", "2.4");
  assert.deepEqual(await page.locator("#thrown .unit").allInnerTexts(), ["m/s", "m/s²", "m"]);
  await page.fill("#speed", "8ft/s");
  const [change, at] = (await margin("v₀")).match(/[-+−]?[\d.]+ ft\/s/g).map((part) => Number.parseFloat(part.replace("−", "-")));
  assert.ok(Math.abs(8 + change - at) < 1e-3, `${change}, ${at}`);
  await close(page);
});

test("on a phone, upright or on its side, the coin, the button, the answer and the curve are on the first screen", async () => {
  for (const [width, height] of [[390, 844], [844, 390]]) {
    const page = await open(browser, "", { until: "scene", viewport: { width, height } });
    for (const id of ["#scene canvas", "#play", "#outcome", "#proof", "#fair-curve"]) {
      const box = await page.locator(id).boundingBox();
      assert.ok(box.y >= 0 && box.y + box.height <= height, `${id}: ${JSON.stringify(box)}`);
    }
    await close(page);
  }
});

test("a finger scrolls over map and curve without a change of the launch, and a tap changes it", async () => {
  const page = await open(browser, "preset=tails", { until: "scene", viewport: { width: 390, height: 844 }, hasTouch: true });
  const devtools = await page.context().newCDPSession(page);
  const launch = () => page.evaluate(() => JSON.stringify(window.tossState.scene));
  for (const id of ["#map", "#fair-curve"]) {
    await page.locator(id).scrollIntoViewIfNeeded();
    const [before, { x, y, width, height }] = [await launch(), await page.locator(id).boundingBox()];
    const top = await page.evaluate(() => scrollY);
    const [left, middle] = [Math.round(x + 0.4 * width), Math.round(y + height / 2)];
    const touch = (type, ...places) => devtools.send("Input.dispatchTouchEvent", { type, touchPoints: places.map((y) => ({ x: left, y })) });
    await touch("touchStart", middle);
    for (let step = 1; step <= 10; step++) await touch("touchMove", middle + 12 * step);
    await touch("touchEnd");
    await page.waitForFunction((most) => scrollY < most, top - 60);
    assert.equal(await launch(), before, id);
    const now = await page.locator(id).boundingBox();
    await page.touchscreen.tap(left, Math.round(now.y + 0.4 * now.height));
    await drawn(page);
    assert.notEqual(await launch(), before, id);
  }
  await close(page);
});

test("the curve has the launch on it, and moving the point throws another one", async () => {
  const page = await open(browser, "coin=us-quarter&turn=38rev/s&psi=60deg&speed=2.4", { until: "scene" });
  const curve = page.locator("#fair-curve");
  const shown = async () => {
    await drawn(page);
    return curve.getAttribute("aria-valuetext");
  };
  const words = async () => {
    await drawn(page);
    return text(page, "fair-words");
  };
  // 1/2 + asin(cot² 60°)/π = 0.60817
  assert.equal(await shown(), "ψ 60.0°, 60.8 % heads");
  assert.match(await words(), /60\.8 % land heads/);
  assert.match(await text(page, "fair-share"), /heads (59|60|61|62)\.\d % of this flight/);
  await curve.press("ArrowRight");
  assert.equal(await page.inputValue("#psi"), "61deg");
  assert.equal(await page.inputValue("#turn"), "38rev/s");
  const { width, height } = await curve.boundingBox();
  // The axis of 0° to 90° goes from 52 to 388 of 400. A click at a place in an element waits until the element stands still.
  await curve.click({ position: { x: ((52 + 336 / 2) / 400) * width, y: height / 2 } });
  assert.match(await shown(), /^ψ 4[45]\.\d°, (100|9\d\.\d+) % heads/);
  await page.fill("#tilt", "20deg");
  assert.match(await words(), /beside the curve/);
  await page.fill("#turn", "1rev/s");
  assert.match(await words(), /too few/);
  await page.fill("#turn", "1000rev/s");
  await drawn(page);
  assert.ok(await page.locator("#fair-strip").isHidden());
  await page.click("[data-preset=racket]");
  await drawn(page);
  assert.ok(await curve.isHidden());
  assert.ok(await page.locator("#fair-strip").isVisible());
  await page.fill("#rate-x", "500");
  await drawn(page);
  assert.ok(await page.locator("#fair-strip").isHidden());
  await close(page);
});

test("the lesson steps through its cards, and a link keeps the step", async () => {
  const page = await open(browser, "", { until: "scene" });
  await page.click("#lesson-start");
  const seen = [];
  for (let step = 1; step <= 5; step++) {
    await drawn(page);
    assert.match(await text(page, "lesson-words"), new RegExp(`^${step} of 5: `));
    seen.push(await page.locator("section.spotlight").getAttribute("id"));
    assert.ok(await page.locator("section.spotlight h2, section.spotlight canvas").first().isVisible());
    if (step === 2) assert.match(await address(page), /lesson=2/);
    await page.click("#lesson-next");
  }
  assert.deepEqual(seen, ["flight", "fair", "hand", "people", "answer"]);
  assert.ok(await page.locator("#lesson").isHidden());
  assert.ok(!(await address(page)).includes("lesson"));
  await close(page);
});

test("a class's own counts are drawn, explained by ψ, and kept by the address; what is wrong is named", async () => {
  const page = await open(browser, "", { until: "scene" });
  const counts = (typed) => page.fill("#people-counts", typed);
  const words = async (expected) => {
    await page.waitForFunction((expected) => document.getElementById("people-words").textContent.includes(expected), expected);
    return text(page, "people-words");
  };
  await counts("person;same;tosses\nAda;11;20\nBen;9;20\nCem;12;20\nDora;10;20\nEli;13;20\nFay;8;20");
  // As `inverse --counts` says of the same file: 0.4027 to 0.6446.
  assert.match(await words("63 of 120"), /mean is 0\.525, from 0\.403 to 0\.645 .* ψ = 74\.4°.*band in the curve/);
  assert.equal(await page.locator("#people-plot line.person").count(), 6);
  assert.ok(Number(await page.locator("#fair-curve .band").getAttribute("width")) > 50);
  const link = await address(page);
  const again = await open(browser, link);
  assert.match(await again.inputValue("#people-counts"), /Fay;8;20$/);
  await close(again);
  await counts("person\tstart\tlands\trule\nAda\tH\tHHTHT TTHHT\tlast\nBen\tH\tHHHTTTTTTT\tfixed\n");
  assert.match(await words("8 of 20"), /From the earlier half of the flips to the later the share changes by −0\.\d+, from −/);
  for (const [typed, message] of [
    ["Ada, 11", "line 1, column 1: same is missing"], ["1,2\n3", "line 2, column 1: 1 cell, but the heading has 2"],
    ["Ada, 21, 20", "line 1, column 2: same = 21.0 is outside its valid range"], ["start,lands\nH,HX", "line 2, column 2: lands = 'X at place 2'"],
  ]) {
    await counts(typed);
    await page.waitForFunction((message) => document.getElementById("people-error").textContent.includes(message), message);
    assert.equal(await page.locator("#people-plot svg").count(), 0);
  }
  await counts("");
  await page.waitForFunction(() => document.getElementById("people-error").hidden);
  await close(page);
});

test("on every screen the sliders can be held, the presets seen and the buttons hit", async () => {
  for (const [width, height] of [[320, 640], [390, 844], [844, 390], [1280, 800]]) {
    const page = await open(browser, "", { until: "scene", viewport: { width, height } });
    const boxes = (selector) => page.locator(selector).evaluateAll((all) => all.map((one) => one.getBoundingClientRect()).filter((box) => box.width > 0));
    for (const box of await boxes(".quantity input[type=range]")) assert.ok(box.width >= 100, `${width}: ${box.width}`);
    for (const box of await boxes("#presets button")) assert.ok(box.left >= 0 && box.right <= width, `${width}: ${box.right}`);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width}`);
    const isPhone = width < 560 || height < 500;
    for (const box of await boxes("button, select, input:not([type=radio]), textarea, label:has(input[type=radio])")) {
      const least = isPhone ? 44 : 24;
      assert.ok(box.height >= least && box.width >= Math.min(least, 40), `${width}: ${box.width} × ${box.height}`);
    }
    await close(page);
  }
});

test("a hundred throws are counted, drawn, and forgotten with their hand", async () => {
  const page = await open(browser, "preset=quarter", { before: () => (crypto.getRandomValues = (into) => into.fill(7)) });
  await page.waitForFunction(() => document.getElementById("chance").dataset.probability, null, { timeout: 120_000 });
  const probability = Number(await page.getAttribute("#chance", "data-probability"));
  assert.ok(probability > 0.2 && probability < 0.8, `${probability}`);
  for (const total of [100, 200]) {
    await page.click("#throw-many");
    const [, heads, thrown] = (await text(page, "thrown-count")).match(/^(\d+) heads in (\d+) throws/).map(Number);
    assert.equal(thrown, total);
    // Five standard deviations of as many throws.
    assert.ok(Math.abs(heads / thrown - probability) < 5 * Math.sqrt(probability * (1 - probability) / 100), `${heads} of ${thrown}, ${probability}`);
    assert.equal(await page.locator("#plot-throws canvas").count(), 1);
  }
  await page.fill("#spread", "20%");
  assert.equal(await text(page, "thrown-count"), "");
  assert.equal(await page.locator("#plot-throws canvas").count(), 0);
  await close(page);
});

test("the picture and the flight are saved as they are shown", async () => {
  const page = await open(browser, "preset=tails", { until: "scene" });
  const saved = async (id) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(id)]);
    return readFileSync(await download.path());
  };
  const picture = await saved("#save-picture");
  assert.deepEqual([...picture.subarray(1, 4)].map((code) => String.fromCharCode(code)).join(""), "PNG");
  assert.ok(picture.length > 10_000);
  const [head, ...lines] = String(await saved("#save-data")).trim().split("\n");
  assert.equal(head.split(",").length, 12);
  const cosTilt = Number((await text(page, "cos-tilt")).replace("\u2212", "-"));
  assert.ok(Math.abs(Number(lines.at(-1).split(",")[1]) - cosTilt) < 1e-12);
  assert.ok(lines.length >= 240 && lines.every((line) => line.split(",").every((part) => Number.isFinite(Number(part)))));
  await close(page);
});

test("the theme is remembered, and copying says where the link works", async () => {
  const page = await open(browser, "", { until: "scene", permissions: ["clipboard-write", "clipboard-read"] });
  const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
  const first = await theme();
  await page.click("#theme");
  await page.reload();
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  assert.notEqual(await theme(), first);
  await page.click("#copy");
  await page.waitForFunction(() => document.getElementById("copied").textContent);
  assert.match(await text(page, "copied"), /on this computer only|address bar/);
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
