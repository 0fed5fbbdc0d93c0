// The page in Firefox: node web/firefox.mjs PAGE PICTURE
//
// Needs puppeteer-core, a Firefox, which FIREFOX names, and a display: without one Firefox has no WebGL.
import { createRequire } from "node:module";
import { join } from "node:path";
import { serve } from "./serve.mjs";

const [folder, picture] = process.argv.slice(2);
const require = createRequire(join(process.env.NODE_MODULES ?? process.cwd(), "/"));
const puppeteer = require("puppeteer-core");
const { server, address } = await serve(folder);
const browser = await puppeteer.launch({
  browser: "firefox",
  executablePath: process.env.FIREFOX,
  headless: false,
  timeout: 120_000,
  extraPrefsFirefox: { "webgl.force-enabled": true },
});
const page = await browser.newPage();
const faults = [];
page.on("pageerror", (error) => faults.push(error.message));
page.on("console", (line) => line.type() === "error" && faults.push(line.text()));
await page.setViewport({ width: 1280, height: 800 });

async function until(what, ready) {
  for (let tries = 0; tries < 1800; tries++) {
    const now = await page.evaluate(() => window.shown?.() ?? null);
    if (now && ready(now)) {
      console.log(`ok  Firefox: ${what}`);
      return now;
    }
    await new Promise((later) => setTimeout(later, 100));
  }
  const message = await page.evaluate(() => document.getElementById("message")?.textContent);
  throw new Error(`${what}: did not happen in Firefox; ${message}; ${faults.join("; ")}`);
}
const solved = ({ run }) => run?.fidelity === "fine";

await page.goto(address);
const first = await until("the first solve", solved);
await page.keyboard.press("Escape");

// H_m, by its slider.
const { box } = first.nodes.find(({ role, label }) => role === "Slider" && label?.startsWith("Minimum spacing"));
const [x, y, width] = [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2, box[2] - box[0]];
await page.mouse.move(x, y);
await page.mouse.down();
await page.mouse.move(x - 0.2 * width, y, { steps: 10 });
await page.mouse.up();
const { alpha } = first.run.numbers;
await until("H_m is dragged, and α is greater", (now) => solved(now) && now.run.numbers.alpha > alpha + 0.01);
await page.screenshot({ path: picture });

await page.goto(`${address}#lesson=1&step=1`);
await page.reload();
await until("a link is a lesson", ({ nodes }) => nodes.some(({ label, value }) => /bicycle pump/.test(`${label} ${value}`)));

await browser.close();
server.close();
if (faults.length > 0) throw new Error(`faults were told: ${faults.join("; ")}`);
