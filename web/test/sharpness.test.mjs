// SPDX-License-Identifier: MIT
// How fine pictures are drawn one after the other, as the page asks for it.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Sharpness } from "../src/sharpness.js";

/** What was asked for, a scale or "again", while pictures take so many milliseconds; whether it is held at the first. */
function story(isWhole, milliseconds, isHeld) {
  const told = [];
  const sharpness = new Sharpness(() => told.push("again"), 0.5, isWhole);
  for (let picture = 0; picture < 2; ++picture) {
    told.push(sharpness.next());
    if (isHeld) sharpness.hold(true);
    sharpness.took(milliseconds, false);
  }
  clearTimeout(sharpness.timer);
  return told;
}

test("a coarse first picture is followed by the whole one at once, unless the reader moves it", () => {
  assert.deepEqual(story(false, 400, false), [0.5, "again", 1]);
  assert.deepEqual(story(false, 400, true), [0.5, 0.25]);
  assert.deepEqual(story(true, 400, false), [1, 0.5]);
});

test("what moves is drawn coarser where that is slow, and whole when it rests", (context) => {
  const rests = []; // how long it waits for a rest, and what it does then
  context.mock.method(globalThis, "setTimeout", (work, milliseconds) => rests.push([milliseconds, work]));
  const told = [];
  const sharpness = new Sharpness(() => told.push("again"), 1, true);
  const draw = (milliseconds) => {
    told.push(Number(sharpness.next().toFixed(3)));
    sharpness.took(milliseconds, false);
  };
  for (const milliseconds of [200, 140, 140, 30]) draw(milliseconds);
  assert.deepEqual(rests.map(([milliseconds]) => milliseconds), [280, 280]);
  rests.at(-1)[1]();
  draw(200);
  assert.deepEqual(told, [1, 1, 0.5, 0.25, "again", 1]);
});
