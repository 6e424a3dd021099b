// SPDX-License-Identifier: MIT
// Firefox on a page: the few words of its own protocol, Marionette, that a test needs. Each message is a length, a
// colon, and [0, number, command, parameters]; the answer is [1, number, problem, result].

import { spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

const firefox = "/usr/bin/firefox-esr";
export const hasFirefox = [firefox, "/usr/bin/Xvfb"].every(existsSync);

const settings = `
user_pref("marionette.port", 0);
user_pref("toolkit.legacyUserProfileCustomizations.stylesheets", true);
user_pref("webgl.force-enabled", true);
user_pref("browser.shell.checkDefaultBrowser", false);
user_pref("datareporting.policy.dataSubmissionEnabled", false);
user_pref("toolkit.telemetry.enabled", false);
user_pref("app.update.enabled", false);
user_pref("network.captive-portal-service.enabled", false);
user_pref("network.connectivity-service.enabled", false);
user_pref("browser.download.folderList", 2);
user_pref("browser.download.always_ask_before_handling_new_types", false);
user_pref("browser.helperApps.neverAsk.saveToDisk", "application/octet-stream,text/csv,application/json,image/png");
`;

const narrow = ":root, body { min-width: 0 !important; min-height: 0 !important; }"; // a window as small as a phone

const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

/** Tries until something is there, for a minute. */
async function until(attempt, what) {
  for (let i = 0; i < 600; ++i) {
    const result = await attempt();
    if (result) return result;
    await pause(100);
  }
  throw new Error(`${what} did not come`);
}

export class Firefox {
  static async start(width, height) {
    const browser = new Firefox();
    browser.profile = mkdtempSync(join(tmpdir(), "allpairs-firefox-"));
    browser.downloads = join(browser.profile, "downloads");
    mkdirSync(join(browser.profile, "chrome"));
    writeFileSync(join(browser.profile, "chrome/userChrome.css"), narrow);
    writeFileSync(join(browser.profile, "user.js"), `${settings}user_pref("browser.download.dir", "${browser.downloads}");\n`);
    const display = await browser.startDisplay(width, height);
    const words = ["--no-remote", "--marionette", "--remote-allow-system-access", "--profile", browser.profile, `--window-size=${width},${height}`];
    browser.process = spawn(firefox, words, { stdio: "ignore", env: { ...process.env, HOME: browser.profile, DISPLAY: display } });
    await browser.connect();
    await browser.command("WebDriver:NewSession", {});
    return browser;
  }

  /** A display that nobody sees: without one, Firefox has no WebGL. */
  async startDisplay(width, height) {
    this.display = spawn("Xvfb", ["-displayfd", "3", "-nolisten", "tcp", "-screen", "0", `${width}x${height}x24`], { stdio: ["ignore", "ignore", "ignore", "pipe"] });
    const [number] = await once(this.display.stdio[3], "data");
    return `:${String(number).trim()}`;
  }

  async connect() {
    const file = join(this.profile, "MarionetteActivePort");
    const port = await until(() => existsSync(file) && readFileSync(file, "utf8").trim(), "Firefox");
    this.socket = connect(Number(port), "127.0.0.1");
    this.waiting = new Map();
    this.bytes = Buffer.alloc(0);
    this.count = 0;
    this.socket.on("data", (bytes) => this.take(bytes));
    await new Promise((done, failed) => this.socket.once("connect", done).once("error", failed));
  }

  take(bytes) {
    this.bytes = Buffer.concat([this.bytes, bytes]);
    for (let colon = this.bytes.indexOf(":"); colon > 0; colon = this.bytes.indexOf(":")) {
      const end = colon + 1 + Number(this.bytes.subarray(0, colon));
      if (this.bytes.length < end) return;
      const message = JSON.parse(this.bytes.subarray(colon + 1, end));
      this.bytes = this.bytes.subarray(end);
      if (Array.isArray(message)) this.answer(message);
    }
  }

  answer([, number, problem, result]) {
    const { done, failed } = this.waiting.get(number);
    this.waiting.delete(number);
    if (problem) failed(new Error(problem.message));
    else done(result);
  }

  command(name, parameters) {
    const text = Buffer.from(JSON.stringify([0, ++this.count, name, parameters]));
    this.socket.write(Buffer.concat([Buffer.from(`${text.length}:`), text]));
    return new Promise((done, failed) => this.waiting.set(this.count, { done, failed }));
  }

  open = (path) => this.command("WebDriver:Navigate", { url: `file://${path}` });
  run = async (script, ...args) => (await this.command("WebDriver:ExecuteScript", { script, args })).value;
  until = (script) => until(() => this.run(`return ${script}`), script);

  /** Presses keys, all of them before the first is let go. */
  async press(...keys) {
    const actions = [...keys.map((value) => ({ type: "keyDown", value })), ...keys.reverse().map((value) => ({ type: "keyUp", value }))];
    await this.command("WebDriver:PerformActions", { actions: [{ type: "key", id: "keys", actions }] });
  }

  /** Moves the pointer to a place of the page, and then does what `actions` say. */
  async point(x, y, ...actions) {
    const move = { type: "pointerMove", x: Math.round(x), y: Math.round(y), duration: 0 };
    await this.command("WebDriver:PerformActions", { actions: [{ type: "pointer", id: "pointer", parameters: { pointerType: "mouse" }, actions: [move, ...actions] }] });
  }

  click = (x, y) => this.point(x, y, { type: "pointerDown", button: 0 }, { type: "pointerUp", button: 0 });

  /** Makes the page, without the window around it, so large. */
  async resize(width, height) {
    const [around, above] = await this.run("return [outerWidth - innerWidth, outerHeight - innerHeight]");
    await this.command("WebDriver:SetWindowRect", { x: 0, y: 0, width: width + around, height: height + above });
    await this.until(`innerWidth === ${width} && innerHeight === ${height}`);
  }

  /** What a script of the browser itself, not of the page, gives. */
  async runInBrowser(script) {
    await this.command("Marionette:SetContext", { value: "chrome" });
    try {
      return await this.run(script);
    } finally {
      await this.command("Marionette:SetContext", { value: "content" });
    }
  }

  /** The bytes of a file that the page saved. */
  async downloaded(name) {
    const path = join(this.downloads, name);
    await until(() => existsSync(path) && !existsSync(`${path}.part`) && statSync(path).size > 0, name);
    return readFileSync(path);
  }

  /** The bytes of a picture of the page, or of an element of it. */
  async picture(selector) {
    const element = selector && (await this.command("WebDriver:FindElement", { using: "css selector", value: selector }));
    const id = element && Object.values(element.value)[0];
    const { value } = await this.command("WebDriver:TakeScreenshot", { full: false, ...(id && { id, hash: false, scroll: false }) });
    return Buffer.from(value, "base64");
  }

  screenshot = async (path) => writeFileSync(path, await this.picture());

  async stop() {
    const ended = new Promise((done) => this.process.once("exit", done));
    await this.command("Marionette:Quit", { flags: ["eForceQuit"] }).catch(() => this.process.kill());
    await ended;
    this.display.kill();
    rmSync(this.profile, { recursive: true, force: true });
  }
}
