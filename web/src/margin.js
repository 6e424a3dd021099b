// SPDX-License-Identifier: MIT
// The pairs of another margin, found again in the page from boxes and rules, exactly as `allpairs detect --distance` finds them.

import { byId } from "./dom.js";
import { grouped, measure } from "./format.js";
import { mostExcluded } from "./pairs.js";
import { areNear, distanceOf, explain, isEmpty } from "./rules.js";

const mostModels = 20_000; // of more, moving the slider would be slower than asking the program
const mostPairs = 2_000_000; // more take seconds, and gigabytes in lists
const byRule = new Set(["not-simulated", "same-owner", "same-group"]);

/** Pairs in any order, as one number each, up to a limit; more are only noted. */
class Pairs {
  constructor(models, most) {
    Object.assign(this, { models, most, keys: new Float64Array(1024), size: 0, areTooMany: false });
  }

  add(newer, older) {
    if (this.size === this.most) this.areTooMany = true;
    if (this.areTooMany) return;
    if (this.size === this.keys.length) {
      const more = new Float64Array(2 * this.size);
      more.set(this.keys);
      this.keys = more;
    }
    this.keys[this.size++] = newer * this.models + older;
  }

  /** Newer, older, newer and so on, ordered; none where there are too many. */
  flat() {
    const keys = this.keys.subarray(0, this.areTooMany ? 0 : this.size).sort();
    return Uint32Array.from({ length: 2 * keys.length }, (_, i) => (i % 2 ? keys[(i - 1) / 2] % this.models : Math.floor(keys[i / 2] / this.models)));
  }
}

/** Calls `visit(newer, older)` for all pairs of boxes within a distance on x, until it returns false. */
function sweep(scene, boxes, distance, visit) {
  const widest = scene.addsContactDistances ? scene.contactDistances.reduce((most, d) => Math.max(most, d), 0) : 0;
  const sum = distance + 2 * widest;
  const reach = sum + 1e-9 * Math.abs(sum); // more than any sum that is compared below
  const order = Array.from({ length: scene.models }, (_, i) => i).filter((i) => !isEmpty(boxes, i));
  order.sort((a, b) => boxes[6 * a] - boxes[6 * b]);
  for (let p = 0; p < order.length; ++p) {
    const a = order[p];
    const end = boxes[6 * a + 3] + reach + 1e-12 * Math.abs(boxes[6 * a + 3]); // NaN of what is infinite: near to all
    for (let q = p + 1; q < order.length && !(boxes[6 * order[q]] > end); ++q) {
      if (!visit(Math.max(a, order[q]), Math.min(a, order[q]))) return;
    }
  }
}

/** The pairs of a frame at a distance, newer first and in order, and those that only a rule excludes, or that these are too many;
 * null where the pairs are. */
export function pairsAt(scene, frame, distance) {
  const at = { ...scene, distance };
  const pairs = new Pairs(scene.models, mostPairs);
  const excluded = new Pairs(scene.models, mostExcluded);
  sweep(scene, frame.boxes, distance, (newer, older) => {
    if (!areNear(frame.boxes, newer, older, distanceOf(at, newer, older))) return true; // most are not, and this is quick
    const { verdict } = explain(at, frame, newer, older);
    if (verdict === "pair") pairs.add(newer, older);
    else if (byRule.has(verdict)) excluded.add(newer, older);
    return !pairs.areTooMany;
  });
  for (let i = 0; i < scene.models; ++i) {
    if (explain(at, frame, i, i).verdict === "pair") pairs.add(i, i);
  }
  return pairs.areTooMany ? null : { pairs: pairs.flat(), excluded: excluded.flat(), leavesOutExcluded: excluded.areTooMany };
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
    const { distance, leavesOutExcluded, frames: [frame] } = app.scene;
    this.first = { distance, pairs: frame.pairs, excluded: frame.excluded, leavesOutExcluded };
    this.most = Math.max(size / 5, 2 * distance);
    this.slider = byId("margin-slider");
    this.number = byId("margin-number");
    this.problem = byId("margin-problem");
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
    this.show(distance);
    this.problem.textContent = found ? "" : `more than ${grouped(mostPairs)} pairs: too many for this page`;
    if (!found) return;
    frame.pairs = found.pairs;
    frame.excluded = found.excluded;
    Object.assign(app.scene, { distance, leavesOutExcluded: found.leavesOutExcluded });
    app.setFrame(0);
    app.choose(app.chosenPair ?? app.models, { look: false });
  }
}
