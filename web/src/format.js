// SPDX-License-Identifier: MIT
// Numbers and reasons as words.

const grouping = new Intl.NumberFormat("en-US");

/** 1234567 as 1,234,567. */
export const grouped = (number) => grouping.format(number);

/** "1 pair", "3 pairs", "2 boxes". */
export const counted = (number, one, more = `${one}s`) => `${grouped(number)} ${number === 1 ? one : more}`;

/** A length or volume with as many digits as anybody reads, and all before the point: as shortNumber() in Clash.cpp. */
export function measure(value, digits = 5, decimals = 0) {
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const whole = value === 0 ? 1 : Math.floor(Math.log10(Math.abs(value))) + 1;
  const text = String(Number(value.toPrecision(Math.min(15, Math.max(digits, whole + decimals)))));
  return text.replace("-", "−");
}

/** A coordinate, with as many digits as it takes to tell hundredths apart: as coordinatesOf() in Clash.cpp. */
export const coordinate = (value, digits = 5) => measure(value, digits, 2);

export function seconds(value) {
  if (value < 1e-3) return `${measure(Number((value * 1e6).toPrecision(3)))} µs`;
  if (value < 1) return `${measure(Number((value * 1e3).toPrecision(3)))} ms`;
  return `${measure(Number(value.toPrecision(3)))} s`;
}

export function percent(part) {
  const value = 100 * part;
  return `${value.toFixed(value > 99.9 && value < 100 ? 3 : 1)} %`;
}

const axisNames = ["x", "y", "z"];

const sentences = {
  pair: () => "a pair",
  inactive: () => "one of the two is inactive",
  "no-elements": () => "one of the two has no elements",
  outside: () => "outside the region",
  "not-simulated": () => "neither is simulated",
  "same-owner": () => "parts of one body",
  "same-group": (reason) => `both in group ${reason.group}`,
  "shares-vertex": () => "they share a vertex",
  apart: (reason) => (reason.axis < 0 ? "a box is empty" : `apart by ${measure(reason.gap)} on ${axisNames[reason.axis]}`),
  "no-self": () => "may not collide with itself",
  flat: () => "too flat to touch itself",
};

/** Why two models are a pair or none, in words. */
export const reasonText = (reason) => sentences[reason.verdict](reason);

const sentencesOfOne = { inactive: "inactive", "no-elements": "no elements", "not-simulated": "not simulated", apart: "its box is empty" };

/** Why a model is no pair with itself. */
export const selfReasonText = (reason) => sentencesOfOne[reason.verdict] ?? reasonText(reason);

/** How many digits tell the two ends of an extent apart, however far from zero it is. */
function digitsFor(low, high) {
  if (!Number.isFinite(high - low) || low === high) return 7;
  const wanted = Math.ceil(Math.log10(Math.max(Math.abs(low), Math.abs(high)) / Math.abs(high - low))) + 4;
  return Math.min(15, Math.max(5, wanted));
}

/** A box as two corners. */
export function cornersOf(boxes, i) {
  const box = boxes.subarray(6 * i, 6 * i + 6);
  const numbers = Array.from(box, (value, k) => measure(value, digitsFor(box[k % 3], box[3 + (k % 3)])));
  return [numbers.slice(0, 3).join(", "), numbers.slice(3).join(", ")];
}
