// The page in a real browser: node web/test.mjs PAGE PICTURES
//
// Needs playwright-core and a Chromium: CHROMIUM names it. What is clicked is found by what the page tells screen readers.
import { execFileSync } from "node:child_process";
import { mkdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { createRequire } from "node:module";
import { serve } from "./serve.mjs";

const [page_folder, pictures] = process.argv.slice(2);
const require = createRequire(join(process.env.NODE_MODULES ?? process.cwd(), "/"));
const { chromium } = require("playwright-core");
await mkdir(pictures, { recursive: true });

const { server, address } = await serve(page_folder);

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
// A machine with other work may take its time.
const PATIENCE = 180;
async function opened(options) {
  const context = await browser.newContext(options);
  context.setDefaultTimeout(1000 * PATIENCE);
  return context;
}
const context = await opened({ viewport: { width: 1280, height: 800 }, acceptDownloads: true });
let page = await context.newPage();
const faults = [];
const outside = [];
function watch(page) {
  page.on("pageerror", (error) => faults.push(`page: ${error}`));
  page.on("console", (line) => line.type() === "error" && faults.push(`console: ${line.text()}`));
  page.on("request", (request) => request.url().startsWith(address) || /^(blob|data):/.test(request.url()) || outside.push(request.url()));
}
watch(page);

const told = () => page.evaluate(() => window.shown?.() ?? null);
async function until(what, ready, seconds = PATIENCE) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const now = await told();
    if (now && ready(now)) return now;
    if (Date.now() > end) {
      await page.screenshot({ path: join(pictures, "fault.png") });
      throw new Error(`${what}: did not happen; the page tells ${JSON.stringify(now).slice(0, 2000)}; ${faults.join("; ")}`);
    }
    await page.waitForTimeout(50);
  }
}
const check = (what, holds) => {
  if (!holds) throw new Error(what);
  console.log(`ok  ${what}`);
};
const says = (words) => ({ nodes }) => nodes.some(({ label, value }) => words.test(`${label} ${value}`));
const torque = ({ nodes }) => nodes.some(({ label, role }) => label === "Torque of the ring, N·m" && role === "Image");
const picture = (name) => page.screenshot({ path: join(pictures, `${name}.png`) });
// The middle of what is called so.
async function place(label, role) {
  const { nodes } = await until(`something is called ${label}`, ({ nodes }) => nodes.some((n) => n.label === label && (!role || n.role === role)));
  const found = nodes.find((n) => n.label === label && (!role || n.role === role));
  return { x: (found.box[0] + found.box[2]) / 2, y: (found.box[1] + found.box[3]) / 2, box: found.box };
}
async function click(label, role) {
  const { x, y } = await place(label, role);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.waitForTimeout(150);
  await page.mouse.up();
  await page.waitForTimeout(300);
}

// Why it does not open is said, where it cannot.
for (const [missing, script, words] of [
  ["WebAssembly", () => { delete window.WebAssembly; }, /needs WebAssembly/],
  ["vector instructions", () => { WebAssembly.validate = () => false; }, /too old/],
  ["WebGL", () => { HTMLCanvasElement.prototype.getContext = () => null; }, /does not draw with WebGL/],
]) {
  const without = await opened();
  const poor = await without.newPage();
  await poor.addInitScript(script);
  await poor.goto(address);
  await poor.waitForFunction((words) => new RegExp(words).test(document.getElementById("message").textContent), words.source);
  check(`without ${missing}: ${await poor.textContent("#message")}`, await poor.isVisible("#message"));
  await without.close();
}

const began = Date.now();
await page.goto(address);
const first = await until("the first solve", ({ run }) => run && run.fidelity === "fine");
console.log(`    the first solve at fine was shown ${((Date.now() - began) / 1000).toFixed(2)} s after the address was entered`);
const { alpha } = first.run.numbers;
check(`α of the fundamental case: ${alpha}`, alpha > 0.24 && alpha < 0.25);
await picture("start");

// The tour is for whoever is here for the first time.
await page.keyboard.press("Escape");
await page.waitForTimeout(500);
await picture("solved");

// Labels above the middle, and the button beside them.
const [fit, pin] = [await place("Fit", "Button"), await place("Pin", "Button")];
check("Pin is not over Fit", pin.box[0] >= fit.box[2] || pin.box[1] >= fit.box[3]);

// For screen readers: what is shown, as elements of the page.
const said = page.locator("#said");
check(`the result is said: ${await said.textContent()}`, /Fundamental case: α 0\.24.* fine/.test(await said.textContent()));
const slider = page.getByRole("slider", { name: "Minimum spacing H_m" });
check("a slider is in the page, with its value and range", (await slider.getAttribute("aria-valuenow")) === "200" && (await slider.getAttribute("aria-valuemin")) > 0);
check("another tab is shown", !torque(await told()));
await page.getByRole("button", { name: "Torque", exact: true }).evaluate((button) => button.click());
await until("the tab that was clicked there", torque);
check("a button in the page does what that of the window does", true);
await page.keyboard.press("Control+1");
await until("the first tab", (now) => !torque(now));

