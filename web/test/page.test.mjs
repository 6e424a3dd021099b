// SPDX-License-Identifier: MIT
// What a page shows is what `detect` finds; names are text; nothing overlaps.

import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before } from "node:test";
import { drawn, extentOf } from "./pictures.mjs";
import { allpairs, clothFrames, cuboid, dataFolder, detect, folder, hasExact, inBoth, inChromium, isFirefox, npy, number, open, ownText, root, screenshot, settled, shapes, startBrowser, stopBrowser, texts, view, write } from "./program.mjs";

before(() => startBrowser());
after(stopBrowser);

const demo = join(root, "examples/scenes/demo.scn");

function volumeOf(a, b) {
  return [0, 1, 2].reduce((volume, k) => volume * Math.max(0, Math.min(a.box[1][k], b.box[1][k]) - Math.max(a.box[0][k], b.box[0][k])), 1);
}

const isApart = (a, b) => [0, 1, 2].some((k) => a.box[0][k] > b.box[1][k] || b.box[0][k] > a.box[1][k]);
const close = (a, b) => assert.ok(Math.abs(a - b) <= 1e-4 * Math.max(Math.abs(a), Math.abs(b)), `${a} and ${b}`);
const toNumber = (text) => Number(text.replace("−", "-").replaceAll(",", ""));
const isSelf = ([a, b]) => a === b;

/** The names of the pairs in the list's rows, "itself" for the second of a self pair. */
const rowsOf = (page, list) => page.$$eval(`#${list} .row`, (rows) => rows.sort((a, b) => a.dataset.index - b.dataset.index).map((row) => [...row.querySelectorAll(".name")].map((name) => name.textContent)));
const namesOf = (result, [a, b]) => (a === b ? [result.models[a].name] : [result.models[a].name, result.models[b].name]);

async function compareSummary(page, result) {
  assert.equal(await number(page, "#fact-models"), result.models.length);
  assert.equal(await number(page, "#fact-pairs"), result.pairs.length);
  const counts = Object.fromEntries((await texts(page, "#pairs-chips .chip")).map((text) => text.match(/^(.*) (\S+)$/)).map(([, label, count]) => [label, toNumber(count)]));
  const others = result.pairs.filter((pair) => !isSelf(pair));
  const near = others.filter(([a, b]) => isApart(result.models[a], result.models[b]));
  assert.equal(counts.overlapping ?? 0, others.length - near.length);
  assert.equal(counts["within the distance"] ?? 0, near.length);
  assert.equal(counts.self ?? 0, result.pairs.filter(isSelf).length);
}

