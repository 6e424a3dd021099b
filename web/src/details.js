// SPDX-License-Identifier: MIT
// The bottom of the panel: what is chosen. A pair: what its boxes share. A model: its partners, and why others are none.

import { byId, button, fillWith, make, nameLine } from "./dom.js";
import { findingOf, headingOf, placeOf, shortFinding, state, stateWords } from "./exact.js";
import { coordinate, cornersOf, counted, grouped, measure, reasonText, selfReasonText } from "./format.js";
import { copyNames } from "./listed.js";
import { hiddenMark, tagsOf } from "./lists.js";
import { VirtualList } from "./list.js";
import { sharedExtents, volumeOf } from "./pairs.js";
import { distanceOf, explainAny } from "./rules.js";

const selfText = (reason) => {
  const text = selfReasonText(reason);
  return text.endsWith("itself") ? text : `itself: ${text}`;
};

export class Details {
  constructor(app) {
    this.app = app;
    this.element = byId("details");
    app.addEventListener("choice", () => this.update());
    app.addEventListener("visibility", () => this.list?.refresh());
    this.update();
  }

  update() {
    const { app } = this;
    this.element.hidden = app.models.length === 0;
    if (app.models.length === 0) return fillWith(this.element);
    if (app.chosenPair) return this.showPair(...app.chosenPair);
    return this.showModel(app.models[0]);
  }

  head(...content) {
    const { app } = this;
    const act = (text, how, title) => button(text, () => app.changeVisibility(how, app.models), { title, className: "act" });
    const acts = make("span", "acts", act("hide", "hide", "Hide what is chosen (h)"), act("show only", "isolate", "Hide all else (i)"), button("copy", () => copyNames(app), { title: "Copy the names, a line each (c)", className: "act" }));
    const close = button("×", () => app.choose([]), { title: "Choose nothing (Esc)", className: "close" });
    close.setAttribute("aria-label", "Choose nothing");
    return make("header", "", make("h2", "", ...content), acts, close);
  }

  modelButton(model, className) {
    const name = this.app.scene.nameOf(model);
    return button(name, () => this.app.choose([model]), { className: `link ${className}`, title: `${name}: show the model` });
  }

  showPair(first, second) {
    const { scene, frame } = this.app;
    const isSelf = first === second;
    const { finding } = this.app;
    if (finding && !isSelf) return this.showFinding(finding, first, second);
    const reason = explainAny(scene, frame, first, second);
    const isPair = reason.verdict === "pair";
    const names = make("p", "names", this.modelButton(first, "first"));
    if (!isSelf) names.append(make("span", "and", isPair ? "may touch" : "and"), this.modelButton(second, "second"));
    const verdict = isSelf ? (isPair ? "It may touch itself." : `No pair with itself: ${selfReasonText(reason)}.`) : isPair ? this.nearText(first, second) : `No pair: ${reasonText(reason)}.`;
    fillWith(this.element, this.head(isSelf ? "Self pair" : "Pair"), names, ...(verdict ? [make("p", "verdict", verdict)] : []), this.pairFacts(first, second), ...this.partsOfRow());
  }

  /** Of a pair whose boxes do not overlap, why it is one. */
  nearText(first, second) {
    const isNear = sharedExtents(this.app.frame.boxes, first, second).some((extent) => extent < 0);
    return isNear ? "The boxes do not overlap, but lie within the distance." : "";
  }

  /** The other pairs of the same two bodies, each to be chosen. */
  partsOfRow() {
    const { app } = this;
    const entries = app.entry >= 0 ? app.table.rowOf(app.entry) : [];
    if (entries.length < 2) return [];
    const mostListed = 200; // of more, nobody reads on
    const items = entries.slice(0, mostListed).map((entry) => {
      const models = [app.table.first(entry), app.table.second(entry)];
      const finding = app.scene.exact && entry < app.table.found ? app.scene.exact.of(entry) : null;
      const text = models.map(app.scene.nameOf).join(" and ");
      const item = make("li", "", button(text, () => app.choose(models), { className: "link", title: text }));
      if (finding) item.append(make("span", "note", ` ${[stateWords[finding.state], shortFinding(finding)].filter(Boolean).join(", ")}`));
      if (entry === app.entry) item.setAttribute("aria-current", "true");
      return item;
    });
    if (entries.length > mostListed) items.push(make("li", "note", `and ${grouped(entries.length - mostListed)} more`));
    return [make("h3", "", `${grouped(entries.length)} pairs of their parts`), make("ul", "parts", ...items)];
  }

