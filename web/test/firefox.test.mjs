// SPDX-License-Identifier: MIT
// The page in Firefox, as far as it may differ from Chromium: it loads, draws, searches, plays and obeys keys. The tests of both
// browsers are in the files that are imported here.

import assert from "node:assert/strict";
import { join } from "node:path";
import { before } from "node:test";
import { FirefoxPage } from "./firefox-page.mjs";
import { drawn } from "./pictures.mjs";
import { allpairs, clothFrames, detect, folder, inBoth, pages, root, startBrowser, write } from "./program.mjs";
import "./explore.test.mjs";
import "./layout.test.mjs";
import "./page.test.mjs";

let browser;
before(async () => (browser = await startBrowser()));

const text = (selector) => browser.run(`return document.querySelector(${JSON.stringify(selector)}).textContent`);
const count = async (selector) => Number((await browser.run(`return document.querySelector("${selector}").firstChild.textContent`)).replaceAll(",", ""));

async function view(name, ...inputs) {
  const path = join(folder, `${name}.html`);
  allpairs("view", ...inputs, "--group", "none", ...(inputs.includes("--sequence") ? [] : ["--boxes"]), "-o", path);
  await browser.open(path);
  await browser.until("document.documentElement.dataset.ready");
  assert.equal(await text("#no-picture"), "");
}

async function picture(name) {
  await browser.screenshot(join(pages, `${name}.png`));
}

inBoth("Firefox shows the numbers of detect, draws, and obeys keys", async () => {
  const demo = join(root, "examples/scenes/demo.scn");
  const result = detect(demo);
  await view("firefox-demo", demo);
  assert.equal(await count("#fact-models"), result.models.length);
  assert.equal(await count("#fact-pairs"), result.pairs.length);
  await picture("firefox-demo");
  const page = new FirefoxPage(browser);
  const withBoxes = await drawn(page);
  assert.equal(await drawn(page), withBoxes);
  await browser.press("b");
  await browser.until("document.querySelector('#show-boxes[aria-pressed=false]') !== null");
  assert.notEqual(await drawn(page), withBoxes);
  await picture("firefox-shapes");
  await browser.press("j");
  await browser.until("document.querySelectorAll('#pairs-list [aria-selected=true]').length === 1");
  assert.equal(await text("#details .link.first"), result.models[result.pairs[0][0]].name);
  await picture("firefox-pair");
  assert.match(await browser.run("return location.hash"), /^#pair=/);
});

inBoth("Firefox plays meshes that move, and shows names as text", async () => {
  const files = clothFrames(5);
  const track = JSON.parse(allpairs("track", ...files, "--format", "json"));
  await view("firefox-cloth", "--sequence", ...files);
  for (const pairs of track.pairs) {
    assert.equal(await count("#fact-pairs"), pairs);
    await browser.press(".");
  }
  await browser.press(" ");
  await browser.until("document.getElementById('time-frame').textContent === 'Frame 1 of 0 to 4'");
  await browser.press(" ");
  await picture("firefox-cloth");
  assert.equal(await browser.run("return document.images.length"), 0);
});

inBoth("Firefox keeps comments of a report, sends them out with the BCF, and sorts", async () => {
  const boxes = write("firefox-report.csv", "a,0,0,0,2,2,2\nb,1,1,1,3,3,3\nc,1.5,1.5,1.5,4,4,4\n");
  const out = join(folder, "firefox-report");
  allpairs("report", boxes, "-o", out);
  await browser.open(join(out, "index.html"));
  await browser.until("document.documentElement.dataset.ready");
  const fill = (selector, value, event) => browser.run(`const field = document.querySelector("${selector}"); field.value = "${value}"; field.dispatchEvent(new Event("${event}"))`);
  await fill("figure textarea", "not so deep", "input");
  await fill("figure select", "Accepted", "change");
  await browser.run("delete document.documentElement.dataset.ready; location.reload()");
  await browser.until("document.documentElement.dataset.ready && document.querySelector('figure textarea').value === 'not so deep'");
  assert.equal(await browser.run("return document.querySelector('figure select').value"), "Accepted");
  await browser.run("[...document.querySelectorAll('thead button')].find((button) => button.textContent === 'second').click()");
  const seconds = await browser.run("return [...document.querySelectorAll('tbody tr')].map((row) => row.cells[2].textContent)");
  assert.deepEqual(seconds, [...seconds].sort());
  await browser.run("document.querySelector('button.bcf').click()");
  const saved = (await browser.downloaded("clashes.bcf")).toString("latin1");
  assert.ok(saved.includes("<Comment>not so deep</Comment>") && saved.includes('TopicStatus="Accepted"'));
  assert.equal(await text(".problem"), "");
  await picture("firefox-report");
});
