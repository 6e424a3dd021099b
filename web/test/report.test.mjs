// SPDX-License-Identifier: MIT
// The page of a report: what is known of it, order and search, comments that stay and go out with the BCF, and the way into 3D.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { allpairs, cuboid, folder, hasExact, open, screenshot, shapes, startBrowser, stopBrowser, texts, write } from "./program.mjs";

before(() => startBrowser());
after(stopBrowser);

const skip = hasExact() ? false : "built without FCL";

async function report(name, inputs, ...options) {
  const out = join(folder, name);
  allpairs("report", ...inputs, ...options, "-o", out);
  const page = await open(join(out, "index.html"));
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  return page;
}

const column = (page, name) => page.$$eval("table", ([table], head) => {
  const place = [...table.tHead.rows[0].cells].findIndex((cell) => cell.textContent === head);
  return [...table.tBodies[0].rows].filter((row) => !row.hidden).map((row) => row.cells[place].textContent);
}, name);
const sort = (page, name) => page.click(`thead button:text-is("${name}")`);

const listArchive = `
import base64, json, sys, zipfile
archive = zipfile.ZipFile(sys.argv[1])
assert archive.testzip() is None
print(json.dumps([[name, base64.b64encode(archive.read(name)).decode()] for name in archive.namelist()]))
`;

/** The files of an archive, as Python has them, which compares their checksums. */
function unzipped(path) {
  const text = execFileSync("python3", ["-c", listArchive, path], { encoding: "utf8", maxBuffer: 1 << 30 });
  return new Map(JSON.parse(text).map(([name, bytes]) => [name, Buffer.from(bytes, "base64")]));
}

/** What an XPath gives of a text. */
const xpath = (page, text, path) => page.evaluate(([xml, expression]) => {
  const document = new DOMParser().parseFromString(xml, "application/xml");
  return document.evaluate(expression, document, null, XPathResult.STRING_TYPE).stringValue;
}, [text, path]);

async function savedBcf(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("button.bcf")]);
  assert.equal(download.suggestedFilename(), "clashes.bcf");
  const path = join(folder, `saved-${Math.random()}.bcf`);
  await download.saveAs(path);
  return unzipped(path);
}

test("a report says when it was made, by what, of what and how", { skip }, async () => {
  const page = await report("about", [shapes()], "--metres-per-unit", "0.001", "--clearance", "0.5");
  const about = new Map((await texts(page, ".about dt")).map((name, i) => [name, i]));
  const values = await texts(page, ".about dd");
  assert.match(values[about.get("Made")], /^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$/);
  assert.equal(values[about.get("By")], allpairs("--version").split("\n")[0].replace(/^(\S+) (\S+).*/, "$1 $2"));
  assert.equal(values[about.get("Lengths")], "millimetres, as --metres-per-unit says");
  assert.equal(values[about.get("Clearance")], "0.5");
  assert.deepEqual(page.problems, []);
  await page.close();
});

test("a report's table is sorted by any column and searched", { skip }, async () => {
  const page = await report("sorted", [shapes()]);
  const numbers = await column(page, "#");
  assert.ok(numbers.length >= 3);
  assert.deepEqual(numbers, [...numbers].sort((a, b) => a - b));
  await sort(page, "first");
  const names = await column(page, "first");
  assert.deepEqual(names, [...names].sort());
  assert.equal(await page.getAttribute("thead th[aria-sort]", "aria-sort"), "ascending");
  await sort(page, "first");
  assert.deepEqual(await column(page, "first"), [...names].sort().reverse());
  await sort(page, "depth");
  const depths = await column(page, "depth");
  const known = depths.filter(Boolean).map(Number);
  assert.deepEqual(known, [...known].sort((a, b) => a - b));
  assert.deepEqual(depths.slice(known.length), depths.slice(known.length).map(() => ""), "what has no depth comes last");
  await sort(page, "state");
  assert.deepEqual(await column(page, "#"), numbers, "states are ordered by how bad they are");
  await page.fill(".controls input[type=search]", "PIN block");
  const shown = await column(page, "#");
  assert.equal(shown.length, 1);
  assert.equal(await page.locator("figure:visible").count(), 1);
  assert.equal(await page.textContent(".controls output"), `1 of ${numbers.length}`);
  assert.deepEqual(page.problems, []);
  await page.close();
});

