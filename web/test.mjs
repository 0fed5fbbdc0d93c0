// The page in a real browser: node web/test.mjs PAGE PICTURES
//
// Needs playwright-core and a Chromium: CHROMIUM names it. What is clicked is found by what the page tells screen readers.
import { createServer } from "node:http";
import { mkdir, readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import { createRequire } from "node:module";

const [page_folder, pictures] = process.argv.slice(2);
const require = createRequire(join(process.env.NODE_MODULES ?? process.cwd(), "/"));
const { chromium } = require("playwright-core");
await mkdir(pictures, { recursive: true });

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".svg": "image/svg+xml" };
const server = createServer(async (request, answer) => {
  const path = normalize(new URL(request.url, "http://x").pathname.replace(/\/$/, "/index.html"));
  try {
    const body = await readFile(join(page_folder, path));
    answer.writeHead(200, { "Content-Type": types[extname(path)] ?? "application/octet-stream" }).end(body);
  } catch {
    answer.writeHead(404).end();
  }
});
await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
const address = `http://127.0.0.1:${server.address().port}/`;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true });
const page = await context.newPage();
const faults = [];
page.on("pageerror", (error) => faults.push(`page: ${error}`));
page.on("console", (line) => line.type() === "error" && faults.push(`console: ${line.text()}`));
const outside = [];
page.on("request", (request) => request.url().startsWith(address) || /^(blob|data):/.test(request.url()) || outside.push(request.url()));

const told = () => page.evaluate(() => window.squeezefilm?.() ?? null);
async function until(what, ready, seconds = 60) {
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

const began = Date.now();
await page.goto(address);
const first = await until("the first solve", ({ run }) => run && run.fidelity === "fine");
console.log(`    the first solve at fine was shown ${((Date.now() - began) / 1000).toFixed(2)} s after the address was entered`);
check(`α of the fundamental case: ${first.run.alpha}`, Math.abs(first.run.alpha - 0.2417) < 0.01);
await picture("start");
export { address, browser, check, click, context, faults, outside, page, picture, place, pictures, server, told, until };
