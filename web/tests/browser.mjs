// The page in headless Chromium, from its folder on the disk, and what the tests share.
import assert from "node:assert/strict";
import { existsSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const target = process.env.CARGO_TARGET_DIR ?? join(root, "target");

/** The folder of the page. */
export const PAGE = join(root, "target/web");
/** The command line, by which the page is judged. */
export const PROGRAM = join(target, "release/unfair-toss");
/** Where pictures go. */
export const PICTURES = join(root, "target/web-pictures");
/** The picture of the README. */
export const PICTURE = join(root, "docs/page.png");

mkdirSync(PICTURES, { recursive: true });
const index = pathToFileURL(join(PAGE, "index.html")).href;
const found = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/google-chrome"].find((path) => path && existsSync(path));

/**
 * Starts the browser. It does without a sandbox, which a container does not give, and without a graphics card: WebGL alone
 * is emulated, as an emulated card would take twice as long for the rest of the page.
 */
export const launchBrowser = () =>
  chromium.launch({
    executablePath: found,
    args: ["--no-sandbox", "--use-angle=swiftshader-webgl", "--enable-unsafe-swiftshader", "--disable-background-networking"],
  });

/** What the browser says because it has to copy what WebGL draws. */
const COPIED = "GPU stall due to ReadPixels";

/**
 * Opens the page at `address`, the part behind the #, and waits for its first answer, or for the scene too, or for an error
 * that ends the wait. Whatever the console says, and every request that is not for a file of the page, is kept in
 * `page.faults`. `before` runs in the page before its scripts.
 */
export async function open(browser, address = "", { until = "answer", before = null, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: "reduce", ...options });
  context.setDefaultTimeout(120_000);
  const page = await context.newPage();
  if (until === "answer") await page.addInitScript(withoutScene);
  if (before) await page.addInitScript(before);
  page.faults = [];
  const isFault = (message) => ["error", "warning"].includes(message.type()) && !message.text().includes(COPIED);
  page.on("console", (message) => isFault(message) && page.faults.push(message.text()));
  page.on("pageerror", (error) => page.faults.push(error.message));
  page.on("request", (request) => !isOwn(request.url()) && page.faults.push(`a request for ${request.url()}`));
  const thrown = new Promise((_, reject) => page.once("pageerror", reject));
  await Promise.race([thrown, page.goto(address ? `${index}#${address}` : index).then(() => ready(page, until))]);
  return page;
}

/** A page that waits for its answer alone draws no scene, which takes most of its time without a graphics card. */
const withoutScene = () => Object.defineProperty(window, "makeScene", { set: () => {}, get: () => null });

const isOwn = (url) => url.startsWith(pathToFileURL(PAGE).href) || url.startsWith("data:") || url.startsWith("blob:");

/** Waits for the first answer, or for the scene; the page says when there will be none. */
export async function ready(page, until) {
  await page.waitForFunction(
    (until) => ["scene", "never", until].includes(document.documentElement.dataset.ready),
    until,
    { timeout: 180_000 },
  );
  const hasFailed = await page.evaluate(() => document.documentElement.dataset.ready === "never");
  if (hasFailed) assert.fail(`the page can't start: ${await text(page, "proof")}`);
}

/** Closes a page that had no faults. */
export async function close(page) {
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/** What the page answers, as its reader sees it, with a plain minus. */
export const answer = (page) =>
  page.evaluate(() => ({
    outcome: document.getElementById("outcome").className,
    isProven: document.getElementById("proof").textContent.startsWith("proven"),
    cosTilt: document.getElementById("cos-tilt").textContent.replace("\u2212", "-"),
    margins: Object.fromEntries(
      [...document.querySelectorAll("#margins tr")].map((row) => [row.dataset.input, row.dataset.change]),
    ),
  }));

/** Waits until what was done is drawn: the page answers at once, and draws in one of the next frames. */
export const drawn = (page) =>
  page.evaluate(async () => {
    for (let frame = 0; frame < 3; frame++) await new Promise(requestAnimationFrame);
    await new Promise((done) => setTimeout(done));
  });

/** The text of an element. */
export const text = (page, id) => page.locator(`#${id}`).innerText();

/** The part of the address behind the #, once the page has written it. */
export async function address(page) {
  await page.waitForFunction(() => location.hash.slice(1) === window.tossAddress());
  return page.evaluate(() => location.hash.slice(1));
}
