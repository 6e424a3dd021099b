// SPDX-License-Identifier: MIT
// What of a box can be drawn: coordinates from the middle of the scene, infinite sides cut, empty boxes marked.

const nowhere = () => [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];

function wholeOfVertices({ positions }, origin) {
  const whole = nowhere();
  for (let i = 0; i < positions.length; ++i) {
    const value = positions[i] - origin[i % 3];
    whole[i % 3] = Math.min(whole[i % 3], value);
    whole[3 + (i % 3)] = Math.max(whole[3 + (i % 3)], value);
  }
  return whole;
}

/** The smallest box around all finite boxes of all frames, from the scene's origin. */
export function wholeOf(scene) {
  if (scene.sequence) return wholeOfVertices(scene.sequence, scene.origin);
  const whole = nowhere();
  for (const { boxes } of scene.frames) {
    for (let i = 0; i < scene.models; ++i) {
      const box = boxes.subarray(6 * i, 6 * i + 6);
      if (!box.every(Number.isFinite) || box[0] > box[3] || box[1] > box[4] || box[2] > box[5]) continue;
      for (let k = 0; k < 3; ++k) {
        whole[k] = Math.min(whole[k], box[k] - scene.origin[k]);
        whole[k + 3] = Math.max(whole[k + 3], box[k + 3] - scene.origin[k]);
      }
    }
  }
  return whole[0] <= whole[3] ? whole : [-1, -1, -1, 1, 1, 1];
}

/** Boxes relative to the origin, in float32; an infinite side ends a little outside of the scene; empty is min > max. */
export function drawable(boxes, origin, whole) {
  const result = new Float32Array(boxes.length);
  const reach = [0, 1, 2].map((k) => 0.25 * (whole[k + 3] - whole[k]) + 1e-3 * Math.max(...whole.map(Math.abs)));
  for (let i = 0; i < boxes.length; i += 6) {
    const isEmpty = boxes[i] > boxes[i + 3] || boxes[i + 1] > boxes[i + 4] || boxes[i + 2] > boxes[i + 5];
    for (let k = 0; k < 3; ++k) {
      result[i + k] = isEmpty ? 1 : Math.max(boxes[i + k] - origin[k], whole[k] - reach[k]);
      result[i + 3 + k] = isEmpty ? -1 : Math.min(boxes[i + 3 + k] - origin[k], whole[k + 3] + reach[k]);
    }
  }
  return result;
}

/** Boxes whose bodies are moved away from the middle of the whole, by `factor` times how far from it their own middles are;
 * `offsets` takes how far each model is moved. */
export function spreadBoxes({ boxes, bodyOf, whole, factor, offsets }) {
  const bodies = new Map();
  for (let i = 0; 6 * i < boxes.length; ++i) {
    if (boxes[6 * i] > boxes[6 * i + 3]) continue;
    const body = bodies.get(bodyOf(i)) ?? nowhere();
    for (let k = 0; k < 3; ++k) {
      body[k] = Math.min(body[k], boxes[6 * i + k]);
      body[k + 3] = Math.max(body[k + 3], boxes[6 * i + k + 3]);
    }
    bodies.set(bodyOf(i), body);
  }
  const result = boxes.slice();
  for (let i = 0; 6 * i < boxes.length; ++i) {
    if (boxes[6 * i] > boxes[6 * i + 3]) continue;
    const body = bodies.get(bodyOf(i));
    for (let k = 0; k < 3; ++k) {
      const way = (factor * (body[k] + body[k + 3] - whole[k] - whole[k + 3])) / 2;
      offsets.of(i)[k] = way;
      result[6 * i + k] += way;
      result[6 * i + k + 3] += way;
    }
  }
  return result;
}

/** The whole, with what is finite of the region. */
export function wideEnough(scene, whole) {
  return whole.map((value, k) => {
    const side = scene.region[k] - scene.origin[k % 3];
    if (!Number.isFinite(side)) return value;
    return k < 3 ? Math.min(value, side) : Math.max(value, side);
  });
}
