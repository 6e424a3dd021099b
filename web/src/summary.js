// SPDX-License-Identifier: MIT
// The top of the panel: how many models and pairs, what was saved, and what was left out.

import { byId, fillWith, make } from "./dom.js";
import { clashCount, kindsOfClashes, state } from "./exact.js";
import { counted, grouped, measure, percent, seconds } from "./format.js";
import { kind, mostExcluded } from "./pairs.js";

function fact(label, value, id, note) {
  const number = make("dd", "", value);
  number.id = id;
  if (note) number.append(make("span", "note", note));
  return make("div", "fact", make("dt", "", label), number);
}

function pairNotes(app) {
  const self = app.counts[kind.self];
  const excluded = app.counts[kind.excluded];
  const notes = [];
  if (app.scene.hasBodies) notes.push(`${grouped(app.table.found)} of models`);
  if (self > 0) notes.push(`${grouped(self)} self`);
  if (excluded > 0) notes.push(`${grouped(excluded)} excluded`);
  return notes.join(", ");
}

/** What the search took, at the bottom: nobody asks for that first. */
function effort({ statistics, frames, exact }) {
  const { testsMade: made, testsOfAllPairs: all, detectSeconds } = statistics;
  const avoided = 1 - made / all;
  const saved = avoided > 0 ? `, ${percent(avoided)} avoided` : "";
  const shapes = exact ? `; shapes tested in ${seconds(exact.seconds)}` : "";
  return `Pairs found in ${seconds(detectSeconds)}${frames.length > 1 ? ` in ${grouped(frames.length)} frames` : ""}: ${grouped(made)} of ${grouped(all)} tests made${saved}${shapes}`;
}

/** How pairs are found at another distance than the page began with, in the words of methodText() in Inputs.cpp. */
function methodAt(method, distance) {
  const boxes = distance === 0 ? "boxes" : `boxes at most ${distance} apart on every axis`;
  return method.replace(/^boxes( at most \S+ apart on every axis)?/, boxes).replace(/(?<=, alarm distance )[^,;]+/, `${distance}`);
}

/** How many clash and how bad, then what does not. */
function exactFacts({ scene, table }) {
  const { exact } = scene;
  const counts = table.stateCounts();
  const clashes = clashCount(counts);
  const worst = exact.worstFirst(Array.from({ length: exact.count }, (_, e) => e));
  const deepest = worst.reduce((most, e) => (exact.stateOf(e) <= state.clash ? Math.max(most, exact.of(e).depth ?? 0) : most), 0);
  const mayShare = counts[state.undecided] + counts[state.notExamined] > 0 || worst.some((e) => exact.stateOf(e) === state.touching && exact.of(e).depth > 0);
  const notes = kindsOfClashes(counts);
  if (clashes === 0 && !mayShare) notes.push("no two models share space");
  if (deepest > 0) notes.push(`deepest\u00a0${measure(deepest)}`);
  const others = [[state.touching, "Touching", "touching"], [state.undecided, "Undecided", "undecided"], [state.clearance, "Near", "clearance"], [state.notExamined, "Not examined", "unknown"]];
  return [
    fact(clashes === 1 ? "Clash" : "Clashes", grouped(clashes), "fact-clashes", notes.join(", ")),
    ...others.filter(([is]) => counts[is] > 0).map(([is, label, id]) => fact(label, grouped(counts[is]), `fact-${id}`, is === state.clearance ? `within ${measure(exact.clearance)}` : "")),
    fact("Apart", grouped(counts[state.apart]), "fact-apart", `of ${counted(counts.reduce((sum, count) => sum + count), scene.hasBodies ? "row" : "candidate")}`),
  ];
}

function remarks(scene) {
  const notes = [];
  if (scene.meshIsShortened) notes.push(make("p", "remark", "Some shapes are left out, because there are too many triangles; their boxes are here."));
  if (scene.leavesOutExcluded) notes.push(make("p", "remark", `More than ${grouped(mostExcluded)} pairs are excluded by a rule: none of them is here.`));
  if (scene.ignored.length > 0) {
    const list = make("ul");
    for (const { file, line, subject, reason } of scene.ignored) {
      const place = [file, line || ""].filter(String).join(":");
      list.append(make("li", "", [...new Set([place, subject, reason])].filter(Boolean).join(": ")));
    }
    notes.push(make("details", "remark", make("summary", "", `${counted(scene.ignored.length, "remark")} on the input`), list));
  }
  return notes;
}

export function showSummary(app) {
  const { scene } = app;
  byId("title").textContent = scene.title;
  const { distance } = scene;
  let isToldOfExcluded; // another margin has others
  const update = () => {
    const isOfProgram = scene.distance === distance; // and not found again by the page
    byId("method").textContent = isOfProgram ? scene.method : methodAt(scene.method, scene.distance);
    byId("effort").textContent = isOfProgram ? effort(scene) : "";
    if (isToldOfExcluded !== scene.leavesOutExcluded) fillWith(byId("remarks"), ...remarks(scene));
    isToldOfExcluded = scene.leavesOutExcluded;
    const found = scene.exact ? exactFacts(app) : [fact(scene.hasBodies ? "Pairs of bodies" : "Pairs", grouped(app.counts[kind.pair] + app.counts[kind.self]), "fact-pairs", pairNotes(app))];
    fillWith(
      byId("facts"),
      ...found,
      fact("Models", grouped(scene.models), "fact-models"),
    );
    byId("fact-clashes")?.classList.toggle("none", clashCount(app.table.stateCounts()) === 0);
  };
  app.addEventListener("frame", update);
  update();
}