  showFinding(finding, first, second) {
    const { scene, frame } = this.app;
    const names = make("p", "names", this.modelButton(first, "first"), make("span", "and", "and"), this.modelButton(second, "second"));
    const words = findingOf(finding, scene.nameOf(first), scene.nameOf(second));
    const facts = make("dl", "facts-small");
    const add = (label, value, id) => {
      const cell = make("dd", "", value);
      if (id) cell.id = id;
      facts.append(make("dt", "", label), cell);
    };
    const point = (p) => Array.from(p, (x) => coordinate(Math.abs(x) <= 1e-9 * Math.max(...p.map(Math.abs)) ? 0 : x)).join(", ");
    if (finding.depth > 0) add("Depth", measure(finding.depth), "pair-depth");
    if (finding.state >= state.undecided && finding.state !== state.notExamined) add("Distance", measure(finding.distance), "pair-distance");
    if (finding.state !== state.notExamined) add("At", point(placeOf(finding)), "pair-place");
    if (finding.depth > 0) add("Depth is along", point(finding.normal));
    this.addBox(add, "First box", first);
    this.addBox(add, "Second box", second);
    fillWith(this.element, this.head(headingOf(finding)), names, ...(words ? [make("p", "verdict", words)] : []), facts, ...this.partsOfRow());
  }

  pairFacts(first, second) {
    const { scene, frame } = this.app;
    const extents = sharedExtents(frame.boxes, first, second);
    const table = make("dl", "facts-small");
    const add = (label, value, id) => {
      const cell = make("dd", "", value);
      if (id) cell.id = id;
      table.append(make("dt", "", label), cell);
    };
    if (first === second) {
      this.addBox(add, "Box", first);
      return table;
    }
    const gap = Math.max(...extents.map((extent) => -extent));
    if (gap > 0) add("Apart by", `${measure(gap)} on ${"xyz"[extents.indexOf(-gap)]}`, "pair-gap");
    else add("Volume shared", measure(volumeOf(extents)), "pair-volume");
    add("Overlap x, y, z", extents.map((extent) => measure(extent)).join(", "), "pair-extents");
    add("Gap allowed", measure(distanceOf(scene, Math.max(first, second), Math.min(first, second))));
    this.addBox(add, "First box", first);
    this.addBox(add, "Second box", second);
    return table;
  }

  addBox(add, label, model) {
    add(label, cornersOf(this.app.frame.boxes, model).join(" to "));
  }

  showModel(model) {
    const { scene, frame, table } = this.app;
    const facts = make("dl", "facts-small");
    const add = (label, value) => facts.append(make("dt", "", label), make("dd", "", value));
    add("Type", `${scene.typeNames[scene.types[model]]}, ${counted(scene.elements[model], "element")}`);
    if (scene.ids[model]) {
      add("IFC type", scene.kinds[model]);
      add("GlobalId", scene.ids[model]);
    }
    this.addBox(add, "Box", model);
    if (scene.contactDistances[model] !== 0) add("Contact distance", measure(scene.contactDistances[model]));
    const tags = tagsOf(this.app, model).map((tag) => make("span", "tag", tag));
    const name = make("p", "names", make("span", "model-name", scene.nameOf(model)), ...tags);
    const partners = new Set(table.entriesOf(model).map((e) => (table.first(e) === model ? table.second(e) : table.first(e))));
    const rows = this.othersOf(model, partners, frame);
    const { list, virtual } = this.listOf(model, rows);
    this.list = virtual;
    fillWith(this.element, this.head("Model"), name, facts, this.partnerCount(model, partners), list);
    virtual.setLength(rows.length); // rows are measured, so only now that the list is in the document
  }

  partnerCount(model, partners) {
    const heading = make("h3", "", counted(partners.size, "partner"));
    heading.id = "partner-count";
    const without = this.app.scene.models - partners.size - (partners.has(model) ? 0 : 1);
    if (without > 0) heading.append(make("span", "note", `, and why ${grouped(without)} other${without === 1 ? " is" : "s are"} none`));
    return heading;
  }

  /** Partners first, then all others with the reason, nearest first. */
  othersOf(model, partners, frame) {
    const { scene } = this.app;
    const rows = [...partners].sort((a, b) => a - b).map((other) => ({ other, text: other === model ? "itself" : "partner", isPartner: true }));
    const reasons = [];
    for (let other = 0; other < scene.models; ++other) {
      if (partners.has(other)) continue;
      const reason = explainAny(scene, frame, model, other);
      const isOfBoxes = reason.verdict === "pair" && other !== model; // and none of shapes: then these are told apart
      const text = isOfBoxes ? "the shapes are apart" : other === model ? selfText(reason) : reasonText(reason);
      reasons.push({ other, text, gap: other === model ? -2 : reason.verdict === "apart" ? reason.gap : -1 });
    }
    reasons.sort((a, b) => a.gap - b.gap || a.other - b.other);
    return rows.concat(reasons);
  }

  listOf(model, rows) {
    const list = make("div", "reasons");
    const virtual = new VirtualList(list, {
      label: "Partners, and why others are none",
      fill: (row, index) => this.fillReason(row, rows[index]),
      choose: (index) => this.app.choose([model, rows[index].other]),
    });
    return { list, virtual };
  }

  fillReason(row, { other, text, isPartner }) {
    const name = this.app.scene.nameOf(other);
    row.classList.add(isPartner ? "pair" : "free");
    row.title = `${name}: ${text}`;
    row.append(make("span", "dot"), make("span", "names", nameLine(name), ...hiddenMark(row, !this.app.visibility.isShown(other))), make("span", "reason", text));
  }
}