// H_m, by its slider.
const spacing = ({ nodes }) => nodes.find((node) => node.role === "Slider" && node.label?.startsWith("Minimum spacing"));
const { x, y, box } = await place("Minimum spacing H_m", "Slider");
const before = spacing(await told()).number;
await page.mouse.move(x, y);
await page.mouse.down();
for (let step = 1; step <= 10; step++) {
  await page.mouse.move(x - (step * (box[2] - box[0])) / 25, y);
  await page.waitForTimeout(60);
}
await page.mouse.up();
const dragged = await until("another α at fine", ({ run }) => run.fidelity === "fine" && run.numbers.alpha !== first.run.numbers.alpha);
const after = spacing(dragged).number;
check(`H_m was dragged from ${before} to ${after} nm, α from ${first.run.numbers.alpha} to ${dragged.run.numbers.alpha}`,
  after < before && dragged.run.numbers.alpha > first.run.numbers.alpha);
await picture("dragged");
await page.waitForFunction((alpha) => !document.getElementById("said").textContent.includes(alpha), `${first.run.numbers.alpha}`.slice(0, 6));
check(`the new result is said: ${await said.textContent()}`, (await slider.getAttribute("aria-valuenow")) === `${after}`);

// What was changed is there after the page was loaded again.
await page.waitForTimeout(4000);
await page.reload();
const again = await until("the scene of before", ({ run }) => run?.fidelity === "fine");
check("a reload brings the scene back", Math.abs(spacing(again).number - after) < 1e-9);

// Without a network.
await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
await context.setOffline(true);
await page.reload();
await until("a solve without a network", ({ run }) => run?.fidelity === "fine");
check("it works without a network", true);
await context.setOffline(false);

// A link, in a page of its own.
async function follow(link, viewport = { width: 1280, height: 800 }, touch = false) {
  const fresh = await opened({ viewport, acceptDownloads: true, hasTouch: touch });
  page = await fresh.newPage();
  watch(page);
  await page.goto(address + link);
  return fresh;
}
let fresh = await follow("#fundamental&film.min_spacing_nm=100&tab=torque");
const linked = await until("the scene of a link", ({ run }) => run?.fidelity === "fine" && /changed: 1 key/.test(run.scene));
await until("its tab", torque);
check(`a link is a scene: α ${linked.run.numbers.alpha}`, linked.run.numbers.alpha > first.run.numbers.alpha);
await page.waitForTimeout(1000);
await picture("torque");

// A sweep, and its table as a download.
await page.keyboard.press("Control+3");
await click("Start the sweep", "Button");
await until("a sweep", ({ nodes }) => nodes.some(({ label }) => label === "Export ▾"));
await page.waitForTimeout(3000);
await picture("sweep");
await click("Export ▾", "Button");
const download = page.waitForEvent("download");
await click("Sweep as table…", "Button");
const table = await readFile(await (await download).path(), "utf8");
check(`a table was downloaded: ${table.split("\n").length} lines`, /alpha/.test(table) && table.split("\n").length > 5);

// Every tab, and what is computed in it.
async function computed(key, button, words, name) {
  check(`${name} is not there yet`, !says(words)(await told()));
  await page.keyboard.press(`Control+${key}`);
  if (button) await click(button, "Button");
  await until(name, says(words), 120);
  await page.waitForTimeout(500);
  await picture(name);
  check(`${name} is computed`, true);
}
await computed("8", null, /Present rotor:/, "rotor");
await computed("9", "Compute sensitivities", /% for 1 % more/, "sensitivity");
await computed("6", "Start from rest", /Cycle \d+: repeats/, "start-up");
await computed("5", "Measure", /accuracy 1%/, "trade-off");
await page.keyboard.press("Control+1");
await page.waitForTimeout(1500);
await picture("motion");
await fresh.close();

// A lesson's first step: what is asked first is answered, its words are said.
const heard = (words) => page.waitForFunction((words) => new RegExp(words).test(document.getElementById("lesson").textContent), words.source);
fresh = await follow("#lesson=1&step=1");
await until("its run", ({ run }) => run?.fidelity === "fine");
await heard(/step 1 of 6: Push on it/);
await picture("lesson");
await click("It is squeezed into half the volume: up to twice the pressure", "RadioButton");
await click("This is my prediction", "Button");
await until("what is to be done then", ({ nodes }) => !nodes.some(({ label }) => label === "This is my prediction"));
await picture("lesson-answered");
await click("Gap", "SpinButton");
await page.keyboard.press("Control+a");
await page.keyboard.type("0.5");
await page.keyboard.press("Enter");
await until("the task is done, and what was seen is asked", says(/What did you see/));
await page.waitForTimeout(500);
await page.keyboard.press("2");
await until("the step is done", ({ nodes }) => nodes.some(({ label }) => label === "Next"));
await picture("lesson-done");
await click("Next", "Button");
await heard(/step 2 of 6/);
check("a lesson's first step is followed", true);
await fresh.close();