for (const version of ["2.1", "3.0"]) {
  test(`status and comment stay in the browser and go out with BCF ${version}`, { skip }, async () => {
    const name = `noted-${version}`;
    const page = await report(name, [shapes()], "--bcf", version);
    const before = unzipped(join(folder, name, "clashes.bcf"));
    const guid = await page.getAttribute("figure:nth-of-type(2)", "data-guid");
    const card = page.locator(`figure[data-guid="${guid}"]`);
    const comment = 'Move the bar <5 mm> & "ask" Zoë \u0007';
    await card.locator("select").selectOption("In progress");
    await card.locator("textarea").fill(comment);
    await page.fill("input.author", "Ann");
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.ready);
    assert.equal(await card.locator("select").inputValue(), "In progress");
    assert.equal(await card.locator("textarea").inputValue(), comment);
    assert.equal((await column(page, "status")).filter((status) => status === "In progress").length, 1);
    assert.ok((await column(page, "comment")).includes(comment));
    await screenshot(page, `report-noted-${version}`);

    const after = await savedBcf(page);
    assert.deepEqual([...after.keys()], [...before.keys()]);
    const changed = `${guid}/markup.bcf`;
    for (const [file, bytes] of before) if (file !== changed) assert.ok(bytes.equals(after.get(file)), file);
    const markup = after.get(changed).toString();
    const read = (path) => xpath(page, markup, path);
    const at = version === "3.0" ? "/Markup/Topic/Comments/Comment" : "/Markup/Comment";
    assert.equal(await read("/Markup/Topic/@TopicStatus"), "In progress");
    assert.equal(await read("/Markup/Topic/Title"), await xpath(page, before.get(changed).toString(), "/Markup/Topic/Title"));
    assert.equal(await read(`${at}/Comment`), comment.replace("\u0007", "\uFFFD"));
    assert.equal(await read(`${at}/Author`), "Ann");
    assert.equal(await read(`${at}/Viewpoint/@Guid`), await read(version === "3.0" ? "//ViewPoint/@Guid" : "/Markup/Viewpoints/@Guid"));
    assert.match(await read(`${at}/@Guid`), /^[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}$/);
    assert.equal((await savedBcf(page)).get(changed).toString(), markup, "the same comment, not another one");

    await card.locator("textarea").fill("");
    await card.locator("select").selectOption("Open");
    const none = await savedBcf(page);
    for (const [file, bytes] of before) assert.ok(bytes.equals(none.get(file)), file);
    assert.deepEqual(page.problems, []);
    await page.close();
  });
}

test("clashes of a status are shown, and a later report of the same parts has the comments", { skip }, async () => {
  const page = await report("monday", [shapes()]);
  const count = await page.locator("figure").count();
  await page.locator("figure textarea").first().fill("wait");
  await page.locator("figure select").first().selectOption("Accepted");
  await page.selectOption(".controls select", "Accepted");
  assert.equal(await page.locator("figure:visible").count(), 1);
  await page.selectOption(".controls select", "Open");
  assert.equal(await page.locator("figure:visible").count(), count - 1);
  const context = page.context();
  const card = page.locator("figure").first();
  await page.goto(`file://${write("elsewhere.html", "<!doctype html>")}`);
  await page.evaluate(() => { // as another tab does meanwhile
    const key = Object.keys(localStorage).find((name) => name.startsWith("allpairs-note:"));
    localStorage[key] = JSON.stringify({ ...JSON.parse(localStorage[key]), status: "Closed", comment: "wait no more" });
  });
  await page.goBack();
  await page.waitForFunction(() => document.documentElement.dataset.ready && document.readyState === "complete");
  assert.equal(await page.inputValue(".controls select"), "Open", "as the browser fills it in");
  assert.equal(await page.locator("figure:visible").count(), count - 1);
  assert.equal((await column(page, "#")).length, count - 1);
  assert.deepEqual([await card.locator("select").inputValue(), await card.locator("textarea").inputValue()], ["Closed", "wait no more"]);
  await page.selectOption(".controls select", "Closed");
  assert.equal(await page.locator("figure:visible").count(), 1);
  await card.locator("textarea").fill("wait");
  allpairs("report", shapes(), "-o", join(folder, "tuesday"));
  await page.goto(`file://${join(folder, "tuesday/index.html")}`);
  assert.equal(await page.locator("figure textarea").first().inputValue(), "wait");
  assert.deepEqual(page.problems, []);
  await context.close();
});

