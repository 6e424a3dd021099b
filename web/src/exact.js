// SPDX-License-Identifier: MIT
// What shapes say of the pairs, where they were tested. The states are those of ExactPair.h, the most serious first.

import { counted, grouped, measure } from "./format.js";

export const states = ["duplicate", "contained", "clash", "touching", "undecided", "clearance", "not-examined", "apart"];
export const stateWords = ["duplicate", "contained", "clash", "touching", "undecided", "within clearance", "not examined", "apart"];
export const state = { duplicate: 0, contained: 1, clash: 2, touching: 3, undecided: 4, clearance: 5, notExamined: 6, apart: 7 };
const headings = ["Duplicate", "Contained", "Clash", "Touching", "Undecided", "Within the clearance", "Not examined", "Apart"];
const numbersOfPair = 17;

export class ExactPairs {
  constructor(scene, arrays) {
    this.clearance = scene.clearance;
    this.seconds = scene.exactSeconds;
    this.count = arrays.exactStates.length;
    this.flags = arrays.exactStates;
    this.numbers = arrays.exactNumbers;
    this.lines = arrays.contactLines;
    this.ends = arrays.contactLineEnds;
    this.views = arrays.exactViews;
  }

  stateOf(entry) {
    return this.flags[entry] & 15;
  }

  of(entry) {
    const n = this.numbers.subarray(numbersOfPair * entry, numbersOfPair * (entry + 1));
    const hasBox = n[11] <= n[14];
    return {
      state: this.stateOf(entry), distance: n[0], depth: Number.isNaN(n[1]) ? null : n[1],
      first: n.subarray(2, 5), second: n.subarray(5, 8), normal: n.subarray(8, 11), box: hasBox ? n.subarray(11, 17) : null,
      openFirst: (this.flags[entry] & 16) !== 0, openSecond: (this.flags[entry] & 32) !== 0, isFirstInner: (this.flags[entry] & 64) !== 0,
    };
  }

  linesOf(entry) {
    return this.lines.subarray(entry === 0 ? 0 : 6 * this.ends[entry - 1], 6 * this.ends[entry]);
  }

  /** From where the contact is seen best, or null. */
  viewOf(entry) {
    const view = this.views.subarray(3 * entry, 3 * entry + 3);
    return view.some((part) => part !== 0) ? view : null;
  }

  /** Orders entries, the worst first, as isWorse() in ExactPair.cpp says; equal ones stay as they were found. */
  worstFirst(entries) {
    const depth = (e) => this.of(e).depth ?? 0;
    return entries.sort((a, b) => this.stateOf(a) - this.stateOf(b) || depth(b) - depth(a) || this.of(a).distance - this.of(b).distance || a - b);
  }
}

export const clashCount = (counts) => counts[state.duplicate] + counts[state.contained] + counts[state.clash];

/** The corners of where a contact is, as six numbers. */
export function contactCorners({ state: is, box, first, second }) {
  const all = [0, 1, 2].map((k) => Math.min(first[k], second[k])).concat([0, 1, 2].map((k) => Math.max(first[k], second[k])));
  if (!box) return all;
  if (is === state.touching) return Array.from(box);
  return all.map((value, k) => (k < 3 ? Math.min(value, box[k]) : Math.max(value, box[k])));
}

/** What a row of the list says behind the names. */
export function shortFinding(pair) {
  if (pair.state === state.notExamined) return "";
  if (pair.state >= state.undecided) return `${measure(pair.distance)} apart`;
  return pair.depth > 0 ? `${measure(pair.depth)} deep` : "";
}

export const headingOf = (pair) => headings[pair.state];

const openWords = (pair, first, second) => (pair.openFirst && pair.openSecond ? "the surfaces of both are not closed" : `the surface of ${pair.openFirst ? first : second} is not closed`);

/** Where to look, as `placeOf` in ExactPair.cpp says. */
export function placeOf(pair) {
  if (pair.state === state.contained) return [...(pair.isFirstInner ? pair.first : pair.second)];
  const corners = pair.depth > 0 || pair.state >= state.undecided ? [...pair.first, ...pair.second] : contactCorners(pair);
  return [0, 1, 2].map((k) => (corners[k] + corners[k + 3]) / 2);
}

/** A sentence for what numbers do not say, or nothing. `inner` is the smaller of the two. */
export function findingOf(pair, first, second) {
  const sentences = {
    [state.duplicate]: () => "The same shape in the same place: one of the two is too many.",
    [state.contained]: () => `${pair.isFirstInner ? first : second} lies wholly in ${pair.isFirstInner ? second : first}.`,
    [state.clash]: () => (pair.depth === null ? `How deep is not known: ${openWords(pair, first, second)}.` : ""),
    [state.undecided]: () => `Surfaces are apart. Whether one lies in the other is not known: ${openWords(pair, first, second)}.`,
  };
  return sentences[pair.state]?.() ?? "";
}

/** The numbers behind the count of clashes. */
export function kindsOfClashes(counts) {
  const parts = [];
  if (counts[state.duplicate] > 0) parts.push(counted(counts[state.duplicate], "duplicate"));
  if (counts[state.contained] > 0) parts.push(`${grouped(counts[state.contained])} contained`);
  return parts;
}
