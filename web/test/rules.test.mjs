// SPDX-License-Identifier: MIT
// The page's rules give the verdicts of the program's, for every pair of models.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { parseScene } from "../src/data.js";
import { explain } from "../src/rules.js";
import { allpairs, dataFolder, folder, root, scenesIn, verdicts, write } from "./program.mjs";

function sceneOf(...args) {
  const path = join(folder, "rules.html");
  allpairs("view", ...args, "-o", path);
  const page = readFileSync(path, "utf8");
  const script = (id) => page.match(new RegExp(`id="${id}">([^<]*)</script>`))[1];
  return parseScene(script("allpairs-scene"), script("allpairs-arrays"));
}

function pageVerdicts(scene) {
  const lines = [];
  for (let newer = 0; newer < scene.models; ++newer) {
    for (let older = 0; older <= newer; ++older) lines.push({ newer, older, ...explain(scene, scene.frames[0], newer, older) });
  }
  return lines;
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
  const said = pageVerdicts(scene).map((line) => (line.verdict === "flat" ? { newer: line.newer, older: line.older, verdict: "flat" } : line));
  assert.deepEqual(said, programVerdicts(...inputs));
  const found = Array.from(scene.frames[0].pairs);
  assert.deepEqual(said.filter((line) => line.verdict === "pair").map((line) => `${line.newer} ${line.older}`).sort(),
    Array.from({ length: found.length / 2 }, (_, i) => `${found[2 * i]} ${found[2 * i + 1]}`).sort());
}

test("verdicts of the demo are the program's", () => compare(join(root, "examples/scenes/demo.scn")));

test("verdicts of boxes with gaps, empty and infinite ones are the program's", () => {
  compare(write("odd.csv", "0,0,0,1,1,1\n1,1,1,2,2,2\n5,0,0,6,1,1\n1,0,0,0,1,1\n-inf,0,0,inf,1,1\n0,0,3,1,1,inf\n"));
});

const data = dataFolder();
test("verdicts of real scenes are the program's", { skip: data ? false : "no folder of data" }, () => {
  const roots = ["--data", join(data, "scenes"), "--data", join(data, "scenes/examples")];
  for (const scene of scenesIn(data)) compare(scene, ...roots);
});
