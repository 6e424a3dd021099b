// SPDX-License-Identifier: MIT
// Buttons over the picture, keys, pointer, and the choice between dark and light.

import { byId } from "./dom.js";
import { copyNames } from "./listed.js";
import { paint } from "./palette.js";

const stored = (key) => {
  try {
    return localStorage.getItem(key);
  } catch {
    return null; // a page from disk may have no storage
  }
};

const store = (key, value) => {
  try {
    localStorage.setItem(key, value);
  } catch {
    // then it is asked again next time
  }
};

export class Theme {
  constructor(apply) {
    this.apply = apply;
    this.system = matchMedia("(prefers-color-scheme: dark)");
    this.system.addEventListener("change", () => this.update());
    this.choice = stored("allpairs-theme");
    this.update();
  }

  get current() {
    return this.choice ?? (this.system.matches ? "dark" : "light");
  }

  toggle() {
    this.choice = this.current === "dark" ? "light" : "dark";
    store("allpairs-theme", this.choice);
    this.update();
  }

  update() {
    document.documentElement.dataset.theme = this.current;
    paint(document.documentElement, this.current);
    this.apply(this.current);
  }
}

const upKey = (scene) => `allpairs-up ${scene.upOfInput} ${scene.title}`;

/** Which axis the reader has turned up where the same one was before, or else the one that the input or --up says: 1 to
 * 3, below 0 for the other way. */
export function upOf(scene) {
  const choice = Number(stored(upKey(scene)));
  return [1, 2, 3, scene.up].includes(choice) ? choice : scene.up;
}

/** Shows one of the two lists. */
export function openTab(name) {
  for (const tab of ["pairs", "models"]) {
    byId(`tab-${tab}`).setAttribute("aria-selected", tab === name);
    byId(`tab-${tab}`).tabIndex = tab === name ? 0 : -1;
    byId(`panel-${tab}`).hidden = tab !== name;
  }
}

export const currentTab = () => (byId("panel-pairs").hidden ? "models" : "pairs");

export function setUpTabs() {
  for (const name of ["pairs", "models"]) {
    const tab = byId(`tab-${name}`);
    tab.addEventListener("click", () => openTab(name));
    tab.addEventListener("keydown", (event) => {
      if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
      const other = name === "pairs" ? "models" : "pairs";
      openTab(other);
      byId(`tab-${other}`).focus();
    });
  }
}

/** Buttons that switch what is drawn. */
export function setUpToolbar(app, theme) {
  const ups = [1, 2, 3, ...(app.scene.upOfInput < 0 ? [app.scene.upOfInput] : [])];
  const nextMode = { outlines: "solid", solid: "outlines" };
  const acts = {
    "show-boxes": () => app.toggle("boxes"),
    "box-mode": () => app.setBoxMode(nextMode[app.boxMode]),
    "show-shapes": () => app.toggle("shapes"),
    "show-links": () => app.toggle("links"),
    "show-excluded": () => app.toggle("excluded"),
    "show-region": () => app.toggle("region"),
    "frame-all": () => app.lookAtAll(),
    "up-axis": () => {
      if (!app.stage) return;
      app.stage.setUp(ups[(ups.indexOf(app.stage.up) + 1) % ups.length]);
      store(upKey(app.scene), app.stage.up);
      update();
    },
    "theme": () => theme.toggle(),
    "help-button": () => toggleHelp(),
  };
  for (const [id, act] of Object.entries(acts)) byId(id).addEventListener("click", act);
  const update = () => {
    for (const what of ["boxes", "shapes", "links", "excluded", "region"]) byId(`show-${what}`).setAttribute("aria-pressed", app.show[what]);
    byId("box-mode").textContent = app.boxMode === "solid" ? "solid" : "outlines";
    const up = app.stage?.up ?? app.scene.up;
    byId("up-axis").textContent = `${up < 0 ? "−" : ""}${"xyz"[Math.abs(up) - 1]} up`;
  };
  if (app.scene.exact !== null) {
    for (const item of document.querySelectorAll(".legend li")) item.hidden = item.id !== "legend-clash";
  }
  byId("show-shapes").hidden = app.scene.mesh.vertices.length === 0;
  byId("show-region").hidden = app.scene.region === null;
  const updateExcluded = () => (byId("show-excluded").hidden = app.scene.frames.every((frame) => frame.excluded.length === 0));
  if (app.scene.frames.length === 1) app.addEventListener("frame", updateExcluded); // another margin has others
  app.addEventListener("show", update);
  updateExcluded();
  update();
}

export function toggleHelp() {
  const help = byId("help");
  if (help.open) help.close();
  else help.showModal();
}

