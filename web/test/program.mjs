// SPDX-License-Identifier: MIT
// What the tests run: the program, and Chromium, or for firefox.test.mjs Firefox, on the pages that it writes.

import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { test } from "node:test";
import { chromium } from "playwright-core";
import { chromiumPath } from "../chromium.mjs";
import { Firefox, hasFirefox } from "./firefox.mjs";
import { FirefoxPage } from "./firefox-page.mjs";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
export const folder = mkdtempSync(join(tmpdir(), "allpairs-page-"));
export const pages = process.env.ALLPAIRS_PAGES ?? folder;
if (pages !== folder) process.once("exit", () => rmSync(folder, { recursive: true, force: true })); // else it has the screenshots
const program = process.env.ALLPAIRS ?? join(root, "build/dev/bin/allpairs");
const many = { encoding: "utf8", maxBuffer: 1 << 30 };

export const allpairs = (...args) => execFileSync(program, args, many);
export const verdicts = (...args) => execFileSync(process.env.ALLPAIRS_VERDICTS ?? join(root, "build/dev/bin/dump_verdicts"), args, many);
export const detect = (...args) => JSON.parse(allpairs("detect", "--format", "json", ...args));
export const screenshot = (page, name) => page.screenshot({ path: join(pages, `${name}.png`) });

/** The folder of real data with known answers, or null; the project carries none of it. One that is named has to be there. */
export function dataFolder() {
  const data = process.env.ALLPAIRS_DATA ?? join(root, "../shared/data");
  if (process.env.ALLPAIRS_DATA !== undefined && !existsSync(data)) throw new Error(`ALLPAIRS_DATA is no folder: ${data}`);
  return existsSync(join(data, "scenes")) ? data : null;
}

/** All scenes below a folder. */
export function scenesIn(data) {
  return readdirSync(join(data, "scenes/examples"), { recursive: true }).filter((name) => name.endsWith(".scn")).map((name) => join(data, "scenes/examples", name));
}

/** The bytes of a float64 .npy file. */
export function npy(shape, numbers) {
  let header = `{'descr': '<f8', 'fortran_order': False, 'shape': (${shape.join(", ")}), }`;
  header = `${header.padEnd(63 - ((header.length + 10) % 64) + header.length)}\n`;
  const head = Buffer.from(`\x93NUMPY\x01\x00\x00\x00${header}`, "latin1");
  head.writeUInt16LE(header.length, 8);
  return Buffer.concat([head, Buffer.from(Float64Array.from(numbers).buffer)]);
}

export function write(name, bytes) {
  const path = join(folder, name);
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, bytes);
  return path;
}

/** A block as an object of an OBJ file. */
export function cuboid(name, min, max) {
  const lines = [`o ${name}`];
  for (let i = 0; i < 8; ++i) lines.push(`v ${[0, 1, 2].map((k) => (i >> k & 1 ? max : min)[k]).join(" ")}`);
  return `${lines.join("\n")}\nf -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3\n`;
}

/** Two blocks that are the same, one in which a pin lies, a bar that clashes by 0.25, and a wedge that only shares a box. */
export function shapes() {
  write("shapes/block.obj", cuboid("block", [0, 0, 0], [4, 4, 4]));
  write("shapes/copy.obj", cuboid("copy", [10, 0, 0], [14, 4, 4]));
  write("shapes/bar.obj", cuboid("bar", [3.75, 1, 1], [10.25, 2, 2]));
  write("shapes/original.obj", cuboid("original", [10, 0, 0], [14, 4, 4]));
  write("shapes/pin.obj", cuboid("pin", [1, 1, 1], [2, 2, 2]));
  write("shapes/wedge.obj", "o wedge\nv 3.5 3.5 9\nv 3.5 9 3.5\nv 9 9 9\nv 3.5 9 9\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  return join(folder, "shapes");
}

/** Whether the program tests shapes: it does, or says that it was built without; anything else is a failure. */
export function hasExact() {
  try {
    execFileSync(program, ["detect", shapes(), "--exact"], { ...many, stdio: ["ignore", "pipe", "pipe"] });
    return true;
  } catch (problem) {
    if (/--exact needs FCL/.test(problem.stderr)) return false;
    throw problem;
  }
}

const clothSide = 9;

/** A cloth that falls on a tetrahedron whose name would be markup. */
function clothAt(time) {
  const lines = ["o cloth"];
  for (let i = 0; i < clothSide ** 2; ++i) {
    const [x, y] = [(i % clothSide) / (clothSide - 1) - 0.5, Math.floor(i / clothSide) / (clothSide - 1) - 0.5];
    lines.push(`v ${x} ${y} ${0.7 - 0.1 * time - 0.1 * time * (x * x + y * y)}`);
  }
  for (let i = 1; i < clothSide * (clothSide - 1); ++i) {
    if (i % clothSide !== 0) lines.push(`f ${i} ${i + 1} ${i + clothSide}`, `f ${i + 1} ${i + clothSide + 1} ${i + clothSide}`);
  }
  lines.push("o <img src=x onerror=alert(1)>", "v -0.2 -0.2 0", "v 0.2 -0.2 0", "v 0 0.25 0", "v 0 0 0.45");
  for (const corners of [[1, 3, 2], [1, 2, 4], [2, 3, 4], [3, 1, 4]]) lines.push(`f ${corners.map((c) => c + clothSide ** 2).join(" ")}`);
  return `${lines.join("\n")}\n`;
}

/** Mesh files, one for each moment. */
export const clothFrames = (count) => Array.from({ length: count }, (_, time) => write(`cloth${time}.obj`, clothAt(time)));

const args = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];
export const isFirefox = basename(process.argv[1]) === "firefox.test.mjs"; // which imports other files of tests
let browser;

