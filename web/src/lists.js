// SPDX-License-Identifier: MIT
// The two lists of the panel: pairs and models, with search, order and filters.

import { byId, button, fillWith, make, nameLine } from "./dom.js";
import { counted, grouped, measure } from "./format.js";
import { VirtualList } from "./list.js";
import { shortFinding, state, stateWords, states } from "./exact.js";
import { kind } from "./pairs.js";
import { flag } from "./rules.js";

export const kindNames = ["free", "pair", "self", "excluded", "out"];

/** Which models' names, or those of their bodies, have a word in them, for each word. */
export function masksOf(scene, query) {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  const namesOf = scene.hasBodies ? (i) => `${scene.nameOf(i)}\n${scene.bodyNameOf(i)}` : scene.nameOf;
  return words.map((word) => Uint8Array.from({ length: scene.models }, (_, i) => (namesOf(i).toLowerCase().includes(word) ? 1 : 0)));
}

/** Button with a count that switches a filter on and off. */
function chip(label, count, className, state, changed) {
  const element = button("", () => {
    state.on = !state.on;
    element.setAttribute("aria-pressed", state.on);
    changed();
  });
  element.className = `chip ${className}`;
  element.setAttribute("aria-pressed", state.on);
  element.append(make("span", "dot"), `${label} `, make("b", "", grouped(count)));
  return element;
}

class Panel {
  constructor(app, name) {
    this.app = app;
    this.name = name;
    this.search = byId(`${name}-search`);
    this.sort = byId(`${name}-sort`);
    this.chips = byId(`${name}-chips`);
    this.status = byId(`${name}-status`);
    this.filters = new Map();
    this.items = [];
    this.list = new VirtualList(byId(`${name}-list`), {
      label: name,
      fill: (row, index) => this.fill(row, this.items[index]),
      choose: (index) => this.chooseItem(this.items[index]),
    });
    this.search.addEventListener("input", () => this.update());
    this.sort.addEventListener("change", () => this.update());
    app.addEventListener("frame", () => this.renew());
    app.addEventListener("choice", () => this.mark());
    app.addEventListener("visibility", () => this.list.refresh());
  }

  filter(key) {
    if (!this.filters.has(key)) this.filters.set(key, { on: true });
    return this.filters.get(key);
  }

  renew() {
    fillWith(this.chips, ...this.makeChips());
    this.update();
  }

  update() {
    this.items = this.select(masksOf(this.app.scene, this.search.value));
    this.list.setLength(this.items.length);
    this.status.textContent = this.items.length === 0 ? "none" : this.statusText();
    this.mark();
  }

  mark() {
    const item = this.chosenItem();
    this.list.setCurrent(item === -1 ? -1 : this.items.indexOf(item), !this.isChoosing);
  }

  chooseItem(item) {
    this.isChoosing = true; // the row is in sight already: don't move the list under the pointer
    this.app.choose(this.modelsOf(item));
    this.isChoosing = false;
  }

  /** Chooses the next item, or with -1 the one before. */
  step(by) {
    if (this.items.length === 0) return;
    const at = this.items.indexOf(this.chosenItem());
    const next = at < 0 ? (by > 0 ? 0 : this.items.length - 1) : (at + by + this.items.length) % this.items.length;
    this.app.choose(this.modelsOf(this.items[next]));
  }
}

/** What marks the row of what the reader has hidden; nothing on other rows. */
export function hiddenMark(row, isHidden) {
  row.classList.toggle("unseen", isHidden);
  return isHidden ? [make("span", "tag", "hidden")] : [];
}

const stateFilter = (is) => `state ${is}`;
const nearFilter = "near"; // beside the kinds

export class PairPanel extends Panel {
  constructor(app) {
    super(app, "pairs");
    if (app.scene.exact !== null) {
      this.sort.prepend(new Option("worst first", "worst", true, true));
      this.filter(stateFilter(state.apart)).on = false;
      this.filter(kind.excluded).on = false;
      byId("pairs-value").textContent = "depth or gap";
    }
    this.renew();
  }

  makeChips() {
    const { counts, scene } = this.app;
    if (scene.exact !== null) return this.makeStateChips(this.app.table.stateCounts(), counts[kind.excluded]);
    const near = this.countNear();
    return [["overlapping", kind.pair, counts[kind.pair] - near], ["within the distance", kind.pair, near, nearFilter], ["self", kind.self, counts[kind.self]], ["excluded", kind.excluded, counts[kind.excluded]]]
      .filter(([, , count]) => count > 0)
      .map(([label, is, count, key = is]) => chip(label, count, kindNames[is], this.filter(key), () => this.update()));
  }

  /** How many rows are pairs only because of the distance. */
  countNear() {
    const { table } = this.app;
    let count = 0;
    for (let entry = 0; entry < table.size; ++entry) count += table.isRow(entry) && table.isNear(entry) ? 1 : 0;
    return count;
  }

  makeStateChips(counts, excluded) {
    const chips = counts.map((count, is) => [stateWords[is], count, states[is], stateFilter(is)]);
    return [...chips, ["excluded", excluded, "excluded", kind.excluded]]
      .filter(([, count]) => count > 0)
      .map(([label, count, className, key]) => chip(label, count, className, this.filter(key), () => this.update()));
  }

  filterOf(entry) {
    const { table } = this.app;
    const isTested = table.exact !== null && entry < table.found;
    if (isTested) return this.filter(stateFilter(table.exact.stateOf(entry)));
    return this.filter(table.isNear(entry) ? nearFilter : table.kindOf(entry));
  }

