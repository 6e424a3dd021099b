// SPDX-License-Identifier: MIT
// Why two models are a pair, or are not: the same rules, in the same order, as src/view/Explain.cpp; a test compares them.

export const flag = { active: 1, simulated: 2, moving: 4, selfCollision: 8, outside: 16, noElements: 32, touchesItself: 64 };

/** Whether the six numbers at `i` of an array of boxes are an empty box. */
export function isEmpty(boxes, i) {
  const k = 6 * i;
  return boxes[k] > boxes[k + 3] || boxes[k + 1] > boxes[k + 4] || boxes[k + 2] > boxes[k + 5];
}

/** Whether two boxes are at most `distance` apart on every axis, the sum rounded as the C++ side rounds it. */
export function areNear(boxes, a, b, distance) {
  if (isEmpty(boxes, a) || isEmpty(boxes, b)) return false;
  for (let axis = 0; axis < 3; ++axis) {
    if (boxes[6 * a + axis] > boxes[6 * b + 3 + axis] + distance) return false;
    if (boxes[6 * b + axis] > boxes[6 * a + 3 + axis] + distance) return false;
  }
  return true;
}

/** The axis on which two boxes are furthest apart, and how far: negative where they overlap on every axis. */
export function widestGap(boxes, a, b) {
  let axis = -1;
  let gap = -Infinity;
  for (let k = 0; k < 3; ++k) {
    const here = Math.max(boxes[6 * a + k] - boxes[6 * b + 3 + k], boxes[6 * b + k] - boxes[6 * a + 3 + k]);
    if (here > gap) [axis, gap] = [k, here];
  }
  return { axis, gap };
}

/** The distance at which the boxes of two models count as near. */
export function distanceOf(scene, newer, older) {
  if (!scene.addsContactDistances) return scene.distance;
  return scene.distance + scene.contactDistances[newer] + scene.contactDistances[older];
}

function explainSelf(scene, frame, model) {
  const flags = frame.flags[model];
  if (!(flags & flag.simulated)) return { verdict: "not-simulated" };
  if (!(flags & flag.selfCollision)) return { verdict: "no-self" };
  if (flags & flag.touchesItself && areNear(frame.boxes, model, model, distanceOf(scene, model, model))) return { verdict: "pair" };
  return { verdict: isEmpty(frame.boxes, model) ? "apart" : "flat", axis: -1, gap: 0 };
}

function explainBoxes(scene, frame, newer, older) {
  if (areNear(frame.boxes, newer, older, distanceOf(scene, newer, older))) return { verdict: "pair" };
  if (isEmpty(frame.boxes, newer) || isEmpty(frame.boxes, older)) return { verdict: "apart", axis: -1, gap: 0 };
  return { verdict: "apart", ...widestGap(frame.boxes, newer, older) };
}

function explainFlags(scene, frame, newer, older) {
  const a = frame.flags[newer];
  const b = frame.flags[older];
  if (!((a | b) & flag.simulated)) return { verdict: "not-simulated" };
  if (scene.owners[newer] === scene.owners[older]) {
    return { verdict: a & b & flag.selfCollision ? "pair" : "same-owner" };
  }
  const others = scene.groupSets[scene.groups[older]];
  const group = scene.groupSets[scene.groups[newer]].find((g) => others.includes(g));
  return group === undefined ? { verdict: "pair" } : { verdict: "same-group", group };
}

/** What the rules say of model `newer` and `older`, which was added before it, or of a model with itself. */
export function explain(scene, frame, newer, older) {
  const a = frame.flags[newer];
  const b = frame.flags[older];
  if (!(a & b & flag.active)) return { verdict: "inactive" };
  if ((a | b) & flag.noElements) return { verdict: "no-elements" };
  if ((a | b) & flag.outside) return { verdict: "outside" };
  if (newer === older) return explainSelf(scene, frame, newer);
  const byFlags = explainFlags(scene, frame, newer, older);
  if (byFlags.verdict === "pair" && scene.sequence?.shareVertex(newer, older)) return { verdict: "shares-vertex" };
  return byFlags.verdict === "pair" ? explainBoxes(scene, frame, newer, older) : byFlags;
}

/** The same for two models in either order. */
export function explainAny(scene, frame, a, b) {
  return explain(scene, frame, Math.max(a, b), Math.min(a, b));
}