inChromium("the demo: summary, list, search, order, choice and reasons are those of detect", async () => {
  const result = detect(demo);
  const page = await view("demo", [demo]);
  await compareSummary(page, result);
  const rows = await rowsOf(page, "pairs-list");
  assert.ok(rows.length >= 8);
  assert.deepEqual(rows, result.pairs.slice(0, rows.length).map((pair) => namesOf(result, pair)));
  await screenshot(page, "demo");

  await page.keyboard.press("/");
  await page.keyboard.type("hammer beech");
  const excluded = await page.$eval("#pairs-chips .excluded", (chip) => chip.click() ?? chip.getAttribute("aria-pressed"));
  assert.equal(excluded, "false");
  const matching = result.pairs.filter((pair) => ["hammer", "beech"].every((word) => namesOf(result, pair).some((name) => name.toLowerCase().includes(word))));
  assert.ok(matching.length > 0);
  assert.deepEqual(await rowsOf(page, "pairs-list"), matching.map((pair) => namesOf(result, pair)));
  await page.keyboard.press("Escape");
  assert.equal(await page.inputValue("#pairs-search"), "hammer beech", "Escape leaves the field, and what is searched stays");
  assert.equal(await page.evaluate(() => document.activeElement === document.body), true);
  assert.deepEqual(await rowsOf(page, "pairs-list"), matching.map((pair) => namesOf(result, pair)));
  await page.fill("#pairs-search", "");

  await page.selectOption("#pairs-sort", "volume");
  const best = Math.max(...result.pairs.map(([a, b]) => volumeOf(result.models[a], result.models[b])));
  close(toNumber(await page.textContent("#pairs-list .row .value")), best);
  await page.selectOption("#pairs-sort", "found");

  const chosen = result.pairs.findIndex(([a, b]) => a !== b && volumeOf(result.models[a], result.models[b]) > 0);
  await page.click(`#pairs-list .row[data-index="${chosen}"]`);
  assert.deepEqual(await texts(page, "#details .link"), namesOf(result, result.pairs[chosen]));
  close(toNumber(await page.textContent("#pair-volume")), volumeOf(...result.pairs[chosen].map((i) => result.models[i])));
  await screenshot(page, "demo-pair");

  await page.click("#details .link.first");
  const model = result.pairs[chosen][0];
  const partners = result.pairs.filter((pair) => pair.includes(model)).length;
  assert.equal(Number((await ownText(page, "#partner-count")).split(" ")[0]), partners);
  const reasons = await texts(page, "#details .row .reason");
  assert.equal(reasons.filter((text) => text === "partner" || text === "itself").length, Math.min(partners, reasons.length));
  assert.ok(reasons.some((text) => text.startsWith("apart by")));
  await page.keyboard.press("m");
  await screenshot(page, "demo-model");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("pairs of the same two bodies are one row, with its pairs inside", async () => {
  const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 1\nf -3 -2 -1\n";
  const left = write("bodies/left.obj", `o axle\n${triangle}o wheel\n${triangle}`);
  const right = write("bodies/right.obj", `o rim\n${triangle}o wheel\n${triangle}`);
  const result = detect(left, right);
  const page = await view("bodies", [left, right, "--group", "file"]);
  const rows = new Map(); // of two files: the pairs of their models
  for (const [a, b] of result.pairs) {
    const key = [a, b].map((i) => (result.models[i].file === left ? "left.obj" : "right.obj")).sort().join(" ");
    rows.set(key, [...(rows.get(key) ?? []), [a, b]]);
  }
  assert.equal(rows.size, 3);
  const shown = await rowsOf(page, "pairs-list");
  const isRow = (row) => rows.get(row.join(" ")) !== undefined || row.every((name) => !name.endsWith(".obj"));
  assert.equal(shown.length, rows.size);
  assert.ok(shown.every((row) => isRow([...row].sort())), JSON.stringify(shown));
  assert.equal(await number(page, "#fact-pairs"), rows.size);
  assert.equal(await page.textContent("#fact-pairs .note"), `${result.pairs.length} of models`);
  assert.deepEqual(await texts(page, "#pairs-list .tag"), ["4 pairs"]);
  const place = shown.findIndex((row) => row.includes("left.obj") && row.includes("right.obj"));
  await page.click(`#pairs-list .row[data-index="${place}"]`);
  const inside = rows.get("left.obj right.obj").map((pair) => namesOf(result, pair).sort().join(" and ")).sort();
  assert.deepEqual((await texts(page, "#details .parts .link")).map((text) => text.split(" and ").sort().join(" and ")).sort(), inside);
  await page.click("#details .parts li:last-child .link");
  assert.equal(await page.$eval("#details .parts li:last-child", (item) => item.getAttribute("aria-current")), "true");
  assert.equal(await page.getAttribute(`#pairs-list .row[data-index="${place}"]`, "aria-selected"), "true");
  await page.fill("#pairs-search", "rim axle");
  assert.equal((await rowsOf(page, "pairs-list")).length, 1, "a row is found by what is inside");
  await page.fill("#pairs-search", "");
  await screenshot(page, "bodies");
  assert.deepEqual(page.problems, []);
  await page.close();
});

/** All pairs of the page's list, as sets of two names; it holds the rows in sight only, so it is scrolled through. */
async function allPairs(page) {
  const rows = await page.evaluate(async () => {
    const list = document.querySelector("#pairs-list");
    const count = Number(document.querySelector("#pairs-status").textContent.split(" ")[0].replaceAll(",", "").replace("none", "0"));
    const deadline = Date.now() + 30_000;
    const found = [];
    for (let next = 0; next < count;) {
      list.scrollTop = (next / count) * list.scrollHeight;
      while (!list.querySelector(`.row[data-index="${next}"]`)) {
        if (Date.now() > deadline) throw new Error(`row ${next} of ${count} does not come`);
        await new Promise(requestAnimationFrame);
      }
      for (const row of list.querySelectorAll(".row")) {
        found.push([...row.querySelectorAll(".name")].map((name) => name.textContent));
        next = Math.max(next, 1 + Number(row.dataset.index));
      }
    }
    return found;
  });
  return new Set(rows.map((row) => [row[0], row[1] ?? row[0]].sort().join(" | ")));
}

inBoth("the margin slider finds the pairs of detect --distance", async () => {
  const grid = Array.from({ length: 27 }, (_, i) => [i % 3, Math.floor(i / 3) % 3, Math.floor(i / 9)].map((k) => 1.1 * k)); // gaps of 0.1, more or less
  const boxes = write("grid.npy", npy([27, 6], grid.flatMap((p) => [...p, ...p.map((x) => x + 1)])));
  const scene = write("bodies.scn", `<Node name="root"><CollisionPipeline/><MinProximityIntersection alarmDistance="0.25"/>
<Node name="A"><MechanicalObject position="0 0 0 1 0 0"/><SphereCollisionModel name="s" radius="0.5"/><PointCollisionModel name="p"/></Node>
<Node name="B"><MechanicalObject position="2.5 0 0"/><SphereCollisionModel name="s" radius="0.5" group="1"/></Node>
<Node name="C"><MechanicalObject position="4 0 0"/><SphereCollisionModel name="s" radius="0.5" group="1" contactDistance="0.25" selfCollision="1"/></Node></Node>`);
  const infinite = write("infinite.csv", "a,-inf,0,0,-inf,1,1\nb,-inf,0,0,5,1,1\nc,6,0,0,inf,1,1\nd,5.2,0,0,5.3,1,1\n");
  const cases = [["margins", scene], ["grid", boxes], ["thin", scene, "--distance", "-2"], ["infinite", infinite]];
  for (const [name, input, ...options] of isFirefox ? cases.slice(0, 1) : cases) {
    const page = await view(name, [input, ...options]);
    page.setDefaultTimeout(30_000);
    await page.click("#tab-pairs"); // without a pair, models are shown first
    const before = await number(page, "#fact-pairs");
    const told = () => texts(page, "#method, #effort");
    const [method, effort] = await told();
    assert.match(effort, /^Pairs found in .* tests made/);
    let different = 0;
    await page.fill("#margin-number", "");
    await page.locator("#margin-number").pressSequentially("1.25e-1");
    assert.equal(await page.inputValue("#margin-number"), "1.25e-1", "keys of the page do not take what is typed");
    for (const distance of [0, 0.1, 0.10000000000000009, 0.5, 1.2, 3, -0.2, -3, 0.25]) {
      await page.fill("#margin-number", String(distance));
      await page.press("#margin-number", "Enter");
      const result = detect(input, "--distance", String(distance));
      assert.equal(await number(page, "#fact-pairs"), result.pairs.length, `${name} at ${distance}`);
      const [, methodOfDetect] = allpairs("detect", input, "--distance", String(distance)).match(/^method +(.*)$/m);
      if (methodOfDetect !== method && distance !== 0) assert.deepEqual(await told(), [methodOfDetect, ""], "and what the search took is not told of another");
      await page.$eval("#pairs-chips", (chips) => chips.querySelectorAll(".excluded[aria-pressed=true]").forEach((chip) => chip.click()));
      const expected = new Set(result.pairs.map(([a, b]) => [result.models[a].name, result.models[b].name].sort().join(" | ")));
      assert.deepEqual(await allPairs(page), expected, `${name} at ${distance}`);
      different += result.pairs.length !== before;
    }
    assert.ok(different > 2, "the margin matters");
    await page.$eval("#margin-slider", (slider) => {
      slider.value = 700;
      slider.dispatchEvent(new Event("input"));
    });
    const chosen = await settled(page, () => page.inputValue("#margin-number"), (value) => value !== "0.25");
    assert.equal(await number(page, "#fact-pairs"), detect(input, "--distance", chosen).pairs.length);
    await screenshot(page, `margin-${name}`);
    await page.$eval("#margin-slider", (slider) => {
      slider.value = 1;
      slider.dispatchEvent(new Event("input"));
    });
    const least = await settled(page, () => page.inputValue("#margin-number"), (value) => Number(value) > 0 && Number(value) < 1e-5);
    assert.equal(await number(page, "#fact-pairs"), detect(input, "--distance", least).pairs.length, "the first position of the slider");
    await page.fill("#margin-number", "");
    await page.press("#margin-number", "Enter");
    assert.equal(await page.inputValue("#margin-number"), least, "an empty field is no margin");
    await page.click("#margin-reset");
    assert.equal(await number(page, "#fact-pairs"), before);
    assert.deepEqual(await told(), [method, effort]);
    assert.deepEqual(page.problems, []);
    await page.close();
  }
});

inChromium("pairs that --between-inputs leaves out are there from the start, and at any margin", async () => {
  const inputs = [write("left.csv", "0,0,0,1,1,1,wall\n0,0,0,1,1,1,door\n5,0,0,6,1,1,far\n"), write("right.csv", "0,0,0,1,1,1,pipe\n8,0,0,9,1,1,off\n")];
  const page = await view("between", [...inputs, "--between-inputs"]);
  const excluded = async () => Number((await texts(page, "#pairs-chips .excluded b"))[0] ?? "0");
  assert.equal(await excluded(), 1);
  assert.equal(await page.isVisible("#show-excluded"), true);
  for (const [distance, count] of [["4", 3], ["-2", 0], ["0", 1]]) {
    await page.fill("#margin-number", distance);
    await page.press("#margin-number", "Enter");
    assert.equal(await excluded(), count, `at ${distance}`);
    assert.equal(await page.isVisible("#show-excluded"), count > 0, `at ${distance}`);
  }
  await page.fill("#margin-number", "4");
  await page.press("#margin-number", "Enter");
  await page.click("#margin-reset");
  assert.equal(await excluded(), 1);
  await page.fill("#margin-number", "4");
  await page.press("#margin-number", "Enter");
  await page.selectOption("#pairs-sort", "name");
  await page.goto(`file://${write("elsewhere.html", "<!doctype html>")}`);
  await page.goBack();
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  const shown = [await page.inputValue("#margin-number"), await page.inputValue("#pairs-sort"), await excluded()];
  assert.deepEqual(shown, ["0", "found", 1], "on the way back fields say what is listed");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("a margin that is not finite is not moved", async () => {
  const page = await view("unbounded", [write("unbounded.csv", "0,0,0,1,1,1\n5,0,0,6,1,1\n"), "--distance", "inf"]);
  assert.equal(await page.isVisible("#margin"), false);
  assert.equal(await number(page, "#fact-pairs"), 1);
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("boxes that touch share no volume, infinite ones neither", async () => {
  const page = await view("slabs", [write("slabs.csv", "-inf,-inf,0,inf,inf,1\n-inf,-inf,1,inf,inf,2\n-inf,-inf,0.5,inf,inf,2\n")]);
  assert.deepEqual((await texts(page, "#pairs-list .row .value")).sort(), ["0", "∞", "∞"]);
  await page.click('#pairs-list .row[data-index="0"]');
  assert.equal(await page.textContent("#pair-volume"), "0");
  const [first] = JSON.parse((await page.download(() => page.click("#pairs-json"), "pairs.json")).toString());
  assert.equal(first.volume, 0);
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("the address has what is chosen, and chooses it", async () => {
  const input = write("address.csv", "a b,0,0,0,2,2,2\nc,1,1,1,3,3,3\nc,1,1,1,3,3,2\n\"d,&\",0,0,0,2,2,1\n");
  const page = await view("address", [input]);
  const file = (await page.evaluate(() => location.href)).split("#")[0];
  const hash = () => page.evaluate(() => location.hash);
  assert.equal(await hash(), "");
  await page.keyboard.press("j");
  const first = await hash();
  assert.match(first, /^#pair=[^,]+,[^,]+$/);
  const names = await texts(page, "#details .link");
  for (const [address, expected] of [[first, names], ["#pair=d%2C%26,a%20b", ["d,&", "a b"]], ["#pair=@2,@1", ["c", "c"]]]) {
    await page.goto("about:blank");
    await page.goto(file + address);
    await page.waitForFunction(() => document.documentElement.dataset.ready);
    assert.deepEqual(await texts(page, "#details .link"), expected, address);
    assert.equal(await hash(), address);
  }
  await page.evaluate(() => (location.hash = "#model=a%20b"));
  await page.waitForFunction(() => document.querySelector("#details .model-name")?.textContent === "a b");
  for (const nothing of ["#pair=x,y", "#pair=c,c", "#model=%E0%A4%A", "#else", "#pair=@9,@1", "#frame=7"]) {
    await page.evaluate((text) => (location.hash = text), nothing);
    await page.waitForTimeout(50);
    assert.equal(await page.textContent("#details .model-name"), "a b", nothing);
  }
  await page.keyboard.press("Escape");
  assert.equal(await hash(), "");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("the name of the model under the pointer is shown while that rests", async () => {
  const input = write("hover.csv", "only one <b>,0,0,0,2,2,2\n");
  const page = await view("hover", [input]);
  const area = await page.locator("#canvas").boundingBox();
  await page.mouse.move(area.x + area.width / 2, area.y + area.height / 2);
  await page.waitForFunction(() => document.getElementById("hover").textContent === "only one <b>" && !document.getElementById("hover").hidden);
  await screenshot(page, "hover");
  await page.mouse.move(area.x + 3, area.y + 3);
  await page.waitForFunction(() => document.getElementById("hover").hidden);
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("a section shows what is within a closed part, and what is cut away is not chosen", async () => {
  const input = write("nested.obj", cuboid("shell", [0, 0, 0], [4, 4, 4]) + cuboid("core", [1, 1, 1], [3, 3, 3]));
  const page = await view("section", [input], { exact: true });
  const area = await page.locator("#canvas").boundingBox();
  const nameAt = async () => {
    await page.mouse.click(area.x + area.width / 2, area.y + area.height / 2);
    return page.textContent("#details .model-name");
  };
  for (const key of ["Escape", "u", "u", "u"]) await page.keyboard.press(key); // seen from above, as before the worst clash was chosen
  assert.equal(await nameAt(), "shell");
  await page.keyboard.press("Escape");
  await page.keyboard.press("s");
  await page.selectOption("#section-axis", "2");
  const cutAt = async (value) => {
    await page.$eval("#section-slider", (slider, at) => {
      slider.value = at;
      slider.dispatchEvent(new Event("input"));
    }, value);
    return (await page.evaluate(extentOf, await drawn(page))).area;
  };
  const whole = await cutAt(1000);
  const half = await cutAt(500);
  assert.ok(0 < half && half < 0.9 * whole, `what is cut away is not drawn: ${half} of ${whole} pixels`);
  assert.equal(await page.textContent("#section-place"), "z ≤ 2");
  assert.equal(await nameAt(), "core", "seen from above, where the shell is cut away");
  await page.keyboard.press("Escape");
  await settled(page, () => page.isHidden("#details"));
  await screenshot(page, "section");
  await page.click("#section-flip");
  assert.equal(await page.textContent("#section-place"), "z ≥ 2");
  await page.keyboard.press("s");
  assert.equal(await nameAt(), "shell");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("keys choose, leave, switch and explain", async () => {
  const page = await view("keys", [demo], { colorScheme: "dark" });
  assert.equal(await page.getAttribute("html", "data-theme"), "dark");
  await page.keyboard.press("j");
  assert.equal(await page.$$eval("#pairs-list [aria-selected=true]", (rows) => rows.length), 1);
  await page.keyboard.press("j");
  assert.equal(await page.getAttribute("#pairs-list [aria-selected=true]", "data-index"), "1");
  await page.keyboard.press("Escape");
  assert.equal(await page.isVisible("#details"), false);
  await page.keyboard.press("t");
  assert.equal(await page.getAttribute("html", "data-theme"), "light");
  for (const [key, id] of [["b", "show-boxes"], ["g", "show-shapes"], ["l", "show-links"], ["r", "show-region"]]) {
    const was = await page.getAttribute(`#${id}`, "aria-pressed");
    const before = await drawn(page);
    await page.keyboard.press(key);
    assert.notEqual(await page.getAttribute(`#${id}`, "aria-pressed"), was, key);
    assert.notEqual(await drawn(page), before, `${key} changes what is drawn`);
  }
  await page.keyboard.press("?");
  assert.equal(await page.isVisible("#help"), true);
  await screenshot(page, "help");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("keys turn, move and bring the picture nearer, and leave arrows to what has the focus", async () => {
  const page = await view("steer", [demo]);
  const picture = async () => (await page.locator("#canvas").screenshot()).toString("base64");
  const seen = [await settled(page, picture)];
  for (const key of ["ArrowRight", "ArrowUp", "Shift+ArrowLeft", "+", "-"]) {
    await page.keyboard.press(key);
    seen.push(await settled(page, picture, (now) => now !== seen.at(-1)));
  }
  assert.equal(new Set(seen.slice(0, 5)).size, 5, "each key shows something else");
  await page.focus("#pairs-list");
  await page.keyboard.press("ArrowDown");
  assert.equal(await page.getAttribute("#pairs-list [aria-selected=true]", "data-index"), "0");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("the space bar opens the remarks when they have the focus", async () => {
  write("remarks/only.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("remarks/notes.txt", "no mesh");
  const page = await view("remarks", [join(folder, "remarks")]);
  await page.focus("#remarks summary");
  await page.keyboard.press(" ");
  assert.deepEqual(await texts(page, "#remarks li"), ["notes.txt: is no mesh file by its extension"]);
  assert.equal(await page.isVisible("#remarks li"), true);
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("each rule says in words why two models are no pair", async () => {
  const page = await view("why", [join(root, "tests/view/rules.scn")]);
  const reasonsOf = async (name) => {
    await page.keyboard.press("m");
    await page.fill("#models-search", name);
    await page.click("#models-list .row");
    await page.$eval("#details .list", (list) => (list.style.minHeight = "40rem"));
    await page.waitForFunction(() => document.querySelectorAll("#details .row").length === 10);
    const rows = await page.$$eval("#details .row", (all) => all.sort((a, b) => a.dataset.index - b.dataset.index).map((row) => [row.querySelector(".name").textContent, row.querySelector(".reason").textContent]));
    return Object.fromEntries(rows);
  };
  const ofG = await reasonsOf("/G/s");
  const alone = { "/I/s": "one of the two is inactive", "/O/s": "outside the region", "/E/p": "one of the two has no elements" };
  const partners = (...names) => Object.fromEntries(names.map((name) => [name, "partner"]));
  assert.deepEqual(ofG, { ...alone, ...partners("/A/s", "/S/s", "/T/s", "/T/t"), "/B/s": "apart by 1 on x", "/G/s": "may not collide with itself", "/H/s": "both in group 7" });
  const ofT = await reasonsOf("/T/s");
  assert.deepEqual(ofT, { ...alone, ...partners("/A/s", "/G/s", "/H/s"), "/B/s": "apart by 1 on x", "/S/s": "neither is simulated", "/T/s": "itself: not simulated", "/T/t": "parts of one body" });
  assert.equal(await page.textContent("#partner-count"), "3 partners, and why 6 others are none");
  assert.equal((await reasonsOf("/T/t"))["/T/t"], "itself");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("Tab reaches everything in order, and one sees where it is", async () => {
  const page = await view("tab", [demo]);
  const reached = [];
  for (let i = 0; i < 30; ++i) {
    await page.keyboard.press("Tab");
    const at = await page.evaluate(() => {
      const { activeElement: element } = document;
      return { name: element.id || element.className, outline: getComputedStyle(element).outlineStyle };
    });
    if (at.name === reached[0]) break;
    if (at.name) assert.notEqual(at.outline, "none", at.name);
    reached.push(at.name);
  }
  const wanted = ["canvas", "show-boxes", "box-mode", "show-shapes", "show-links", "frame-all", "up-axis", "theme", "help-button", "tab-pairs", "pairs-search", "pairs-sort", "pairs-list"];
  assert.deepEqual(reached.filter((name) => wanted.includes(name)), wanted);
  await page.focus("#tab-pairs");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.isVisible("#panel-models"), true);
  await page.focus("#models-list");
  await page.keyboard.press("ArrowDown");
  assert.equal(await page.isVisible("#details .model-name"), true);
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("a click into the picture chooses the model that is there", async () => {
  const input = write("one.csv", "0,0,0,1,1,1\n");
  const page = await view("one", [input]);
  const area = await page.locator("#canvas").boundingBox();
  await page.mouse.click(area.x + area.width / 2, area.y + area.height / 2);
  assert.equal(await page.textContent("#details .model-name"), "0");
  await page.mouse.click(area.x + 3, area.y + 3);
  assert.equal(await page.isVisible("#details"), false);
  assert.deepEqual(page.problems, []);
  await page.close();
});

/** How many pixels of a picture are red, counted by the page. */
async function countRed(png) {
  const image = new Image();
  image.src = `data:image/png;base64,${png}`;
  await image.decode();
  const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d");
  canvas.drawImage(image, 0, 0);
  const { data } = canvas.getImageData(0, 0, image.width, image.height);
  let red = 0;
  for (let i = 0; i < data.length; i += 4) red += data[i] > 180 && data[i + 1] < 150 && data[i + 2] > 60; // and not orange
  return red;
}

inChromium("what two boxes share is drawn in red, however small they are", async () => {
  for (const unit of ["", "e-12"]) {
    const rows = [[0, 0, 0, 2, 1, 1], [1, 0, 0, 3, 1, 1]].map((row) => row.map((x) => `${x}${unit}`).join(","));
    const page = await view("shared", [write("shared.csv", `${rows.join("\n")}\n`)]);
    const count = async () => page.evaluate(countRed, (await page.locator("#canvas").screenshot()).toString("base64"));
    assert.ok((await settled(page, count)) < 1000); // edges of orange boxes
    await page.keyboard.press("j");
    assert.ok((await settled(page, count, (red) => red > 10_000)) > 10_000);
    assert.deepEqual(page.problems, []);
    await page.close();
  }
});

const data = dataFolder();
inChromium("a real scene has the numbers of detect", { skip: data ? false : "no folder of data" }, async () => {
  const input = [join(data, "scenes/examples/Demos/chainAll.scn"), "--data", join(data, "scenes"), "--data", join(data, "scenes/examples")];
  const result = detect(...input);
  const page = await view("chain", input, { colorScheme: "dark", viewport: { width: 1920, height: 1080 } });
  await compareSummary(page, result);
  await page.focus("#pairs-list");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("End");
  const rows = await rowsOf(page, "pairs-list");
  const excluded = toNumber((await texts(page, "#pairs-chips .excluded b"))[0] ?? "0");
  assert.equal(await page.getAttribute("#pairs-list [aria-selected=true]", "aria-posinset"), String(result.pairs.length + excluded));
  assert.ok(rows.length > 10);
  await screenshot(page, "chain");
  assert.deepEqual(page.problems, []);
  await page.close();
});

/** Boxes that move back and forth: some pairs begin and some end. */
function movingBoxes(frames, count) {
  const rows = [];
  for (let t = 0; t < frames; ++t) {
    rows.push(Array.from({ length: count }, (_, i) => {
      const x = 3 * Math.sin(i * 7.3) + 1.5 * Math.sin(t * 0.4 + i);
      const y = 3 * Math.sin(i * 3.1 + 1) + 1.5 * Math.cos(t * 0.3 + 2 * i);
      return [x, y, 0, x + 0.8, y + 0.8, 1];
    }));
  }
  return rows;
}

inChromium("a sequence of frames has the pairs of each frame, and what began and ended", async () => {
  const frames = movingBoxes(12, 30);
  const sequence = write("frames.npy", npy([12, 30, 6], frames.flat(2)));
  const pairs = frames.map((boxes, t) => detect(write(`frame${t}.npy`, npy([30, 6], boxes.flat()))).pairs.map(String));
  const page = await view("frames", [sequence]);
  for (let t = 0; t < frames.length; ++t) {
    assert.equal(await page.textContent("#time-frame"), `Frame ${t} of 0 to 11`);
    assert.equal(await number(page, "#fact-pairs"), pairs[t].length, `frame ${t}`);
    if (t > 0) {
      const began = pairs[t].filter((pair) => !pairs[t - 1].includes(pair)).length;
      const ended = pairs[t - 1].filter((pair) => !pairs[t].includes(pair)).length;
      assert.equal(toNumber(await page.textContent("#time-began b")), began);
      assert.equal(toNumber(await page.textContent("#time-ended b")), -ended);
    }
    if (t === 6) await screenshot(page, "frames");
    await page.keyboard.press(".");
  }
  await page.keyboard.press(" ");
  await page.waitForFunction(() => document.getElementById("time-frame").textContent === "Frame 2 of 0 to 11");
  await page.keyboard.press(" ");
  assert.equal(await page.getAttribute("#play", "aria-label"), "Play");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("a pair that is chosen has its row in every frame, whatever comes before it", async () => {
  const [a, b] = [[0, 0, 0, 1, 1, 1], [9, 0, 0, 10, 1, 1]];
  const frames = [[b, a, a, a], [a, a, a, a], [a, b, a, a], [a, a, a, b]]; // pairs of models 1, 2 and 3; of all; of others
  const page = await view("rows", [write("rows.npy", npy([4, 4, 6], frames.flat(2)))]);
  const row = async () => (await page.$$eval("#pairs-list .row[aria-selected=true]", (rows) => rows.map((one) => [...one.querySelectorAll(".name")].map((name) => name.textContent).join())))[0];
  for (let entry = 0; entry < 3; ++entry) await page.keyboard.press("j");
  const chosen = await row();
  assert.equal(chosen, "3,2");
  for (const expected of [chosen, chosen, undefined]) {
    await page.keyboard.press(".");
    assert.equal(await row(), expected);
  }
  await page.keyboard.press(",");
  assert.equal(await row(), chosen);
  await page.keyboard.press("k");
  assert.equal(await row(), "3,0", "steps go on from there");
  const follow = (hash) => page.evaluate((text) => new Promise((done) => {
    addEventListener("hashchange", () => done([document.getElementById("time-frame").textContent, !document.getElementById("details").hidden]), { once: true });
    location.hash = text;
  }), hash);
  assert.deepEqual(await follow("#pair=3,2"), ["Frame 0 of 0 to 3", true], "an address without a frame is of the first");
  assert.equal(await row(), chosen);
  assert.deepEqual(await follow("#frame=3"), ["Frame 3 of 0 to 3", false], "and without names chooses nothing");
  assert.deepEqual(await follow("#frame=1&pair=3,2"), ["Frame 1 of 0 to 3", true]);
  assert.deepEqual(await follow("#frame=4"), ["Frame 1 of 0 to 3", true], "there is no such frame");
  assert.deepEqual(await follow("#pair=3,x"), ["Frame 1 of 0 to 3", true], "there is no such model");
  assert.deepEqual(await follow(""), ["Frame 0 of 0 to 3", false]);
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("a line of time has any number of frames", async () => {
  const count = 130_000; // more than a call takes as arguments
  const frames = Array.from({ length: count }, (_, t) => [0, 0, 0, 1, 1, 1, t % 2, 0, 0, t % 2 + 0.5, 1, 1].map((x) => x + 0.25 * (t % 3)));
  const page = await view("long", [write("long.npy", npy([count, 2, 6], frames.flat()))]);
  assert.equal(await page.textContent("#time-frame"), "Frame 0 of 0 to 129,999");
  await page.keyboard.press(".");
  assert.equal(await page.textContent("#time-frame"), "Frame 1 of 0 to 129,999");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("a frame has the numbers of track whichever way it is reached, and marks where pairs begin and end", async () => {
  const frames = movingBoxes(12, 30);
  const sequence = write("frames.npy", npy([12, 30, 6], frames.flat(2)));
  const track = JSON.parse(allpairs("track", sequence, "--format", "json"));
  const page = await view("jumps", [sequence]);
  const go = (t) => page.$eval("#time-slider", (slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
  }, t);
  const expectFrame = async (t) => {
    assert.equal(await page.textContent("#time-frame"), `Frame ${t} of 0 to 11`);
    assert.equal(await number(page, "#fact-pairs"), track.pairs[t], `frame ${t}`);
    assert.equal(toNumber(await page.textContent("#time-began b")), track.began[t], `frame ${t}`);
    assert.equal(-toNumber(await page.textContent("#time-ended b")), track.ended[t], `frame ${t}`);
  };
  await expectFrame(0);
  for (const t of [7, 2, 11, 0, 5]) {
    await go(t);
    await expectFrame(t);
  }
  await page.keyboard.press(",");
  await expectFrame(4);
  const marks = async (name) => (await page.getAttribute(`#time-chart .${name}`, "d")).split("M").slice(1).map((part) => Number(part.split(",")[0]));
  const framesWith = (counts) => counts.flatMap((count, t) => (count > 0 ? [t] : []));
  assert.deepEqual(await marks("began"), framesWith(track.began));
  assert.deepEqual(await marks("ended"), framesWith(track.ended));
  await screenshot(page, "jumps");
  assert.deepEqual(page.problems, []);
  await page.close();
});

/** Two boxes that meet in the second of three frames. */
const meeting = () => write("meeting.npy", npy([3, 2, 6], [0, 1, 0].flatMap((t) => [0, 0, 0, 2, 2, 2, 3 - 2 * t, 3, 3, 5 - 2 * t, 5, 5].map((x, i) => (i % 3 === 0 || i < 6 ? x : x - 2 * t)))));

inChromium("lines show for a moment which pairs began and ended", async () => {
  const page = await view("meeting", [meeting()]);
  await page.keyboard.press("b"); // nothing but lines is left to see
  await page.evaluate(() => (window.setTimeout = () => 0)); // and the moment does not end
  const without = await drawn(page);
  await page.keyboard.press(".");
  assert.equal(await page.textContent("#time-began b"), "+1");
  const began = await drawn(page);
  assert.notEqual(began, without);
  await page.keyboard.press(".");
  assert.equal(toNumber(await page.textContent("#time-ended b")), -1);
  assert.ok(![without, began].includes(await drawn(page)));
  assert.equal(await page.textContent("#time-most"), "at most 1 pair");
  assert.deepEqual(page.problems, []);
  await page.close();
  const none = await view("never", [write("never.npy", npy([2, 2, 6], [0, 1].flatMap((t) => [t, 0, 0, 1 + t, 1, 1, 5, 0, 0, 6, 1, 1])))]);
  assert.equal(await none.textContent("#time-most"), "at most 0 pairs");
  assert.deepEqual(none.problems, []);
  await none.close();
});

inBoth("a frame that is chosen while a sequence plays is where it goes on", async () => {
  const count = 9000;
  const page = await view("played", [write("played.npy", npy([count, 2, 6], movingBoxes(count, 2).flat(2)))]);
  await page.selectOption("#speed", "5");
  await page.evaluate(() => {
    window.seen = [];
    new MutationObserver(() => window.seen.push(Number(document.getElementById("time-frame").textContent.replaceAll(",", "").match(/\d+/)[0]))).observe(document.getElementById("time-frame"), { childList: true });
  });
  await page.keyboard.press(" ");
  await page.waitForFunction(() => window.seen.length >= 2);
  await page.$eval("#time-slider", (slider) => {
    slider.value = 6000;
    slider.dispatchEvent(new Event("input"));
  });
  await page.waitForFunction(() => window.seen.includes(6000) && window.seen.at(-1) !== 6000);
  await page.evaluate(() => (location.hash = "#frame=3000"));
  await page.waitForFunction(() => window.seen.includes(3000) && window.seen.at(-1) !== 3000);
  await page.keyboard.press(" ");
  const seen = await page.evaluate(() => window.seen);
  for (const chosen of [6000, 3000]) {
    const next = seen[seen.indexOf(chosen) + 1];
    assert.ok(next > chosen && next < chosen + 3000, `${next} after ${chosen}`);
  }
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("a sequence that is slow to show plays as fast as chosen, and leaves frames out", async () => {
  const count = 400;
  const sequence = write("long.npy", npy([count, 5, 6], movingBoxes(count, 5).flat(2)));
  const page = await view("long", [sequence]);
  await page.selectOption("#speed", "30");
  await page.evaluate(() => {
    window.seen = [];
    new MutationObserver(() => {
      const frame = Number(document.getElementById("time-frame").textContent.match(/\d+/)[0]);
      const now = performance.now();
      window.seen.push([frame, now]);
      while (performance.now() < now + 200) continue; // as long as six frames
    }).observe(document.getElementById("time-frame"), { childList: true });
  });
  await page.keyboard.press(" ");
  await page.waitForFunction(() => window.seen.length >= 10);
  await page.keyboard.press(" ");
  const seen = await page.evaluate(() => window.seen);
  const [[firstFrame, firstTime], [lastFrame, lastTime]] = [seen[0], seen.at(-1)];
  const due = (30 * (lastTime - firstTime)) / 1000;
  assert.ok(Math.abs(lastFrame - firstFrame - due) < 0.25 * due, `${lastFrame - firstFrame} frames where ${due} are due`);
  assert.ok(lastFrame - firstFrame > 2 * seen.length, "frames are left out");
  await page.close();
});

inChromium("meshes that move have the pairs of track, frame by frame, and are drawn where they are", async () => {
  const files = clothFrames(5);
  const track = JSON.parse(allpairs("track", ...files, "--format", "json"));
  const page = await view("cloth", ["--sequence", ...files]);
  assert.equal(await number(page, "#fact-models"), track.boxes);
  assert.ok(new Set(track.pairs).size > 2);
  const heights = []; // of the upper border of what is drawn, which is the cloth that falls
  for (let t = 0; t < files.length; ++t) {
    assert.equal(await number(page, "#fact-pairs"), track.pairs[t], `frame ${t}`);
    if (t > 0) {
      assert.equal(toNumber(await page.textContent("#time-began b")), track.began[t]);
      assert.equal(toNumber(await page.textContent("#time-ended b")), -track.ended[t]);
    }
    await screenshot(page, `cloth-${t}`);
    heights.push((await page.evaluate(extentOf, await drawn(page))).highest[1]);
    if (t + 1 < files.length) await page.keyboard.press(".");
  }
  assert.ok(heights.every((height, t) => t === 0 || height > heights[t - 1] + 5), `pixels from above: ${heights}`);
  await page.fill("#pairs-search", "onerror");
  await page.click("#pairs-list .row");
  const height = await page.$eval("#details .link.first", (link) => {
    link.click();
    return document.querySelector("#details .row").getBoundingClientRect().height; // at once, not a moment later
  });
  assert.ok(height > 10, `${height}`);
  assert.match(await page.textContent("#details .model-name"), /^<img src=x onerror=alert\(1\)>: triangle [0-3]$/);
  const partners = Number((await ownText(page, "#partner-count")).split(" ")[0]);
  await page.$eval("#details .list", (list, part) => (list.scrollTop = part * list.scrollHeight), partners / track.boxes);
  await page.waitForFunction(() => [...document.querySelectorAll("#details .reason")].some((reason) => reason.textContent === "they share a vertex"));
  await screenshot(page, "cloth-model");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("names from files are text, in the page and in the report", async () => {
  const name = "<img src=x onerror=alert(1)></script><script>alert(2)</script>";
  const input = write("evil.obj", `o ${name}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no other\nv 0 0 0\nv 1 0 1\nv 0 1 0\nf 4 5 6\n`);
  const page = await view("evil", [input]);
  assert.equal(await page.textContent("#pairs-list .row .name:nth-of-type(2)"), name);
  await page.click("#pairs-list .row");
  await page.click("#details .link.second");
  assert.equal(await page.textContent("#details .model-name"), name);
  assert.equal(await page.$$eval("img", (images) => images.length), 0);
  assert.deepEqual(page.problems, []);
  await page.close();
  allpairs("report", input, "-o", join(folder, "evil"));
  const report = await open(join(folder, "evil/index.html"));
  assert.equal(await report.textContent(".second"), name);
  assert.equal(await report.$$eval("img", (images) => images.length), 1);
  assert.deepEqual(report.problems, []);
  await report.close();
});

/** Counts, in the page, what is drawn. */
function countDraws() {
  window.drawn = { frames: 0, draws: 0 };
  const { prototype } = WebGL2RenderingContext;
  const count = (name, what) => {
    const original = prototype[name];
    prototype[name] = function (...words) {
      ++window.drawn[what];
      return original.apply(this, words);
    };
  };
  for (const name of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"]) count(name, "draws");
  count("fenceSync", "frames");
}

inChromium("ten thousand models with fifty thousand pairs are all there", async () => {
  const boxes = write("many.npy", "");
  allpairs("generate", "uniform", "-n", "10000", "-o", boxes);
  const input = [boxes, "--distance", "0.014"];
  const result = detect(...input);
  assert.ok(result.pairs.length >= 50_000);
  const page = await view("many", input, { init: countDraws });
  await page.waitForFunction(() => document.documentElement.dataset.complete);
  const times = await page.evaluate(() => ({ ...document.documentElement.dataset }));
  console.log(`# ${result.pairs.length} pairs: lists after ${times.loaded} ms, all of the picture after ${times.complete} ms`);
  await compareSummary(page, result);
  await screenshot(page, "many");
  const elements = await page.$$eval("*", (all) => all.length);
  assert.ok(elements < 600, `${elements} elements: only the rows in sight are in the document`);
  const { frames, draws } = await page.evaluate(() => window.drawn);
  assert.ok(draws <= 4 * frames, `${draws} draws in ${frames} pictures: all boxes are one`);
  const drawn = () => page.evaluate(() => window.drawn.frames);
  const last = await settled(page, drawn);
  await page.waitForTimeout(500);
  assert.equal(await drawn(), last, "nothing is drawn while nothing moves");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inChromium("that no two models share space is said where that is known", { skip: hasExact() ? false : "built without FCL" }, async () => {
  const apart = write("apart.obj", cuboid("a", [0, 0, 0], [1, 1, 1]) + cuboid("b", [1, 0, 0], [2, 1, 1]));
  const deep = write("deep.obj", cuboid("a", [0, 0, 0], [1, 1, 1]) + cuboid("b", [0.99, 0, 0], [2, 1, 1]));
  for (const [input, isKnown] of [[apart, true], [deep, false]]) {
    const page = await view("known", [input, "--min-depth", "0.05"], { exact: true });
    assert.equal(await number(page, "#fact-touching"), 1);
    assert.equal(/no two models share space/.test(await page.textContent("#fact-clashes")), isKnown);
    assert.deepEqual(page.problems, []);
    await page.close();
  }
});

inBoth("what really clashes comes first, what is apart is counted and hidden", { skip: hasExact() ? false : "built without FCL" }, async () => {
  const input = shapes();
  const result = detect(input, "--exact");
  const { exactStatistics: statistics } = result;
  assert.deepEqual([statistics.duplicate, statistics.contained, statistics.clash], [1, 1, 3]);
  const page = await view("shapes", [input], { exact: true });
  assert.equal(await number(page, "#fact-clashes"), statistics.clashes);
  assert.equal(await number(page, "#fact-apart"), statistics.apart);
  assert.match(await page.textContent("#fact-clashes"), /1 duplicate, 1 contained, deepest\s2$/);
  const rows = await page.$$eval("#pairs-list .row", (all) => all.sort((a, b) => a.dataset.index - b.dataset.index).map((row) => [...row.querySelectorAll(".name, .value")].map((part) => part.textContent)));
  assert.equal(rows.length, statistics.clashes);
  assert.deepEqual(rows[0].slice(0, 2).sort(), ["copy", "original"]);
  assert.deepEqual(rows[1], ["pin", "block", "2 deep"]);
  assert.ok(rows.slice(2).every((row) => row[2] === "0.25 deep"), rows.join());
  await page.click("#pairs-chips .apart");
  assert.equal(await page.$$eval("#pairs-list .row", (all) => all.length), result.pairs.length);
  await page.click("#pairs-chips .apart");
  await screenshot(page, "shapes");
  await page.click('#pairs-list .row[data-index="1"]');
  assert.equal(await page.textContent("#details .verdict"), "pin lies wholly in block.");
  assert.equal(toNumber(await page.textContent("#pair-depth")), 2);
  await screenshot(page, "shapes-contained");
  await page.click('#pairs-list .row[data-index="2"]');
  assert.equal(toNumber(await page.textContent("#pair-depth")), 0.25);
  await screenshot(page, "shapes-clash");
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("where surfaces cross is drawn, and the block of what boxes share only on demand", { skip: hasExact() ? false : "built without FCL" }, async () => {
  const page = await view("contact", [shapes()], { exact: true });
  const count = async () => page.evaluate(countRed, (await page.locator("#canvas").screenshot()).toString("base64"));
  await page.click('#pairs-list .row[data-index="2"]');
  const lines = await settled(page, count, (red) => red > 200);
  assert.ok(lines > 200 && lines < 20_000, `${lines}`);
  assert.equal(await page.getAttribute("#show-boxes", "aria-pressed"), "false");
  await page.keyboard.press("b");
  assert.notEqual(await settled(page, count, (red) => red !== lines), lines);
  assert.deepEqual(page.problems, []);
  await page.close();
});

inBoth("what is up is as the input says, and stays as the reader has turned it", async () => {
  const up = async (page) => (await page.textContent("#up-axis")).trim();
  const input = write("up.scn", "<Node gravity='0 -9.81 0'><CollisionPipeline/><DiscreteIntersection/><Node name='a'><MechanicalObject position='0 0 0'/><SphereCollisionModel radius='1'/></Node></Node>");
  const scene = await view("upright", [input]);
  assert.equal(await up(scene), "y up");
  await scene.keyboard.press("u");
  assert.equal(await up(scene), "z up");
  await scene.reload();
  await scene.waitForFunction(() => document.documentElement.dataset.ready);
  assert.equal(await up(scene), "z up");
  allpairs("view", input, "--up", "x", "-o", join(folder, "upright.html"));
  await scene.reload();
  await scene.waitForFunction(() => document.documentElement.dataset.ready);
  assert.equal(await up(scene), "x up", "as the program was told since");
  assert.deepEqual(scene.problems, []);
  await scene.close();
  const page = await view("upright-x", [write("up.csv", "0,0,0,1,1,1\n"), "--up", "x"]);
  assert.equal(await up(page), "x up");
  await page.close();
});

inChromium("without WebGL there are lists, and no buttons of the picture", async () => {
  const init = () => (HTMLCanvasElement.prototype.getContext = () => null);
  const page = await view("no-webgl", [write("no-webgl.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n")], { init });
  assert.match(await page.textContent("#no-picture"), /^No picture/);
  assert.equal(await number(page, "#fact-pairs"), 1);
  assert.deepEqual(await page.$$eval(".toolbar button", (buttons) => buttons.filter((one) => one.checkVisibility()).map((one) => one.id)), ["theme", "help-button"]);
  await page.close();
});

inChromium("the report shows a picture of each pair", async () => {
  allpairs("report", demo, "--boxes", "--group", "none", "-o", join(folder, "report"));
  const page = await open(join(folder, "report/index.html"));
  await page.$$eval("img", (images) => images.forEach((image) => (image.loading = "eager")));
  await page.waitForFunction(() => [...document.images].every((image) => image.naturalWidth === 640));
  assert.equal(await page.$$eval("figure", (figures) => figures.length), detect(demo).pairs.length);
  await screenshot(page, "report");
  assert.deepEqual(page.problems, []);
  await page.close();
});
