// SPDX-License-Identifier: MIT
// What a reader does to see more: the page opens at the worst clash; models are hidden and shown again; bodies move apart;
// points are measured.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";
import { drawn, extentOf } from "./pictures.mjs";
import { allpairs, cuboid, detect, folder, hasExact, inBoth, inChromium, npy, open, root, screenshot, shapes, startBrowser, stopBrowser, texts, view, write } from "./program.mjs";

before(() => startBrowser());
after(stopBrowser);

const skip = hasExact() ? false : "built without FCL";
const nested = () => write("nested.obj", cuboid("shell", [0, 0, 0], [4, 4, 4]) + cuboid("core", [1, 1, 1], [3, 3, 3]));
const extent = async (page) => page.evaluate(extentOf, await drawn(page));

/** The name of the model in the middle of the picture, which is chosen by that. */
async function nameInMiddle(page) {
  const area = await page.locator("#canvas").boundingBox();
  await page.mouse.click(area.x + area.width / 2, area.y + area.height / 2);
  return page.textContent("#details .model-name");
}

inBoth("a page opens at the worst clash, or at what its address says", { skip }, async () => {
  const page = await view("worst", [shapes()], { exact: true });
  assert.deepEqual((await texts(page, "#details .link.first, #details .link.second")).sort(), ["copy", "original"]);
  assert.equal(await page.getAttribute("#pairs-list [aria-selected=true]", "data-index"), "0");
  assert.equal(await page.evaluate(() => location.hash), "", "an address that nobody chose is not written");
  await screenshot(page, "worst");
  await page.close();
  const other = await open(`${join(folder, "worst.html")}#model=pin`);
  await other.waitForFunction(() => document.documentElement.dataset.ready);
  assert.equal(await other.textContent("#details .model-name"), "pin");
  await other.close();
  const without = await view("no-clash", [write("alone.obj", cuboid("alone", [0, 0, 0], [1, 1, 1]))], { exact: true });
  assert.equal(await without.isVisible("#details"), false);
  assert.deepEqual([...page.problems, ...other.problems, ...without.problems], []);
  await without.close();
});

