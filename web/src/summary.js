// SPDX-License-Identifier: MIT
// The top of the panel: how many models and pairs, what was saved, and what was left out.

import { byId, fillWith, make } from "./dom.js";
import { counted, grouped, percent, seconds } from "./format.js";
import { kind } from "./pairs.js";

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
  if (self > 0) notes.push(`${grouped(self)} self`);
  if (excluded > 0) notes.push(`${grouped(excluded)} excluded`);
  return notes.join(", ");
}

function testsAvoided({ statistics }) {
  const all = statistics.testsOfAllPairs;
  return all === 0 ? "–" : percent(Math.max(0, 1 - statistics.testsMade / all));
}

function remarks(scene) {
  const notes = [];
  if (scene.meshIsShortened) notes.push(make("p", "remark", "Some shapes are left out, because there are too many triangles; their boxes are here."));
  if (scene.ignored.length > 0) {
    const items = scene.ignored.map(({ file, line, subject, reason }) => {
      const place = [file, line || ""].filter(String).join(":");
      return make("li", "", [...new Set([place, subject, reason])].filter(Boolean).join(": "));
    });
    notes.push(make("details", "remark", make("summary", "", `${counted(scene.ignored.length, "remark")} on the input`), make("ul", "", ...items)));
  }
  return notes;
}

export function showSummary(app) {
  const { scene } = app;
  byId("title").textContent = scene.title;
  byId("method").textContent = scene.method;
  fillWith(byId("remarks"), ...remarks(scene));
  const frames = scene.frames.length;
  const inAll = frames > 1 ? `in all ${grouped(frames)} frames` : "";
  const update = () => {
    const { testsMade, testsOfAllPairs, detectSeconds } = scene.statistics;
    fillWith(
      byId("facts"),
      fact("Models", grouped(scene.models), "fact-models"),
      fact("Pairs", grouped(app.table.found), "fact-pairs", pairNotes(app)),
      fact("Tests avoided", testsAvoided(scene), "fact-avoided", `${grouped(testsMade)} of ${grouped(testsOfAllPairs)} made ${inAll}`),
      fact("Time", seconds(detectSeconds), "fact-time", inAll),
    );
  };
  app.addEventListener("frame", update);
  update();
}