// A link to a later step.
fresh = await follow("#lesson=3&step=4");
await until("its run", ({ run }) => run?.fidelity === "fine");
await heard(/step 4 of/);
check("a link is a step of a lesson", true);
await picture("lesson-linked");
await fresh.close();

// What is wrong with a link is told.
fresh = await follow("#fundemental");
await until("what is wrong", says(/begins with a built-in preset/));
check("what is wrong with a link is told", true);
await fresh.close();

// As slow as a class's network is, with nothing else to do.
await context.close();
fresh = await opened({ viewport: { width: 1280, height: 800 } });
page = await fresh.newPage();
watch(page);
const slow = await fresh.newCDPSession(page);
await slow.send("Network.emulateNetworkConditions", { offline: false, latency: 20, downloadThroughput: 10e6 / 8, uploadThroughput: 10e6 / 8 });
const asked = Date.now();
await page.goto(address);
await page.waitForFunction(() => document.getElementById("message")?.textContent !== "Loading…");
console.log(`    at 10 Mbit/s the program was loaded after ${((Date.now() - asked) / 1000).toFixed(2)} s`);
await until("a solve", ({ run }) => run);
console.log(`    and solved after ${((Date.now() - asked) / 1000).toFixed(2)} s`);
await fresh.close();

// Small screens, by fingers.
async function fingers(steps) {
  const line = await page.context().newCDPSession(page);
  for (const [i, points] of steps.entries()) {
    await line.send("Input.dispatchTouchEvent", { type: i ? "touchMove" : "touchStart", touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await page.waitForTimeout(80);
  }
  await line.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await page.waitForTimeout(500);
}
for (const [name, width, height] of [["tablet", 1024, 768], ["phone", 844, 390]]) {
  fresh = await follow("#fundamental", { width, height }, true);
  const before = await until("a motor", ({ run }) => run?.fidelity === "fine");
  await picture(name);
  const { x, y, box } = await place("Minimum spacing H_m", "Slider");
  await fingers([0, 1, 2, 3, 4, 5].map((step) => [[x - (step * (box[2] - box[0])) / 12, y]]));
  const dragged = await until("another α", ({ run }) => run.fidelity === "fine" && run.numbers.alpha !== before.run.numbers.alpha);
  check(`${name}: H_m was dragged by a finger to ${spacing(dragged).number} nm`, spacing(dragged).number < spacing(before).number);
  await page.keyboard.press("Control+4");
  await until("its curve", torque);
  await page.waitForTimeout(1500);
  const { box: chart } = await place("Torque of the ring, N·m", "Image");
  const clip = { x: chart[0], y: chart[1], width: chart[2] - chart[0], height: chart[3] - chart[1] };
  const [middle, level] = [clip.x + clip.width / 2, clip.y + clip.height / 2];
  const wide = await page.screenshot({ clip });
  await fingers([20, 30, 40, 60, 80].map((apart) => [[middle - apart, level], [middle + apart, level]]));
  check(`${name}: a chart is pinched`, !wide.equals(await page.screenshot({ clip })));
  await picture(`${name}-torque`);
  await fresh.close();
  fresh = await follow("#lesson=1&step=1", { width, height }, true);
  await until("a plate", ({ run }) => run?.fidelity === "fine");
  await page.waitForTimeout(800);
  await picture(`${name}-hold`);
  const { box: held } = await place("Held plate: drag it up and down", "Image");
  check(`${name}: lesson 1 has a plate in a drawing ${(held[3] - held[1]).toFixed(0)} points high`, held[3] - held[1] > 60);
  await fresh.close();
}

// The numbers of the program.
if (process.env.SQUEEZEFILM) {
  const presets = ["fundamental", "doubled-mesh", "min-spacing-100nm", "tooth-width-1.16mm", "frequency-20khz", "tooth-radius-6.5m", "levitating",
    "ring-rotor", "asperities", "rough-flow", "plate-crossover", "plate-viscous", "plate-trapped"];
  for (const preset of presets) {
    const native = JSON.parse(execFileSync(process.env.SQUEEZEFILM, ["solve", preset, "--fidelity", "fine", "--json"], { encoding: "utf8" }));
    fresh = await follow(`#${preset}`);
    const { run } = await until(preset, ({ run }) => run?.fidelity === "fine" && run.scene === native.preset);
    const [name, error] = native.alpha === null ? ["mean_load_ratio", "mean_load_ratio_error"] : ["alpha", "alpha_error"];
    const off = Math.abs(run.numbers[name] - native[name]);
    check(`${preset}: ${name} ${run.numbers[name]}, of the program ${native[name]}`, off <= 1e-9 * Math.abs(native[name]) || off < (native[error] ?? 0));
    await fresh.close();
  }
}

check(`nothing was fetched from elsewhere${outside.map((url) => ` ${url}`)}`, outside.length === 0);
check(`no fault was told${faults.map((fault) => `\n    ${fault}`)}`, faults.length === 0);
console.log(`the page works in Chromium, in ${((Date.now() - began) / 1000).toFixed(0)} s`);
await browser.close();
server.close();