inBoth("models are hidden, shown alone, and shown again", { skip }, async () => {
  const page = await view("hiding", [nested()], { exact: true });
  for (const key of ["Escape", "u", "u", "u"]) await page.keyboard.press(key); // the middle of the whole is in the middle
  assert.equal(await page.isVisible("#hidden-panel"), false);
  const { area: whole } = await extent(page);
  assert.equal(await nameInMiddle(page), "shell");
  await page.keyboard.press("h");
  assert.equal(await page.textContent("#hidden-count"), "1 model hidden");
  assert.equal(await page.isVisible("#details"), false, "what is hidden is not chosen any more");
  const { area: inner } = await extent(page);
  assert.ok(0 < inner && inner < 0.5 * whole, `what is hidden is not drawn: ${inner} of ${whole} pixels`);
  assert.equal(await nameInMiddle(page), "core", "what is hidden is not chosen");
  await screenshot(page, "hidden");
  await page.keyboard.press("z");
  assert.equal(await page.isVisible("#hidden-panel"), false);
  assert.equal(await nameInMiddle(page), "core", "of what is solid and what is faint around it, what is solid");
  await page.keyboard.press("Escape");
  assert.equal(await nameInMiddle(page), "shell");
  await page.click("#details .act:nth-child(2)"); // only the shell
  assert.equal(await page.textContent("#hidden-count"), "1 model hidden");
  assert.equal(await nameInMiddle(page), "shell");
  await page.keyboard.press("h");
  assert.equal(await page.textContent("#hidden-count"), "2 models hidden");
  const area = await page.locator("#canvas").boundingBox();
  await page.mouse.click(area.x + area.width / 2, area.y + area.height / 2);
  assert.equal(await page.isVisible("#details"), false, "nothing is left to choose");
  await page.click("#hidden-undo");
  assert.equal(await nameInMiddle(page), "shell");
  await page.keyboard.press("H");
  assert.equal(await page.isVisible("#hidden-panel"), false);
  await page.keyboard.press("z");
  assert.equal(await page.textContent("#hidden-count"), "1 model hidden", "showing all is taken back too");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("bodies move apart and come back", { skip }, async () => {
  const parts = [[0, 0, 0], [1, 0, 0], [0, 1, 0]].map((low, i) => cuboid(`part ${i}`, low, low.map((x) => x + 1))).join("");
  const page = await view("apart", [write("apart.obj", parts)], { exact: true });
  await page.keyboard.press("Escape");
  await page.keyboard.press("a");
  const together = await drawn(page);
  await page.keyboard.press("x");
  assert.notEqual(await drawn(page), together);
  const height = ({ highest, lowest }) => lowest[1] - highest[1];
  const apart = height(await extent(page));
  await screenshot(page, "apart");
  await page.$eval("#explode-slider", (slider) => {
    slider.value = 150;
    slider.dispatchEvent(new Event("input"));
  });
  const farther = height(await extent(page));
  assert.ok(farther > 1.2 * apart, `the slider says how far: ${farther} pixels, after ${apart}`);
  await page.keyboard.press("x");
  assert.equal(await drawn(page), together);
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("corners of boxes are measured where they are, not where their picture in float32 has them", async () => {
  const page = await view("measure-boxes", [write("wide.csv", "0,0,0,100000001,100000001,100000001\n")]);
  const area = await page.locator("#canvas").boundingBox();
  await page.keyboard.press("d");
  const { highest, lowest } = await extent(page);
  for (const [x, y] of [highest, lowest]) await page.mouse.click(area.x + x, area.y + y);
  assert.equal(await page.textContent("#measure-result"), "173205082 (x 100000001, y 100000001, z 100000001)");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("the distance of two corners is measured, also while bodies are apart", { skip }, async () => {
  const cubes = [cuboid("far", [-8, 8, 0], [-6, 10, 2]), cuboid("middle", [0, 0, 0], [2, 2, 2]), cuboid("near", [8, -8, 0], [10, -6, 2])];
  const page = await view("measure", [write("cubes.obj", cubes.join(""))], { exact: true });
  const area = await page.locator("#canvas").boundingBox();
  await page.keyboard.press("d");
  assert.equal(await page.textContent("#measure-result"), "click the first point");
  for (const isApart of [false, true]) {
    if (isApart) await page.keyboard.press("x");
    const { highest, lowest } = await extent(page);
    for (const [x, y] of [highest, lowest]) {
      assert.match(await page.textContent("#measure-result"), /click/);
      await page.mouse.click(area.x + x, area.y + y);
    }
    assert.equal(await page.textContent("#measure-result"), "25.534 (x 18, y 18, z 2)"); // from the corner that is farthest from the reader to the nearest one
    await screenshot(page, `measure${isApart ? "-apart" : ""}`);
  }
  assert.equal(await page.isVisible("#details"), false, "while points are measured nothing is chosen");
  await page.keyboard.press("Escape");
  assert.equal(await page.isVisible("#measure-panel"), false);
  assert.equal(await nameInMiddle(page), "middle");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("a page of boxes far from zero opens, and what is chosen in a list is shown", async () => {
  const at = [1e16, 1e16, 1e16];
  const page = await view("far-away", [write("far-away.npy", npy([2, 6], [...at, ...at.map((x) => x + 4), ...at, ...at.map((x) => x + 8)]))]);
  await page.keyboard.press("j");
  assert.equal(await page.isVisible("#details"), true);
  await page.keyboard.press("h");
  assert.equal(await page.textContent("#hidden-count"), "2 models hidden");
  await page.click("#pairs-list .row");
  assert.equal(await page.isVisible("#hidden-panel"), false, "what is chosen is not hidden any more");
  assert.equal(await page.isVisible("#section-panel"), false);
  await page.keyboard.press("s");
  assert.equal(await page.isVisible("#section-panel"), false, "there are no shapes to cut");
  assert.deepEqual(page.problems, []);
  await page.close();
});

/** The rows of a CSV by the names of its columns. */
function rowsOf(csv) {
  const [header, ...lines] = csv.trimEnd().split("\n").map((line) => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map(([, cell]) => cell.replace(/^"(.*)"$/, "$1").replaceAll('""', '"')));
  return lines.map((cells) => Object.fromEntries(header.map((name, i) => [name, cells[i]])));
}

/** The numbers of a row as numbers. */
const valuesOf = (row, columns) => columns.map((name) => (row[name] === "" || row[name] === null || Number.isNaN(Number(row[name])) ? row[name] || "" : Number(Number(row[name]).toPrecision(12))));

/** How many colours are in a picture, counted by the page. */
async function coloursOf(png) {
  const image = new Image();
  image.src = `data:image/png;base64,${png}`;
  await image.decode();
  const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d");
  canvas.drawImage(image, 0, 0);
  return new Set(new Uint32Array(canvas.getImageData(0, 0, image.width, image.height).data.buffer)).size;
}

inBoth("what is listed is saved as in the report, as CSV and as JSON, names are copied, and so is the picture", async () => {
  const boxes = write("listed.csv", '"=sum,1",0,0,0,2,2,2\n"b ""x""",1,1,1,3,3,3\nc,1.5,1.5,1.5,4,4,4\nd,9,9,9,9.5,9.5,9.5\n');
  for (const input of hasExact() ? [shapes(), boxes] : [boxes]) {
    allpairs("report", input, "--group", "none", "-o", join(folder, "listed"));
    const expected = rowsOf(readFileSync(join(folder, "listed/clashes.csv"), "utf8"));
    const page = await view("listed", [input], { exact: input !== boxes });
    const saved = async (id) => (await page.download(() => page.click(`#${id}`), id.replace("-", "."))).toString();
    if (input === boxes) await page.selectOption("#pairs-sort", "volume"); // as in the report
    const csv = rowsOf(await saved("pairs-csv"));
    const columns = Object.keys(csv[0]).filter((name) => name !== "kind");
    assert.ok(columns.length >= 7 && columns.every((name) => name in expected[0]), columns.join());
    assert.deepEqual(csv.map((row) => valuesOf(row, columns)), expected.map((row) => valuesOf(row, columns)));
    const json = JSON.parse(await saved("pairs-json"));
    const unquoted = (row) => valuesOf(row, columns).map((value) => (typeof value === "string" ? value.replace(/^'/, "") : value));
    assert.deepEqual(json.map((row) => unquoted(row)), csv.map((row) => unquoted(row)));
    await page.fill("#pairs-search", json[0].first);
    const listed = csv.filter((row) => [row.first, row.second].includes(csv[0].first));
    assert.ok(0 < listed.length && listed.length < csv.length);
    assert.deepEqual(rowsOf(await saved("pairs-csv")).map((row) => [row.first, row.second]), listed.map((row) => [row.first, row.second]), "only what is listed");
    await page.fill("#pairs-search", "no such name");
    assert.equal(await saved("pairs-csv"), `${Object.keys(json[0]).join(",")}\n`, "without an entry it has its columns");
    await page.keyboard.press("Escape");
    await page.click("#tab-models");
    const models = JSON.parse(await saved("models-json"));
    const { models: all } = detect(input);
    assert.deepEqual(models.map((m) => [m.name, [[m.min_x, m.min_y, m.min_z], [m.max_x, m.max_y, m.max_z]]]), all.map((m) => [m.name, m.box]));
    const png = await page.download(() => page.click("#save-picture"), "picture.png");
    const { width, height } = await page.locator("#canvas").boundingBox();
    assert.deepEqual([png.toString("latin1", 1, 4), png.readUInt32BE(16), png.readUInt32BE(20)], ["PNG", Math.round(width), Math.round(height)]);
    assert.ok((await page.evaluate(coloursOf, png.toString("base64"))) > 20, "and something is in it");
    await page.click("#models-list .row");
    assert.equal(await page.copied(() => page.keyboard.press("c")), all[0].name);
    assert.deepEqual(page.problems, []);
    await page.close();
  }
});

/** How many pixels of a picture have the full red of contacts in light, and how many are reddish, counted by the page. */
async function redsOf(png) {
  const image = new Image();
  image.src = `data:image/png;base64,${png}`;
  await image.decode();
  const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d");
  canvas.drawImage(image, 0, 0);
  const { data } = canvas.getImageData(0, 0, image.width, image.height);
  const reds = { full: 0, faint: 0 };
  for (let i = 0; i < data.length; i += 4) {
    const [red, green, blue] = data.slice(i, i + 3);
    if (red > 180 && green < 90 && blue < 60) ++reds.full;
    else if (red > Math.max(green, blue) + 30) ++reds.faint;
  }
  return reds;
}

inChromium("contacts behind a part are faint until they are chosen", { skip }, async () => {
  const blocks = [cuboid("shell", [0, 0, 0], [9, 9, 9]), cuboid("left", [1, 1, 1], [5, 8, 8]), cuboid("right", [4, 2, 2], [8, 7, 7])];
  const page = await view("behind", [write("behind.obj", blocks.join(""))], { exact: true });
  const reds = async () => page.evaluate(redsOf, await drawn(page));
  await page.fill("#pairs-search", "left right");
  await page.click("#pairs-list .row");
  assert.ok((await reds()).full > 200, "the pair that is chosen is in front");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await page.keyboard.press("a");
  const { full, faint } = await reds();
  assert.ok(full < 50, `the shell is in front: ${full} pixels where lines behind it cross`);
  assert.ok(faint > 200, `${faint} pixels of lines behind it`);
  await page.click("#tab-models");
  await page.click('#models-list .row[data-index="0"]');
  await page.keyboard.press("h");
  assert.ok((await reds()).full > 200, "they are there where nothing hides them");
  await screenshot(page, "behind");
  assert.deepEqual(page.problems, []);
  await page.close();
});

/** A building of two walls that cross. */
const twoWalls = () => write("walls.ifc", readFileSync(join(root, "tests/support/IfcText.h"), "utf8").match(/R"\((ISO[^]*)\)";/)[1]);

inBoth("what is saved of an IFC has classes and GlobalIds, as the report has them", async () => {
  const input = twoWalls();
  const exact = hasExact();
  allpairs("report", input, "--group", "none", ...(exact ? [] : ["--boxes"]), "-o", join(folder, "walls"));
  const expected = rowsOf(readFileSync(join(folder, "walls/clashes.csv"), "utf8"));
  const { models } = detect(input);
  const page = await view("walls", [input], { exact });
  const saved = async (id) => (await page.download(() => page.click(`#${id}`), id.replace("-", "."))).toString();
  const columns = ["first", "first_type", "first_id", "second", "second_type", "second_id"];
  const pick = (row) => columns.map((name) => row[name]);
  const named = models.map((model) => [model.name, model.ifcType, model.globalId]);
  assert.deepEqual(expected.map(pick), detect(input).pairs.map((pair) => pair.flatMap((model) => named[model])));
  assert.deepEqual(rowsOf(await saved("pairs-csv")).map(pick), expected.map(pick));
  const saidOfPairs = JSON.parse(await saved("pairs-json"));
  assert.deepEqual(saidOfPairs.map(pick), expected.map(pick));
  await page.click("#tab-models");
  const ofModel = (row) => [row.name, row.ifcType, row.globalId];
  assert.deepEqual(rowsOf(await saved("models-csv")).map(ofModel), named);
  const saidOfModels = JSON.parse(await saved("models-json"));
  assert.deepEqual(saidOfModels.map(ofModel), named);
  for (const [list, said] of [["models", saidOfModels], ["pairs", saidOfPairs]]) {
    await page.click(`#tab-${list}`);
    await page.fill(`#${list}-search`, "no such name");
    assert.equal(await saved(`${list}-csv`), `${Object.keys(said[0]).join(",")}\n`, "without an entry it has its columns");
  }
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("a click chooses a model, and a click on a partner of it their pair", async () => {
  const bits = [[1, 0.9, 2], [12.8, 0.9, -1.2]].map((low) => cuboid("bit", low, low.map((x) => x + 0.2)).replace("o bit\n", "")); // of the third block: its box meets the others
  const blocks = [cuboid("left", [0, 0, 0], [2, 2, 1]), cuboid("right", [1.9, 0, 0], [4, 2, 1]), cuboid("off", [6, 0, 0], [8, 2, 1]), ...bits];
  const page = await view("clicks", [write("clicks.obj", blocks.join(""))], { exact: true });
  for (const key of ["Escape", "u", "u", "u", "a"]) await page.keyboard.press(key); // x goes to the right and down
  const area = await page.locator("#canvas").boundingBox();
  const chosen = async ([x, y]) => {
    await page.mouse.click(area.x + x * area.width, area.y + y * area.height);
    return page.$$eval("#details .model-name, #details .link.first, #details .link.second", (names) => names.map((name) => name.textContent));
  };
  const of = new Map();
  for (const slope of [0.3, 0.5, 0.1, 0.7]) {
    for (let x = 0.1; x < 0.95 && of.size < 3; x += 0.1) {
      await page.keyboard.press("Escape");
      const place = [x, 0.5 + slope * (x - 0.5)];
      for (const name of await chosen(place)) of.set(name, place);
    }
  }
  await page.keyboard.press("Escape");
  assert.deepEqual(await chosen(of.get("left")), ["left"]);
  assert.deepEqual((await chosen(of.get("right"))).sort(), ["left", "right"]);
  assert.equal(await page.isVisible("#panel-pairs"), true);
  assert.deepEqual(await chosen(of.get("left")), ["left"]);
  assert.deepEqual(await chosen(of.get("off")), ["off"], "which is no partner of it: only their boxes meet");
  assert.equal(await page.isVisible("#panel-models"), true);
  for (const key of ["i", "a", "Escape"]) await page.keyboard.press(key);
  assert.deepEqual(await chosen([0.5, 0.5]), ["off"], "everything is what is not hidden");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("rows of what is hidden are marked, and sliders say what their values mean", { skip }, async () => {
  const page = await view("marked", [nested()], { exact: true });
  const unseen = (list) => page.$$eval(`#${list} .row`, (rows) => rows.sort((a, b) => a.dataset.index - b.dataset.index).map((row) => [row.classList.contains("unseen"), row.textContent.includes("hidden")].join()));
  const none = "false,false";
  const marked = "true,true";
  assert.deepEqual(await unseen("pairs-list"), [none]);
  await page.click("#tab-models");
  await page.click('#models-list .row[data-index="0"]');
  await page.keyboard.press("h");
  assert.deepEqual([await unseen("pairs-list"), await unseen("models-list")], [[marked], [marked, none]]);
  await page.click('#models-list .row[data-index="1"]');
  assert.deepEqual(await unseen("details"), [marked, none], "also among the partners");
  await page.keyboard.press("z");
  assert.deepEqual([await unseen("pairs-list"), await unseen("models-list"), await unseen("details")], [[none], [none, none], [none, none]]);
  for (const key of ["x", "s"]) await page.keyboard.press(key);
  assert.equal(await page.getAttribute("#explode-slider", "aria-valuetext"), "50 % of the way from the middle");
  assert.equal(await page.getAttribute("#section-slider", "aria-valuetext"), await page.textContent("#section-place"));
  assert.deepEqual(page.problems, []);
  await page.close();
});
