// SPDX-License-Identifier: MIT
// The pairs of another margin, found again in the page from boxes and rules, exactly as `allpairs detect --distance` finds them.

import { byId } from "./dom.js";
import { measure } from "./format.js";
import { explain, isEmpty } from "./rules.js";

const mostModels = 20_000; // of more, moving the slider would be slower than asking the program
const byRule = new Set(["not-simulated", "same-owner", "same-group"]);

/** Calls `visit(newer, older)` for all pairs of boxes that may be within the distance: those near on x. */
function sweep(scene, boxes, distance, visit) {
  const widest = scene.addsContactDistances ? scene.contactDistances.reduce((most, d) => Math.max(most, d), 0) : 0;
  const sum = distance + 2 * widest;
  const reach = sum + 1e-9 * Math.abs(sum); // more than any sum that is compared below
  const order = Array.from({ length: scene.models }, (_, i) => i).filter((i) => !isEmpty(boxes, i));
  order.sort((a, b) => boxes[6 * a] - boxes[6 * b]);
  for (let p = 0; p < order.length; ++p) {
    const a = order[p];
    const end = boxes[6 * a + 3] + reach + 1e-12 * Math.abs(boxes[6 * a + 3]); // NaN of what is infinite: near to all
    for (let q = p + 1; q < order.length && !(boxes[6 * order[q]] > end); ++q) visit(Math.max(a, order[q]), Math.min(a, order[q]));
  }
}

const flat = (pairs) => Uint32Array.from(pairs.sort(([a, b], [c, d]) => a - c || b - d).flat());

/** The pairs of a frame at a distance, newer first and in order, and those that only a rule excludes. */
export function pairsAt(scene, frame, distance) {
  const at = { ...scene, distance };
  const near = { ...at, groupSets: [[]], groups: new Uint32Array(scene.models), owners: Uint32Array.from({ length: scene.models }, (_, i) => i) };
  const allSimulated = { ...frame, flags: frame.flags.map((flags) => flags | 2) };
  const pairs = [];
  const excluded = [];
  sweep(scene, frame.boxes, distance, (newer, older) => {
    const { verdict } = explain(at, frame, newer, older);
    if (verdict === "pair") pairs.push([newer, older]);
    else if (byRule.has(verdict) && explain(near, allSimulated, newer, older).verdict === "pair") excluded.push([newer, older]);
  });
  for (let i = 0; i < scene.models; ++i) {
    if (explain(at, frame, i, i).verdict === "pair") pairs.push([i, i]);
  }
  return { pairs: flat(pairs), excluded: flat(excluded) };
}

const isOffered = ({ frames, exact, region, sequence, models, distance }) => Number.isFinite(distance) && frames.length === 1 && exact === null && region === null && sequence === null && models <= mostModels;

/** As many digits as a slider has. */
const rounded = (distance) => Number(distance.toPrecision(3));

/** The slider above the pairs, and the number beside it, which may be any, below 0 too. */
export class Margin {
  constructor(app, size) {
    this.app = app;
    this.element = byId("margin");
    this.element.hidden = !isOffered(app.scene) || !(size > 0);
    if (this.element.hidden) return;
    const { distance, frames: [frame] } = app.scene;
    this.first = { distance, pairs: frame.pairs, excluded: frame.excluded };
    this.most = Math.max(size / 5, 2 * distance);
    this.slider = byId("margin-slider");
    this.number = byId("margin-number");
    this.slider.addEventListener("input", () => this.soon(this.most * (this.slider.value / 1000) ** 2)); // finer near 0
    this.number.addEventListener("change", () => this.set(this.number.value === "" ? app.scene.distance : Number(this.number.value)));
    byId("margin-reset").addEventListener("click", () => this.set(distance));
    this.show(distance);
  }

  soon(distance) {
    this.show(rounded(distance));
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.set(rounded(distance)), 40);
  }

  show(distance) {
    this.number.value = distance;
    this.slider.value = 1000 * Math.sqrt(Math.max(0, Math.min(1, distance / this.most)));
    this.slider.setAttribute("aria-valuetext", measure(distance));
    byId("margin-reset").hidden = distance === this.first.distance;
  }

  set(distance) {
    const { app } = this;
    const [frame] = app.scene.frames;
    const found = distance === this.first.distance ? this.first : pairsAt(app.scene, frame, distance);
    frame.pairs = found.pairs;
    frame.excluded = found.excluded;
    app.scene.distance = distance;
    this.show(distance);
    app.setFrame(0);
    app.choose(app.chosenPair ?? app.models, { look: false });
  }
}
