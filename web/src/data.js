// SPDX-License-Identifier: MIT
// The scene as the program wrote it into the page: words as JSON, numbers as little-endian arrays in base64.

import { ExactPairs } from "./exact.js";
import { MeshSequence } from "./sequence.js";

const kinds = { Float64: Float64Array, Float32: Float32Array, Uint32: Uint32Array, Uint8: Uint8Array };

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

function frameOf(scene, arrays, sequence, index) {
  const n = scene.models;
  const part = (list, ends) => list.subarray(index === 0 ? 0 : 2 * ends[index - 1], 2 * ends[index]);
  const parts = {
    flags: arrays.flags.subarray(n * index, n * (index + 1)),
    pairs: part(arrays.pairs, arrays.pairEnds),
    excluded: part(arrays.excluded, arrays.excludedEnds),
  };
  if (sequence) return sequence.frame(index, parts);
  return { index, boxes: arrays.boxes.subarray(6 * n * index, 6 * n * (index + 1)), ...parts };
}

/** The scene of two texts: JSON, and base64 of the arrays that it lists. */
export function parseScene(json, base64) {
  const scene = JSON.parse(json);
  const bytes = bytesOf(base64);
  const buffer = bytes.buffer;
  const arrays = {};
  for (const { name, type, offset, length } of scene.arrays) {
    arrays[name] = new kinds[type](buffer, bytes.byteOffset + offset, length);
  }
  const { types, groups, owners, elements, contactDistances, origin } = arrays;
  const sequence = arrays.corners.length > 0 ? new MeshSequence(arrays.corners, arrays.positions, scene.frames) : null;
  const frames = Array.from({ length: scene.frames }, (_, i) => frameOf(scene, arrays, sequence, i));
  const region = arrays.region.length === 6 ? arrays.region : null;
  const distance = arrays.distance[0];
  const nameOf = scene.names.length > 0 ? (i) => scene.names[i] : String;
  const exact = scene.isExact ? new ExactPairs(scene, arrays) : null;
  const { bodies } = arrays;
  const bodyOf = bodies.length > 0 ? (i) => bodies[i] : (i) => i;
  const bodyNameOf = bodies.length > 0 ? (i) => scene.bodyNames[bodies[i]] : nameOf;
  const { began, ended } = arrays; // how many pairs, in each frame
  return { ...scene, began, ended, exact, bodyOf, bodyNameOf, hasBodies: bodies.length > 0, types, groups, owners, elements, contactDistances, origin, region, distance, frames, nameOf, sequence, mesh: sequence?.mesh() ?? arrays };
}

/** The scene in a document, or null where the page is an empty template. */
export function readScene(document) {
  const json = document.getElementById("allpairs-scene");
  const arrays = document.getElementById("allpairs-arrays");
  if (!json || !arrays) return null;
  const scene = parseScene(json.textContent, arrays.textContent);
  arrays.remove(); // some megabytes of text that nobody needs any more
  return scene;
}
