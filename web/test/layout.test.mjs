// SPDX-License-Identifier: MIT
// Nothing covers anything else, and everything can be read: on small and wide screens, with large text, long names and
// numbers far from zero, in dark and in light.

import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { root, screenshot, startBrowser, stopBrowser, texts, view, write } from "./program.mjs";

before(() => startBrowser());
after(stopBrowser);

const demo = join(root, "examples/scenes/demo.scn");

/** Pairs of the page's parts that cover each other, and parts that are wider than the page. */
function collisions() {
  const parts = [".toolbar", ".canvas-holder", ".legend", "#timeline", ".summary", ".tabs", ".panel:not([hidden])", ".panel:not([hidden]) .tools", ".panel:not([hidden]) .chips", ".panel:not([hidden]) .columns", ".panel:not([hidden]) .list", "#details", "footer"];
  const boxes = parts.map((part) => [part, document.querySelector(part)]).filter(([, element]) => element && element.getClientRects().length > 0).map(([part, element]) => [part, element, element.getBoundingClientRect()]);
  const found = document.documentElement.scrollWidth > innerWidth ? ["wider than the page"] : [];
  for (const [a, whole, one] of boxes) {
    for (const [b, part, other] of boxes) {
      if (whole.contains(part) || part.contains(whole)) continue;
      const across = Math.min(one.right, other.right) - Math.max(one.left, other.left);
      const down = Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top);
      if (a < b && across > 1 && down > 1) found.push(`${a} and ${b}`);
    }
  }
  return found;
}

async function checkLayout(viewport, keys, name, prepare = () => {}) {
  const page = await view("layout", [demo], { viewport });
  await prepare(page);
  for (const key of keys) await page.keyboard.press(key);
  await page.waitForTimeout(100);
  assert.deepEqual(await page.evaluate(collisions), [], name);
  await screenshot(page, `layout-${name}`);
  assert.deepEqual(page.problems, []);
  return page;
}

test("nothing covers anything else, on small and wide screens and with large text", async () => {
  for (const [width, height, font] of [[1280, 800, "16px"], [1280, 800, "32px"], [2560, 1080, "16px"], [700, 900, "20px"], [853, 533, "16px"]]) {
    for (const keys of [["j"], ["m", "j"]]) {
      const enlarge = (page) => page.evaluate((size) => (document.documentElement.style.fontSize = size), font);
      const page = await checkLayout({ width, height }, keys, `${width}x${height}-${font}-${keys.join("")}`, enlarge);
      if (width > 800 && font === "16px") {
        const chosen = keys.length === 1 ? "#details .link.first" : "#details .model-name";
        assert.ok((await page.locator(chosen).boundingBox()).y < height, "what is chosen is in sight");
        const footer = await page.locator("footer").boundingBox();
        assert.ok(height < 600 || footer.y + footer.height <= height, "all of the panel is in sight");
      }
      await page.close();
    }
  }
});

test("the page follows the browser's own size of text", async () => {
  await stopBrowser();
  await startBrowser("--blink-settings=defaultFontSize=32");
  for (const [width, height] of [[1280, 800], [1920, 1080]]) {
    for (const keys of [["j"], ["m", "j"]]) {
      const page = await checkLayout({ width, height }, keys, `${width}x${height}-browser-${keys.join("")}`);
      assert.equal(await page.evaluate(() => getComputedStyle(document.querySelector("#title")).fontSize), "36px");
      await page.close();
    }
  }
  await stopBrowser();
  await startBrowser();
});

test("long names keep their ends, and are whole in the details", async () => {
  const names = [1, 2].map((i) => `${"assembly/".repeat(20)}part ${i}`);
  const input = write("long.csv", names.map((name, i) => `${name},${i / 2},0,0,${1 + i / 2},1,1\n`).join(""));
  const page = await view("long", [input]);
  const [row, tail] = await Promise.all(["#pairs-list .row", "#pairs-list .row .tail"].map((part) => page.locator(part).first().boundingBox()));
  assert.ok(tail.width > 0 && tail.x + tail.width <= row.x + row.width);
  assert.ok((await page.locator("#pairs-list .row .tail").first().textContent()).endsWith("part 2"));
  assert.deepEqual(await texts(page, "#pairs-list .row .name"), [names[1], names[0]]);
  await page.click("#pairs-list .row");
  assert.deepEqual(await texts(page, "#details .link"), [names[1], names[0]]);
  assert.deepEqual(await page.evaluate(collisions), []);
  await screenshot(page, "long");
  assert.deepEqual(page.problems, []);
  await page.close();
});

test("corners far from zero can be told apart", async () => {
  const page = await view("far", [write("far.csv", "1000000.25,0,-3,1000000.5,1e-7,inf\n")]);
  await page.keyboard.press("j");
  assert.equal((await texts(page, "#details .facts-small dd"))[1], "1000000.25, 0, −3 to 1000000.5, 1e−7, ∞");
  await page.close();
});

/** How much lighter the lighter of two colours is, "rgb(1, 2, 3)", as WCAG 2 has it. */
function contrast(a, b) {
  const luminance = (colour) => {
    const parts = colour.match(/[\d.]+/g).slice(0, 3).map((part) => part / 255).map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
  };
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

test("words stand out from their ground, and marks too, in dark and in light", async () => {
  for (const colorScheme of ["dark", "light"]) {
    const page = await view("contrast", [demo], { colorScheme });
    await page.keyboard.press("j");
    const colourOf = (part, property) => page.$eval(part, (element, name) => getComputedStyle(element)[name], property);
    const paper = await colourOf("aside", "backgroundColor");
    for (const part of ["#title", "#method", "#pairs-status", ".link.first", ".link.second", ".verdict, .and", "footer", ".legend", "#tab-pairs", "#tab-models"]) {
      assert.ok(contrast(await colourOf(part, "color"), paper) >= 4.5, `${colorScheme}: ${part}`);
    }
    for (const [part, property] of [["free", "backgroundColor"], ["pair", "backgroundColor"], ["self", "backgroundColor"], ["excluded", "borderTopColor"], ["out", "borderTopColor"]]) {
      assert.ok(contrast(await colourOf(`.legend .${part} .dot`, property), paper) >= 3, `${colorScheme}: ${part}`);
    }
    assert.deepEqual(page.problems, []);
    await page.close();
  }
});
