// SPDX-License-Identifier: MIT
import { Address } from "./address.js";
import { App } from "./app.js";
import { openTab, setUpHover, setUpKeys, setUpPointer, setUpTabs, setUpToolbar, Theme, upOf } from "./controls.js";
import { readScene } from "./data.js";
import { Details } from "./details.js";
import { byId } from "./dom.js";
import { clashCount } from "./exact.js";
import { Explosion } from "./explode.js";
import { wholeOf } from "./extent.js";
import { setUpAxes } from "./ground.js";
import { setUpHiding } from "./hiding.js";
import { setUpPictures, setUpSaving } from "./listed.js";
import { ModelPanel, PairPanel } from "./lists.js";
import { Margin } from "./margin.js";
import { Measure } from "./measure.js";
import { Stage } from "./stage.js";
import { Section } from "./section.js";
import { showSummary } from "./summary.js";
import { Timeline } from "./timeline.js";

/** The picture, or null with a word on why there is none: lists and details work without it. */
function makeStage(scene, whole) {
  try {
    return new Stage(byId("canvas"), scene, whole);
  } catch (problem) {
    byId("no-picture").hidden = false;
    byId("no-picture").textContent = `No picture: this browser has no WebGL 2 (${problem.message}).`;
    return null;
  }
}

/** Notes, for whoever measures, when the lists, a picture and the whole picture were there: milliseconds from the start. */
function note(what) {
  document.documentElement.dataset[what] = Math.round(performance.now());
}

function showPicture(app, theme, whole) {
  const stage = makeStage(app.scene, whole);
  if (stage) {
    theme.apply = (name) => stage.setTheme(name);
    theme.update();
    stage.resize();
    stage.lookAt(stage.whole);
    app.attach(stage);
    for (const id of ["axes", "explode", "measure"]) byId(id).toggleAttribute("hidden", false);
    const measure = new Measure(app, stage);
    setUpPointer(app, measure);
    setUpHover(app);
    setUpAxes(stage);
    setUpPictures(stage);
    new Section(stage);
    new Explosion(app);
    stage.addEventListener("drawn", () => note("ready"), { once: true });
    stage.addEventListener("complete", () => note("complete"), { once: true });
  } else {
    note("ready");
  }
}

function start() {
  const scene = readScene(document);
  if (!scene) {
    byId("title").textContent = "No scene: this is the empty page that `allpairs view` fills.";
    return;
  }
  scene.upOfInput = scene.up;
  scene.up = upOf(scene);
  document.title = `${scene.title} – Allpairs`;
  byId("version").textContent = `Allpairs ${scene.version}`;
  const app = new App(scene);
  const theme = new Theme(() => {});
  showSummary(app);
  const panels = { pairs: new PairPanel(app), models: new ModelPanel(app) };
  new Details(app);
  setUpSaving(app, panels);
  const timeline = new Timeline(app);
  setUpTabs();
  setUpToolbar(app, theme);
  setUpKeys(app, panels, timeline, theme);
  const whole = wholeOf(scene);
  new Margin(app, Math.hypot(...[0, 1, 2].map((k) => whole[k + 3] - whole[k])));
  if (app.table.size === 0) openTab("models");
  setUpHiding(app);
  const address = new Address(app);
  if (app.models.length === 0 && scene.exact !== null && clashCount(app.table.stateCounts()) > 0) address.without(() => panels.pairs.step(1));
  requestAnimationFrame(() => setTimeout(() => {
    note("loaded");
    showPicture(app, theme, whole);
  }));
}

start();