test("what is resolved is closed, also with a comment, until a reader opens it again", { skip }, async () => {
  const input = (x) => write("resolved.obj", [[0, x], [9, 1]].map(([z, begin], i) => cuboid(`left ${i}`, [0, 0, z], [2, 2, z + 2]) + cuboid(`right ${i}`, [begin, 0, z], [4, 2, z + 2])).join(""));
  const out = join(folder, "resolved");
  const page = await report("resolved", [input(1)]);
  const card = page.locator("figure", { hasText: "left 0" });
  await card.locator("textarea").fill("of Monday"); // while it is open, which nobody chose
  allpairs("report", input(2), "-o", out, "--since", out);
  await page.reload();
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  const file = `${await card.getAttribute("data-guid")}/markup.bcf`;
  const status = async () => xpath(page, (await savedBcf(page)).get(file).toString(), "/Markup/Topic/@TopicStatus");
  const before = unzipped(join(out, "clashes.bcf"));
  assert.deepEqual(await column(page, "status"), ["Open", "Closed"]);
  assert.equal(await card.locator("textarea").inputValue(), "of Monday");
  assert.equal(await status(), "Closed");
  await page.selectOption(".controls select", "Closed");
  assert.equal(await page.locator("figure:visible").count(), 1);
  await page.selectOption(".controls select", "");
  await card.locator("textarea").fill("checked on site");
  assert.equal(await status(), "Closed");
  await card.locator("textarea").fill("");
  await card.locator("select").selectOption("Open");
  assert.equal(await status(), "Open", "as it was chosen, without a comment");
  await card.locator("select").selectOption("Closed");
  const none = await savedBcf(page);
  for (const [name, bytes] of before) assert.ok(bytes.equals(none.get(name)), name);
  assert.deepEqual(page.problems, []);
  await page.close();
});

test("a clash that the table has no room for is shown, searched and noted by its picture", async () => {
  const boxes = "0,0,0,2,2,2,slab\n1,0,0,3,2,2,wall\n2.5,0,0,9,2,2,door\n";
  const out = join(folder, "beyond");
  allpairs("report", write("beyond.csv", boxes), "-o", out);
  const index = join(out, "index.html");
  writeFileSync(index, readFileSync(index, "utf8").replace(/<tr[^>]*>(?:(?!<tr).)*<\/tr>\n(?=<\/tbody>)/s, "")); // as behind the first 10,000
  const page = await open(index);
  const shown = () => page.locator("figure:visible").count();
  assert.equal(await page.locator("tbody tr").count(), 1);
  assert.equal(await shown(), 2);
  await page.fill(".controls input[type=search]", "Door");
  assert.equal(await shown(), 1);
  await page.locator("figure:visible textarea").fill("Later");
  await page.fill(".controls input[type=search]", "later");
  assert.equal(await shown(), 1);
  await page.selectOption(".controls select", "Accepted");
  assert.equal(await shown(), 0);
  assert.deepEqual(page.problems, []);
  await page.close();
});

test("a picture opens the page at its pair, though names repeat", { skip }, async () => {
  const parts = [1, 2, 3].map((i) => write(`same/${i}/bar.obj`, cuboid(`bar_${"x".repeat(80)}`, [0, 0, 0], [4, 4, i])));
  const page = await report("opened", parts);
  const linesOf = (selector) => page.$$eval(selector, (elements) => elements.map(({ firstChild }) => {
    const range = document.createRange();
    range.selectNodeContents(firstChild);
    return range.getClientRects().length;
  }));
  for (const selector of ["thead button", ".state", "td.status"]) {
    const lines = await linesOf(selector);
    assert.ok(lines.length >= 3 && lines.every((count) => count === 1), `long names leave other words whole: ${selector} ${lines}`);
  }
  assert.ok((await page.$eval("td.comment", (cell) => cell.clientWidth)) >= 150, "and a place for comments");
  const rows = await page.locator("figure").count();
  for (let i = 0; i < rows; ++i) {
    const href = await page.locator("figure a").nth(i).getAttribute("href");
    const names = await page.locator("figure").nth(i).locator(".first, .second").allTextContents();
    const other = await open(join(folder, "opened", href));
    await other.waitForFunction(() => document.documentElement.dataset.ready);
    assert.deepEqual((await texts(other, "#details .link.first, #details .link.second")).sort(), names.sort());
    assert.deepEqual(other.problems, []);
    await other.close();
  }
  assert.deepEqual(page.problems, []);
  await page.close();
});

