// SPDX-License-Identifier: MIT
// The page's rules give the verdicts of the program's, for every pair of models.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { parseScene } from "../src/data.js";
import { measure } from "../src/format.js";
import { csvOf } from "../src/listed.js";
import { explain } from "../src/rules.js";
import { allpairs, clothFrames, dataFolder, folder, root, scenesIn, verdicts, write } from "./program.mjs";

function sceneOf(...args) {
  const path = join(folder, "rules.html");
  allpairs("view", ...args, "-o", path);
  const page = readFileSync(path, "utf8");
  const script = (id) => page.match(new RegExp(`id="${id}">([^<]*)</script>`))[1];
  return parseScene(script("allpairs-scene"), script("allpairs-arrays"));
}

function pageVerdicts(scene, frame) {
  const lines = [];
  for (let newer = 0; newer < scene.models; ++newer) {
    for (let older = 0; older <= newer; ++older) lines.push({ newer, older, ...explain(scene, frame, newer, older) });
  }
  return lines.map((line) => (line.verdict === "flat" ? { newer: line.newer, older: line.older, verdict: "flat" } : line));
}

function programVerdicts(...args) {
  return verdicts(...args).trim().split("\n").map((line) => {
    const [newer, older, verdict, axis, gap, group] = line.split(" ");
    const said = { newer: Number(newer), older: Number(older), verdict };
    if (verdict === "apart") Object.assign(said, { axis: Number(axis), gap: Number(gap.replace("inf", "Infinity")) });
    if (verdict === "same-group") said.group = Number(group);
    return said;
  });
}

function compare(...inputs) {
  const scene = sceneOf(...inputs);
  const said = scene.frames.map((frame) => pageVerdicts(scene, frame));
  assert.deepEqual(said.flat(), programVerdicts(...inputs));
  scene.frames.forEach((frame, index) => {
    const found = Array.from({ length: frame.pairs.length / 2 }, (_, i) => `${frame.pairs[2 * i]} ${frame.pairs[2 * i + 1]}`);
    const pairs = said[index].filter((line) => line.verdict === "pair").map((line) => `${line.newer} ${line.older}`);
    assert.deepEqual(pairs.sort(), found.sort(), `frame ${index}`);
  });
  return new Set(said.flat().map((line) => line.verdict));
}

test("verdicts of the demo are the program's", () => compare(join(root, "examples/scenes/demo.scn")));

test("verdicts of a scene with a model for each rule are the program's", () => {
  const said = compare(join(root, "tests/view/rules.scn"));
  assert.deepEqual([...said].sort(), ["apart", "inactive", "no-elements", "no-self", "not-simulated", "outside", "pair", "same-group", "same-owner"]);
  assert.ok(compare(join(root, "tests/view/flat.scn")).has("flat"));
});

test("verdicts of each frame of meshes that move are the program's", () => {
  const said = compare("--sequence", ...clothFrames(3));
  assert.deepEqual([...said].sort(), ["apart", "no-self", "pair", "shares-vertex"]);
});

test("verdicts of boxes with gaps, empty and infinite ones are the program's", () => {
  compare(write("odd.csv", "0,0,0,1,1,1\n1,1,1,2,2,2\n5,0,0,6,1,1\n1,0,0,0,1,1\n-inf,0,0,inf,1,1\n0,0,3,1,1,inf\n"));
});

const data = dataFolder();
test("verdicts of real scenes are the program's", { skip: data ? false : "no folder of data" }, () => {
  const roots = ["--data", join(data, "scenes"), "--data", join(data, "scenes/examples")];
  for (const scene of scenesIn(data)) compare(scene, ...roots);
});

test("numbers are written as in the report", () => {
  // The same list is in tests/view/PictureTest.cpp, for the report.
  const numbers = [[0, "0"], [0.125, "0.125"], [102360.7, "102361"], [4.97592, "4.9759"], [99999.6, "100000"], [-12.5, "−12.5"], [1234.56, "1234.6"], [0.00012345678, "0.00012346"], [5.000000000000001, "5"], [1e9, "1000000000"], [0.1 + 0.2, "0.3"]];
  for (const [value, text] of numbers) assert.equal(measure(value), text);
});

test("a name that may be a formula is written as in the report's table", () => {
  const names = ["=1+1", "'=1+1", "''-x", "'a", "a=1", "-inf", "'", "\t1"]; // "-inf" is a number that JSON has not
  const fields = csvOf(names.map((name) => ({ name }))).trimEnd().split("\n").slice(1);
  assert.deepEqual(fields, ["'=1+1", "''=1+1", "'''-x", "'a", "a=1", "-inf", "'", "'\t1"]);
});