  select(masks) {
    const { table } = this.app;
    const has = (entry) => masks.every((mask) => mask[table.first(entry)] || mask[table.second(entry)]);
    const items = [];
    for (let entry = 0; entry < table.size; ++entry) {
      if (table.isRow(entry) && this.filterOf(entry).on && table.rowOf(entry).some(has)) items.push(entry);
    }
    return this.ordered(items);
  }

  ordered(items) {
    const { table, scene } = this.app;
    if (this.sort.value === "worst") {
      const tested = table.exact.worstFirst(items.filter((e) => e < table.found));
      return tested.concat(items.filter((e) => e >= table.found));
    }
    if (this.sort.value === "volume") {
      const volumes = Float64Array.from({ length: table.size }, (_, e) => table.volume(e));
      return items.sort((a, b) => volumes[b] - volumes[a] || a - b);
    }
    if (this.sort.value === "name") {
      const order = namesInOrder(scene);
      return items.sort((a, b) => order[table.first(a)] - order[table.first(b)] || order[table.second(a)] - order[table.second(b)]);
    }
    return items;
  }

  statusText() {
    return counted(this.items.length, "entry", "entries");
  }

  chosenItem() {
    const { entry, table } = this.app;
    return entry >= 0 ? table.rowOf(entry)[0] : -1;
  }

  modelsOf(entry) {
    return [this.app.table.first(entry), this.app.table.second(entry)];
  }

  fill(row, entry) {
    const { table, scene } = this.app;
    const is = table.kindOf(entry);
    const inside = table.rowOf(entry).length;
    const [first, second] = this.modelsOf(entry).map(inside > 1 ? scene.bodyNameOf : scene.nameOf);
    const finding = table.exact !== null && entry < table.found ? table.exact.of(entry) : null;
    row.classList.add(finding ? states[finding.state] : kindNames[is]);
    const names = first === second ? [nameLine(first), make("span", "with", "with itself")] : [nameLine(first), nameLine(second)];
    const count = inside > 1 ? [make("span", "tag", `${grouped(inside)} pairs`)] : [];
    const hidden = hiddenMark(row, !table.rowOf(entry).some((e) => this.app.isInSight(e)));
    row.append(make("span", "dot"), make("span", "names", ...names), ...count, ...hidden, make("span", "value", finding ? shortFinding(finding) : table.exact ? "" : boxFinding(table, entry)));
    row.title = is === kind.self ? `${first} with itself` : `${first}\n${second}`;
  }
}

/** What two boxes share, or how far they are apart. */
function boxFinding(table, entry) {
  const gap = table.gap(entry);
  return gap > 0 ? `${measure(gap)} apart` : measure(table.volume(entry));
}

/** The place of each model when all are ordered by name, "part 9" before "part 10". */
function namesInOrder(scene) {
  if (!scene.nameOrder) {
    const compare = new Intl.Collator(undefined, { numeric: true }).compare;
    const models = Array.from({ length: scene.models }, (_, i) => i);
    models.sort((a, b) => compare(scene.nameOf(a), scene.nameOf(b)) || a - b);
    scene.nameOrder = new Uint32Array(scene.models);
    models.forEach((model, place) => (scene.nameOrder[model] = place));
  }
  return scene.nameOrder;
}

/** The flags and groups of a model, in words. */
export function tagsOf(app, model) {
  const { scene, frame } = app;
  const flags = frame.flags[model];
  const tags = [];
  if (!(flags & flag.active)) tags.push("inactive");
  if (flags & flag.noElements) tags.push("no elements");
  if (flags & flag.outside) tags.push("outside");
  if (!(flags & flag.simulated)) tags.push("not simulated");
  if (!(flags & flag.moving)) tags.push("static");
  if (flags & flag.selfCollision) tags.push("self");
  const groups = scene.groupSets[scene.groups[model]];
  if (groups.length > 0) tags.push(`group ${groups.join(", ")}`);
  return tags;
}

export class ModelPanel extends Panel {
  constructor(app) {
    super(app, "models");
    this.renew();
  }

  makeChips() {
    const counts = new Map();
    for (const is of this.app.kinds) counts.set(is, (counts.get(is) ?? 0) + 1);
    const labels = [[this.app.scene.exact ? "with partners" : "in pairs", kind.pair], ["self only", kind.self], ["excluded", kind.excluded], ["free", kind.free], ["left out", kind.out]];
    return labels
      .filter(([, is]) => counts.has(is))
      .map(([label, is]) => chip(label, counts.get(is), kindNames[is], this.filter(is), () => this.update()));
  }

  select(masks) {
    const { scene, kinds, partners } = this.app;
    const items = [];
    for (let i = 0; i < scene.models; ++i) {
      if (this.filter(kinds[i]).on && masks.every((mask) => mask[i])) items.push(i);
    }
    if (this.sort.value === "name") items.sort((a, b) => namesInOrder(scene)[a] - namesInOrder(scene)[b]);
    if (this.sort.value === "partners") items.sort((a, b) => partners[b] - partners[a] || a - b);
    return items;
  }

  statusText() {
    return counted(this.items.length, "model");
  }

  chosenItem() {
    return this.app.models.length === 1 ? this.app.models[0] : -1;
  }

  modelsOf(model) {
    return [model];
  }

  fill(row, model) {
    const { app } = this;
    row.classList.add(kindNames[app.kinds[model]]);
    const tags = hiddenMark(row, !app.visibility.isShown(model)).concat(tagsOf(app, model).map((tag) => make("span", "tag", tag)));
    const name = app.scene.nameOf(model);
    row.append(make("span", "dot"), make("span", "names", nameLine(name), ...tags), make("span", "value", grouped(app.partners[model])));
    row.title = `${name}\n${app.scene.typeNames[app.scene.types[model]]}, model ${model}`;
  }
}
