// SPDX-License-Identifier: MIT
// A page in Firefox with those methods of Playwright's pages that tests of both browsers use.

import { rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const codes = { Tab: "\ue004", Enter: "\ue007", Shift: "\ue008", Escape: "\ue00c", End: "\ue010", Home: "\ue011", ArrowLeft: "\ue012", ArrowUp: "\ue013", ArrowRight: "\ue014", ArrowDown: "\ue015" };
const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
const schemes = { dark: 0, light: 1 };
const deadline = 60_000; // milliseconds

/** Types a text in the place of what is in a field. */
function typeInto(field, text) {
  field.focus();
  field.select();
  document.execCommand(text === "" ? "delete" : "insertText", false, text);
}

/** Chooses a value of a list. */
function pick(field, value) {
  field.value = value;
  for (const name of ["input", "change"]) field.dispatchEvent(new Event(name, { bubbles: true }));
}

/** The middle of an element, brought into sight, or null where that is nothing to click. */
function middleOf(element) {
  if (element === null) return null;
  element.scrollIntoView({ block: "nearest" });
  const { left, top, width, height } = element.getBoundingClientRect();
  const place = [left + width / 2, top + height / 2];
  const met = document.elementFromPoint(...place);
  return width > 0 && height > 0 && (element.contains(met) || met?.contains(element)) ? place : null;
}

export class FirefoxPage {
  problems = []; // known when the page is closed

  constructor(browser) {
    this.browser = browser;
    this.keyboard = {
      press: (keys) => browser.press(...keys.split("+").map((key, i, all) => (key === "" && i > 0 ? "+" : codes[key] ?? (all.length === 1 ? keys : key))).filter((key) => key !== "")),
      type: async (text) => {
        for (const key of text) await browser.press(key);
      },
    };
    this.mouse = { move: (x, y) => browser.point(x, y), click: (x, y) => browser.click(x, y) };
  }

  async show(path, { viewport = { width: 1280, height: 800 }, colorScheme = "light", init } = {}) {
    await this.browser.runInBrowser(`Services.console.reset(); Services.prefs.setIntPref("layout.css.prefers-color-scheme.content-override", ${schemes[colorScheme]})`);
    await this.goto("about:blank");
    await this.browser.resize(viewport.width, viewport.height);
    await this.goto(`file://${path}`);
    if (init) throw new Error("Firefox runs nothing before a page");
  }

  setViewportSize = ({ width, height }) => this.browser.resize(width, height);
  goto = (url) => this.browser.command("WebDriver:Navigate", { url });
  reload = () => this.browser.command("WebDriver:Refresh", {});
  evaluate = (work, ...args) => this.browser.run(`return (${work}).apply(null, arguments)`, ...args);
  $eval = (selector, work, ...args) => this.browser.run(`const [selector, ...more] = arguments; return (${work})(document.querySelector(selector), ...more)`, selector, ...args);
  $$eval = (selector, work, ...args) => this.browser.run(`const [selector, ...more] = arguments; return (${work})([...document.querySelectorAll(selector)], ...more)`, selector, ...args);
  textContent = (selector) => this.$eval(selector, (element) => element.textContent);
  inputValue = (selector) => this.$eval(selector, (element) => element.value);
  getAttribute = (selector, name) => this.$eval(selector, (element, attribute) => element.getAttribute(attribute), name);
  isVisible = (selector) => this.$eval(selector, (element) => element !== null && element.getClientRects().length > 0);
  isHidden = async (selector) => !(await this.isVisible(selector));
  focus = (selector) => this.$eval(selector, (element) => element.focus());
  fill = (selector, text) => this.$eval(selector, typeInto, text);
  selectOption = (selector, value) => this.$eval(selector, pick, value);
  waitForTimeout = pause;
  setDefaultTimeout = () => {};

  async waitForFunction(work) {
    const end = Date.now() + deadline;
    for (; !(await this.evaluate(work)); await pause(20)) if (Date.now() > end) throw new Error(`waited for ${work}`);
  }

  async waitForSelector(selector) {
    const end = Date.now() + deadline;
    for (; !(await this.$eval(selector, (element) => element !== null)); await pause(20)) if (Date.now() > end) throw new Error(`waited for ${selector}`);
  }

  async press(selector, key) {
    await this.focus(selector);
    await this.keyboard.press(key);
  }

  /** Clicks into the middle of an element once that is there, rests, and is not covered. */
  async click(selector) {
    const end = Date.now() + deadline;
    for (let last = ""; ; await pause(20)) {
      const place = await this.$eval(selector, middleOf);
      if (place !== null && JSON.stringify(place) === last) return this.browser.click(...place);
      last = JSON.stringify(place);
      if (Date.now() > end) throw new Error(`${selector} cannot be clicked`);
    }
  }

  locator(selector) {
    const boundingBox = () => this.$eval(selector, (element) => element.getBoundingClientRect().toJSON());
    const pressSequentially = async (text) => {
      await this.focus(selector);
      await this.keyboard.type(text);
    };
    return { boundingBox, pressSequentially, screenshot: () => this.browser.picture(selector) };
  }

  /** The bytes of the file that the page saves. */
  async download(act, name) {
    rmSync(join(this.browser.downloads, name), { force: true });
    await act();
    return this.browser.downloaded(name);
  }

  /** What the page copies, through the clipboard itself. */
  async copied(act) {
    await act();
    return this.browser.runInBrowser(`
      const item = Cc["@mozilla.org/widget/transferable;1"].createInstance(Ci.nsITransferable);
      item.init(null);
      item.addDataFlavor("text/plain");
      Services.clipboard.getData(item, Ci.nsIClipboard.kGlobalClipboard);
      const data = {};
      item.getTransferData("text/plain", data);
      return data.value.QueryInterface(Ci.nsISupportsString).data;`);
  }

  async screenshot({ path }) {
    writeFileSync(path, await this.browser.picture());
  }

  /** Forgets what the page has stored; errors of the page are failures. */
  async close() {
    await this.browser.run("localStorage.clear()");
    const errors = await this.browser.runInBrowser("return Services.console.getMessageArray().filter((m) => m instanceof Ci.nsIScriptError && m.sourceName.startsWith('file:') && !(m.flags & m.warningFlag)).map((m) => m.errorMessage)");
    if (errors.length > 0) throw new Error(errors.join("; "));
  }
}
