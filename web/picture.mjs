// SPDX-License-Identifier: MIT
// Takes docs/images/viewer.png: the page of a gear train on a plate. ALLPAIRS is the program, or that of build/release.

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { chromiumPath } from "./chromium.mjs";

const root = resolve(fileURLToPath(new URL("..", import.meta.url)));
const folder = mkdtempSync(join(tmpdir(), "allpairs-picture-"));
const parts = join(folder, "gear train");
const circle = (radius, steps) => Array.from({ length: steps }, (_, i) => [radius * Math.cos((2 * Math.PI * i) / steps), radius * Math.sin((2 * Math.PI * i) / steps)]);

/** Rings of points, each joined to the next; the last to the first, or where the part is solid both closed by fans. */
function write(name, rings, isSolid) {
  const count = rings[0].length;
  const middle = (ring) => [0, 1, 2].map((k) => ring.reduce((sum, point) => sum + point[k], 0) / count);
  const ends = isSolid ? [rings[0], rings.at(-1)].map(middle) : [];
  const lines = [...rings.flat(), ...ends].map((point) => `v ${point.map((x) => x.toFixed(6)).join(" ")}`);
  const [top, last] = [rings.length * count + 1, (rings.length - 1) * count + 1];
  for (let i = 0; i < count; ++i) {
    const j = (i + 1) % count;
    if (isSolid) lines.push(`f ${1 + j} ${1 + i} ${top}`, `f ${last + i} ${last + j} ${top + 1}`);
    for (let ring = 0; ring < rings.length - (isSolid ? 1 : 0); ++ring) {
      const [here, next] = [ring, (ring + 1) % rings.length].map((k) => k * count + 1);
      lines.push(`f ${here + i} ${here + j} ${next + j}`, `f ${here + i} ${next + j} ${next + i}`);
    }
  }
  writeFileSync(join(parts, `${name}.obj`), `o ${name}\n${lines.join("\n")}\n`);
}

/** A ring of an outline at a height; `turn` says where an axis along z goes. */
const ringAt = (outline, [x, y], z, turn = (p) => p) => outline.map(([u, v]) => turn([x + u, y + v, z]));

/** Disks on each other, [radius, low, high] from below. */
function turned(name, centre, disks, turn) {
  write(name, disks.flatMap(([radius, low, high]) => [low, high].map((z) => ringAt(circle(radius, 48), centre, z, turn))), true);
}

/** A wheel of a module of 2 with a bore; the middle of a tooth is at `angle`. */
function wheel(name, teeth, centre, angle, [low, high], bore = 2.1) {
  const outline = [];
  const inner = [];
  for (let tooth = 0; tooth < teeth; ++tooth) {
    for (const [part, depth] of [[-0.36, -1.25], [-0.3, -1.2], [-0.15, 0.9], [0.15, 0.9], [0.3, -1.2], [0.36, -1.25]]) {
      const at = angle + (2 * Math.PI * (tooth + part)) / teeth;
      outline.push([(teeth + depth) * Math.cos(at), (teeth + depth) * Math.sin(at)]);
      inner.push([bore * Math.cos(at), bore * Math.sin(at)]);
    }
  }
  write(name, [[outline, low], [outline, high], [inner, high], [inner, low]].map(([ring, z]) => ringAt(ring, centre, z)), false);
}

function block(name, [x0, y0, z0], [x1, y1, z1]) {
  const outline = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
  write(name, [z0, z1].map((z) => ringAt(outline, [0, 0], z)), true);
}

function makeParts() {
  mkdirSync(parts);
  const away = (angle, distance) => [distance * Math.cos(angle), distance * Math.sin(angle)];
  const [left, right] = [away(3.6, 40.4), away(-0.25, 35.4)]; // the second 0.6 too near
  block("plate", [-58, -38, -5], [58, 32, 0]);
  wheel("wheel 24", 24, [0, 0], 3.6, [4, 10]);
  wheel("wheel 16", 16, left, 3.6 + Math.PI + Math.PI / 16, [4, 10]);
  const tooth = Math.round((-0.25 - 3.6) / (Math.PI / 12)) * (Math.PI / 12) + 3.6; // of the large wheel, towards the small one
  wheel("wheel 12", 12, right, -0.25 + Math.PI + Math.PI / 12 - 2 * (tooth + 0.25), [4, 10]);
  wheel("pinion", 14, [0, 0], 0, [12, 18]);
  turned("shaft a", left, [[2, 0, 16]]);
  turned("shaft b", [0, 0], [[2, 0, 24]]);
  turned("shaft c", right, [[2, -1.5, 18]]); // not as far down as that
  for (const [i, place] of [[-52, -32], [52, -32], [52, 26], [-52, 26]].entries()) turned(`screw ${i + 1}`, place, [[1.6, -9, 0], [3.2, 0, 3]]);
  turned("screw 2, again", [52, -32], [[1.6, -9, 0], [3.2, 0, 3]]);
  block("beam", [-40, 38, 6], [40, 46, 14]);
  turned("pipe", [-16, 10], [[3, 20, 58]], ([x, y, z]) => [x, z, y]);
}

const args = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];
makeParts();
execFileSync(process.env.ALLPAIRS ?? join(root, "build/release/bin/allpairs"), ["view", parts, "-o", join(folder, "page.html")]);
const browser = await chromium.launch({ executablePath: chromiumPath(), args });
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
await page.goto(`file://${join(folder, "page.html")}`);
await page.waitForFunction(() => document.documentElement.dataset.complete);
for (const key of ["Escape", "a"]) await page.keyboard.press(key);
await page.waitForTimeout(3000); // until the picture rests and is whole
await page.screenshot({ path: join(root, "docs/images/viewer.png") });
await browser.close();
rmSync(folder, { recursive: true });
