// SPDX-License-Identifier: MIT
// The page's rules give the verdicts of the program's, for every pair of models.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { parseScene } from "../src/data.js";
import { coordinate, measure } from "../src/format.js";
import { ExactPairs, state } from "../src/exact.js";
import { csvOf } from "../src/listed.js";
import { masksOf } from "../src/lists.js";
import { pairsAt } from "../src/margin.js";
import { sharedExtents } from "../src/pairs.js";
import { explain } from "../src/rules.js";
import { readZip, writeZip } from "../src/zip.js";
import { allpairs, clothFrames, cuboid, dataFolder, folder, hasExact, root, scenesIn, verdicts, write } from "./program.mjs";

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
  const numbers = [[0, "0"], [0.125, "0.125"], [102360.7, "102361"], [4.97592, "4.9759"], [99999.6, "100000"], [-12.5, "−12.5"], [NaN, "NaN"], [1234.56, "1234.6"], [0.00012345678, "0.00012346"], [5.000000000000001, "5"], [1e9, "1000000000"], [0.1 + 0.2, "0.3"]];
  for (const [value, text] of numbers) assert.equal(measure(value), text);
});

test("coordinates are written as in the report", () => {
  // The same list is in tests/view/ReportTextTest.cpp, for the report.
  const numbers = [[123463.75, "123463.75"], [-5400123.456, "−5400123.46"], [999.996, "1000"], [1234.56, "1234.56"], [12.34567, "12.346"], [1e6, "1000000"], [123456789012.34, "123456789012.34"], [12345678901234.56, "12345678901234.6"]];
  for (const [value, text] of numbers) assert.equal(coordinate(value), text);
});

test("a name that may be a formula is written as in the report's table", () => {
  const names = ["=1+1", "'=1+1", "''-x", "'a", "a=1", "-inf", "'", "\t1"]; // "-inf" is a number that JSON has not
  const fields = csvOf(names.map((name) => ({ name }))).trimEnd().split("\n").slice(1);
  assert.deepEqual(fields, ["'=1+1", "''=1+1", "'''-x", "'a", "a=1", "-inf", "'", "'\t1"]);
});

test("boxes that meet at infinity touch there, as in the report", () => {
  const boxes = Float64Array.of(Infinity, 0, 0, Infinity, 2, 2, 0, 1, 0, Infinity, 3, Infinity);
  assert.deepEqual(sharedExtents(boxes, 0, 1), [0, 1, 2]);
});

test("pairs are ordered as in the report: by state, then the deepest, then the nearest", () => {
  const found = [["touching", 0.01, 0], ["touching", 0.03, 0], ["clearance", NaN, 2], ["touching", 0.02, 0], ["clearance", NaN, 1], ["clash", 0.1, 0], ["clash", NaN, 0]];
  const exactNumbers = new Float64Array(17 * found.length);
  found.forEach(([, depth, distance], e) => exactNumbers.set([distance, depth], 17 * e));
  const exact = new ExactPairs({}, { exactStates: Uint8Array.from(found, ([name]) => state[name]), exactNumbers });
  assert.deepEqual(exact.worstFirst([0, 1, 2, 3, 4, 5, 6]), [5, 6, 1, 3, 0, 4, 2]);
});

test("pairs that are equally bad are in one order in the page, the report and the table of detect", { skip: hasExact() ? false : "built without FCL" }, () => {
  const pair = (i, size) => cuboid(`left${i}`, [20 * i, 0, 0], [20 * i + 4, size, size]) + cuboid(`right${i}`, [20 * i + 3.75, 0, 0], [20 * i + 8, size, size]);
  const input = write("equal.obj", [1, 4, 2, 8].map((size, i) => pair(i, size)).join("")); // each 0.25 deep, of several volumes
  allpairs("report", input, "-o", join(folder, "equal"));
  const report = readFileSync(join(folder, "equal/clashes.csv"), "utf8").trim().split("\n").slice(1).map((row) => row.split(",")[1]);
  const scene = sceneOf(input);
  const page = scene.exact.worstFirst([0, 1, 2, 3]).map((entry) => scene.nameOf(scene.frames[0].pairs[2 * entry]));
  const table = [...allpairs("detect", input, "--exact").matchAll(/^ +clash +(\S+) /gm)].map(([, name]) => name);
  assert.deepEqual({ report, page, table }, { report: table, page: table, table });
  assert.deepEqual(report.map((name) => name.slice(-1)), ["0", "1", "2", "3"], "as they were found");
});

test("a margin with more pairs than the page can hold is refused, and excluded ones are left out", () => {
  const models = 2001; // in one place: 2,001,000 pairs
  const boxes = Float64Array.from({ length: 6 * models }, (_, i) => (i % 6 < 3 ? 0 : 1));
  const numbers = Uint32Array.from({ length: models }, (_, i) => i);
  const scene = { models, addsContactDistances: false, contactDistances: new Float64Array(models), groupSets: [[], [1]], groups: new Uint32Array(models), owners: numbers, sequence: null };
  const frame = { boxes, flags: new Uint8Array(models).fill(7) };
  assert.equal(pairsAt(scene, frame, 0), null);
  const found = pairsAt({ ...scene, groups: new Uint32Array(models).fill(1) }, frame, 0);
  assert.deepEqual(found, { pairs: new Uint32Array(), excluded: new Uint32Array(), leavesOutExcluded: true });
});

test("an archive of more files than 16 bits count is refused, not cut", () => {
  const entry = { name: "a", method: 0, moment: 0, checksum: 0, length: 0, packed: new Uint8Array() };
  const bytesOf = (parts) => Buffer.concat(parts.map((part) => Buffer.from(part.buffer ?? part, part.byteOffset, part.byteLength)));
  const most = bytesOf(writeZip(new Array(65_534).fill(entry)));
  assert.equal(readZip(most).length, 65_534);
  assert.throws(() => writeZip(new Array(65_535).fill(entry)), /too many topics/);
  most.fill(0xff, most.length - 14, most.length - 10); // both counts, as in a zip64 archive
  assert.throws(() => readZip(most), /too many topics/);
});

test("models are found by the names of their bodies too, which rows of several pairs show", () => {
  const scene = { models: 2, hasBodies: true, nameOf: (i) => ["block", "pin"][i], bodyNameOf: (i) => ["X1.obj", "x2.obj"][i] };
  assert.deepEqual(masksOf(scene, "x1").map((mask) => [...mask]), [[1, 0]]);
  assert.deepEqual(masksOf(scene, "pin X2 block").map((mask) => [...mask]), [[0, 1], [0, 1], [1, 0]]);
});