/** Firefox, with which several files of tests begin, starts once. */
export async function startBrowser(...more) {
  if (isFirefox) browser ??= hasFirefox ? Firefox.start(1920, 1200) : undefined;
  else browser = chromium.launch({ executablePath: chromiumPath(), args: [...args, ...more], timeout: 120_000 });
  return browser;
}

export async function stopBrowser() {
  const running = await browser;
  browser = undefined;
  await (isFirefox ? running?.stop() : running?.close());
}

/** A test of what does not depend on the browser. */
export const inChromium = isFirefox ? () => {} : test;
/** A test in Chromium, and by firefox.test.mjs in Firefox. */
export const inBoth = isFirefox && !hasFirefox ? (name) => test(name, { skip: "Firefox or Xvfb is missing (scripts/packages.txt, group browser)" }) : test;

/** What a page copies, which is asked of the page itself: the clipboard is one for all tests. */
async function copiedBy(page, act) {
  await page.evaluate(() => {
    navigator.clipboard.writeText = async (text) => (document.documentElement.dataset.copied = text);
  });
  await act();
  await page.waitForFunction(() => document.documentElement.dataset.copied);
  return page.evaluate(() => document.documentElement.dataset.copied);
}

/** Opens a file as a page; what it complains about, and what it asks of the network, is kept in `page.problems`. */
export async function open(path, { init, ...options } = {}) {
  if (isFirefox) {
    const page = new FirefoxPage(await browser);
    await page.show(path, { init, ...options });
    return page;
  }
  const page = await (await browser).newPage({ viewport: { width: 1280, height: 800 }, ...options });
  if (init) await page.addInitScript(init);
  page.setDefaultTimeout(120_000);
  page.problems = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && page.problems.push(message.text()));
  page.on("pageerror", (problem) => page.problems.push(problem.message));
  page.on("dialog", (dialog) => page.problems.push(`dialog: ${dialog.message()}`) && dialog.dismiss());
  page.on("request", (request) => !/^(file|data|blob):/.test(request.url()) && page.problems.push(request.url()));
  page.download = async (act) => {
    const [saved] = await Promise.all([page.waitForEvent("download"), act()]);
    return readFileSync(await saved.path());
  };
  page.copied = (act) => copiedBy(page, act);
  await page.goto(`file://${path}`, { timeout: 120_000 });
  return page;
}

/** Writes the page of some inputs, opens it and waits for its picture. */
export async function view(name, inputs, { exact = false, ...options } = {}) {
  const path = join(folder, `${name}.html`);
  const group = inputs.includes("--group") ? [] : ["--group", "none"]; // a row for each pair, as detect has them
  allpairs("view", ...inputs, ...group, ...(exact || inputs.includes("--sequence") ? [] : ["--boxes"]), "-o", path);
  const page = await open(path, options);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  return page;
}

/** The text of an element, without that of elements in it. */
export const ownText = (page, selector) => page.$eval(selector, (element) => element.firstChild?.textContent ?? "");
export const number = async (page, selector) => Number((await ownText(page, selector)).replaceAll(",", ""));
export const texts = (page, selector) => page.$$eval(selector, (elements) => elements.map((element) => element.textContent));

/** What `take` gives once it gives the same twice, half a second apart, and is what is waited for; fails after two minutes. */
export async function settled(page, take, isAwaited = () => true) {
  const deadline = Date.now() + 120_000;
  for (let last; ; ) {
    const now = await take();
    if (now === last && isAwaited(now)) return now;
    if (Date.now() > deadline) throw new Error(`what is waited for does not come; last it is ${String(now).slice(0, 80)}`);
    last = now;
    await page.waitForTimeout(500);
  }
}