function keysOf(app, panels, timeline, theme) {
  const search = () => byId(`${currentTab()}-search`).focus();
  const press = (id) => byId(id).hidden || byId(id).click();
  return {
    "?": toggleHelp,
    "/": search,
    p: () => openTab("pairs"),
    m: () => openTab("models"),
    j: () => panels[currentTab()].step(1),
    k: () => panels[currentTab()].step(-1),
    n: () => panels[currentTab()].step(1),
    N: () => panels[currentTab()].step(-1),
    f: () => app.lookAtChosen(),
    a: () => app.lookAtAll(),
    b: () => press("show-boxes"),
    o: () => press("box-mode"),
    g: () => press("show-shapes"),
    l: () => press("show-links"),
    e: () => press("show-excluded"),
    r: () => press("show-region"),
    s: () => press("section"),
    x: () => press("explode"),
    d: () => press("measure"),
    c: () => copyNames(app),
    h: () => app.changeVisibility("hide", app.models),
    i: () => app.changeVisibility("isolate", app.models),
    z: () => app.changeVisibility("undo"),
    H: () => app.changeVisibility("showAll"),
    u: () => press("up-axis"),
    t: () => theme.toggle(),
    " ": () => timeline.toggle(),
    ",": () => timeline.step(-1),
    ".": () => timeline.step(1),
    Escape: () => (byId("measure").getAttribute("aria-pressed") === "true" ? press("measure") : app.choose([])),
    "+": () => app.stage?.steer("approach", 1),
    "=": () => app.stage?.steer("approach", 1), // where + is with Shift
    "-": () => app.stage?.steer("approach", -1),
  };
}

const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** Arrows turn the picture, with Shift they move it, unless they mean something where the focus is. */
function steerByArrow(app, event) {
  const isElsewhere = event.target !== document.body && event.target !== byId("canvas");
  if (isElsewhere || !(event.key in arrows) || !app.stage) return false;
  app.stage.steer(event.shiftKey ? "move" : "turn", ...arrows[event.key]);
  event.preventDefault();
  return true;
}

export function setUpKeys(app, panels, timeline, theme) {
  const keys = keysOf(app, panels, timeline, theme);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || byId("help").open) return;
    const inText = event.target.matches("input[type=search], input[type=number], select");
    if (inText && event.key === "Escape") {
      event.preventDefault(); // Chromium would empty the field, and not say so
      return event.target.blur();
    }
    if (steerByArrow(app, event) || inText || !(event.key in keys)) return;
    if (event.key === " " && event.target.matches("button, summary")) return;
    event.preventDefault();
    keys[event.key]();
  });
}

/** The name of the model under the pointer, while that rests. */
export function setUpHover(app) {
  const { stage } = app;
  const label = byId("hover");
  const rest = 60; // milliseconds: of many triangles, looking takes some
  const gap = 14; // pixels from the pointer
  let timer;
  const hide = () => {
    clearTimeout(timer);
    label.hidden = true;
  };
  const show = (event) => {
    const model = app.hitAt(event.clientX, event.clientY, !app.show.shapes)?.model ?? -1;
    if (model < 0) return;
    label.textContent = app.scene.nameOf(model);
    label.hidden = false;
    const area = stage.canvas.getBoundingClientRect();
    const left = Math.min(event.clientX - area.left + gap, area.width - label.offsetWidth);
    const top = Math.min(event.clientY - area.top + gap, area.height - label.offsetHeight);
    label.style.transform = `translate(${Math.max(0, left)}px, ${Math.max(0, top)}px)`;
  };
  stage.canvas.addEventListener("pointermove", (event) => {
    hide();
    if (event.buttons === 0 && event.pointerType !== "touch") timer = setTimeout(() => show(event), rest);
  });
  for (const name of ["pointerdown", "pointerleave", "wheel"]) stage.canvas.addEventListener(name, hide, { passive: true });
}

const clickReach = 4; // pixels that a click may move before it is a drag

/** A click chooses the model under the pointer, then with a click on a partner of it their pair, or while points are measured
 * takes a point; with Shift, boxes count and not shapes. */
export function setUpPointer(app, measure) {
  const { stage } = app;
  if (!stage) return;
  let down = null;
  stage.canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
  stage.canvas.addEventListener("pointerup", (event) => {
    if (!down || event.button !== 0) return;
    const moved = Math.hypot(event.clientX - down[0], event.clientY - down[1]);
    down = null;
    if (moved > clickReach) return;
    const onlyBoxes = event.shiftKey || !app.show.shapes;
    if (measure.isOn) return measure.add(event.clientX, event.clientY, onlyBoxes);
    const model = app.hitAt(event.clientX, event.clientY, onlyBoxes)?.model ?? -1;
    const models = model < 0 ? [] : app.pairWith(model) ?? [model];
    app.choose(models, { look: false });
    if (model >= 0) openTab(models.length === 2 ? "pairs" : "models");
  });
  stage.canvas.addEventListener("dblclick", () => app.lookAtChosen());
}