test("a row has the pairs of its parts that the report has, and none whose shapes are apart", { skip }, async () => {
  const wedge = "o wedge\nv 3.5 3.5 9\nv 3.5 9 3.5\nv 9 9 9\nv 3.5 9 9\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"; // only its box meets the block
  const two = [wedge + cuboid("bar", [3, 1, 1], [6, 2, 2]), wedge + cuboid("bar", [3, 1, 1], [6, 2, 2]) + cuboid("pin", [1, 1, 3], [2, 2, 5])];
  for (const [i, parts] of two.entries()) {
    const name = `apart-inside-${i}`;
    const inputs = [write(`${name}-parts/block.obj`, cuboid("block", [0, 0, 0], [4, 4, 4])), write(`${name}-parts/parts.obj`, parts)];
    const page = await report(name, inputs, "--group", "file", "--between-inputs");
    assert.deepEqual(await column(page, "second"), [i === 0 ? "block" : "block.obj (worst of 2 pairs)"]);
    await page.goto(`file://${join(folder, name, "view.html")}`);
    await page.waitForFunction(() => document.documentElement.dataset.ready);
    assert.deepEqual(await texts(page, "#pairs-list .tag"), i === 0 ? [] : ["2 pairs"]);
    assert.equal((await texts(page, "#details .parts li")).length, i === 0 ? 0 : 2);
    const csv = (await page.download(() => page.click("#pairs-csv"))).toString().trimEnd().split("\n").slice(1);
    const rows = readFileSync(join(folder, name, "clashes.csv"), "utf8").trimEnd().split("\n").slice(1);
    const begins = (lines) => lines.map((line) => line.split(",").slice(0, 4).join(","));
    assert.deepEqual(begins(csv), begins(rows));
    assert.deepEqual(page.problems, []);
    await page.close();
  }
});

test("without pairs, and without scripts, a report can be read", async () => {
  const input = write("far-apart.csv", "0,0,0,1,1,1\n5,5,5,6,6,6\n");
  const page = await report("nothing", [input]);
  assert.equal(await page.locator(".controls").count(), 0);
  assert.deepEqual(page.problems, []);
  await page.close();
  allpairs("report", write("two.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n"), "-o", join(folder, "plain"));
  const plain = await open(join(folder, "plain/index.html"), { javaScriptEnabled: false });
  assert.equal(await plain.locator("figure img").count(), 1);
  assert.equal(await plain.locator("tbody tr").count(), 1);
  await plain.close();
});

test("a BCF that is not beside the page is said to be missing", async () => {
  const out = join(folder, "alone");
  allpairs("report", write("pair.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n"), "-o", out);
  writeFileSync(join(folder, "alone.html"), readFileSync(join(out, "index.html")));
  const page = await open(join(folder, "alone.html"));
  await page.click("button.bcf");
  await page.waitForFunction(() => document.querySelector(".problem").textContent.startsWith("Not saved"));
  await page.close();
});

test("long names without blanks do not make the page wider than its window", { skip }, async () => {
  const name = (letter) => `${letter}_part_of_an_assembly:`.repeat(12);
  const parts = ["a", "b", "c"].map((letter, i) => cuboid(name(letter), [2 * i, 0, 0], [2 * i + 3, 1, 1]));
  const input = write("long-names.obj", parts.join(""));
  await (await report("long-names", [input])).close();
  write("long-names.obj", parts[0] + parts[1] + cuboid(name("c"), [20, 0, 0], [21, 1, 1])); // and one pair is gone
  const page = await report("long-names", [input], "--since", join(folder, "long-names"));
  await page.click("details:has-text('Resolved') summary");
  for (const width of [1280, 400]) {
    await page.setViewportSize({ width, height: 800 });
    const wide = await page.$$eval("main *", (elements) => elements.filter((element) => !element.closest(".scroll") && (element.getBoundingClientRect().right > innerWidth || element.matches("p, li") && element.scrollWidth > element.clientWidth)).map((element) => element.outerHTML));
    assert.deepEqual(wide, [], `${width} pixels`);
  }
  assert.deepEqual(page.problems, []);
  await page.close();
});

test("on paper, which does not scroll, the table and long comments are whole", { skip }, async () => {
  const name = (i) => `part_${i}_of_the_assembly`;
  const parts = [0, 1, 2].map((i) => cuboid(name(i), [123456 + i / 4, 0, 0], [123457 + i / 4, 1, 1])).join("");
  const page = await report("printed", [write("printed.obj", parts)]);
  await page.locator("figure textarea").first().fill("Move it to the other side of the wall, and ask who built that. ".repeat(20));
  await page.setViewportSize({ width: 718, height: 1047 }); // what Chromium leaves of A4 at 96 dots per inch
  await page.emulateMedia({ media: "print" });
  const cut = await page.$$eval("th, td", (cells) => cells.filter((cell) => cell.getBoundingClientRect().right > innerWidth || cell.scrollWidth > cell.clientWidth).map((cell) => cell.textContent));
  assert.deepEqual(cut, []);
  assert.deepEqual(await page.$$eval(".scroll, textarea", (boxes) => boxes.filter((box) => box.scrollHeight > box.clientHeight).map((box) => box.className || box.value)), []);
  await screenshot(page, "report-printed");
  assert.deepEqual(page.problems, []);
  await page.close();
});
