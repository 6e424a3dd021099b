// SPDX-License-Identifier: MIT
// Which model is under the pointer: a ray against all boxes, then against the triangles of those that it meets.

/** Where a ray enters and leaves a box, or null. */
function slab(origin, inverse, drawn, i) {
  let near = 0;
  let far = Infinity;
  for (let k = 0; k < 3; ++k) {
    const a = (drawn[6 * i + k] - origin[k]) * inverse[k];
    const b = (drawn[6 * i + 3 + k] - origin[k]) * inverse[k];
    near = Math.max(near, Math.min(a, b));
    far = Math.min(far, Math.max(a, b));
  }
  return near <= far ? near : null;
}

const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Möller and Trumbore's test: how far along the ray a triangle is met, or Infinity. */
function meet(origin, direction, a, b, c) {
  const u = sub(b, a);
  const v = sub(c, a);
  const p = cross(direction, v);
  const det = dot(u, p);
  if (Math.abs(det) < 1e-30) return Infinity;
  const t = sub(origin, a);
  const s = dot(t, p) / det;
  const q = cross(t, u);
  const r = dot(direction, q) / det;
  if (s < 0 || r < 0 || s + r > 1) return Infinity;
  const distance = dot(v, q) / det;
  return distance > 0 ? distance : Infinity;
}

function meetShape(mesh, model, { origin, direction, cut }) {
  const isCut = (t) => dot(cut, origin) + t * dot(cut, direction) > cut[3];
  const at = (i) => mesh.vertices.subarray(3 * i, 3 * i + 3);
  const begin = model === 0 ? 0 : mesh.triangleEnds[model - 1];
  let nearest = { distance: Infinity, corners: null };
  for (let i = begin; i < mesh.triangleEnds[model]; i += 3) {
    const corners = [at(mesh.triangles[i]), at(mesh.triangles[i + 1]), at(mesh.triangles[i + 2])];
    const distance = meet(origin, direction, ...corners);
    if (distance < nearest.distance && !isCut(distance)) nearest = { distance, corners };
  }
  return nearest;
}

const hasShape = (mesh, model) => mesh.triangleEnds.length > 0 && mesh.triangleEnds[model] > (model === 0 ? 0 : mesh.triangleEnds[model - 1]);

/** The model that a ray meets first, how far along the ray, and the corners of the triangle that it meets there or null; null
 * without one. A model with triangles is met only there, and where it is not cut away, unless `onlyBoxes`. Shapes are met where
 * their model is moved to. */
export function pick({ origin, direction, drawn, offsets, count, mesh, isShown, onlyBoxes, cut }) {
  const inverse = direction.map((x) => 1 / (x === 0 ? 1e-30 : x));
  let best = null;
  let nearest = Infinity;
  for (let i = 0; i < count; ++i) {
    if (drawn[6 * i] > drawn[6 * i + 3] || !isShown(i)) continue;
    const entry = slab(origin, inverse, drawn, i);
    if (entry === null || entry >= nearest) continue;
    const met = !onlyBoxes && hasShape(mesh, i) ? meetShape(mesh, i, { origin: sub(origin, offsets.of(i)), direction, cut }) : { distance: entry, corners: null };
    if (met.distance < nearest) [nearest, best] = [met.distance, { model: i, ...met }];
  }
  return best;
}
