// SPDX-License-Identifier: MIT
// Lines and points that are seen from afar, as triangles, since browsers draw lines one pixel wide.

import { Vector3 } from "three";

const sides = 5;

/** A rod between two points, as triangles behind those that are there. */
export function addRod(to, from, end, radius) {
  const way = end.clone().sub(from);
  const length = way.length();
  if (length > 0) way.divideScalar(length);
  else way.set(0, 0, 1);
  const u = new Vector3(1, 0, 0).cross(way);
  if (u.lengthSq() < 0.1) u.set(0, 1, 0).cross(way);
  u.normalize();
  const v = new Vector3().crossVectors(way, u);
  const ring = (centre, past) => Array.from({ length: sides }, (_, i) => {
    const angle = (2 * Math.PI * i) / sides;
    return centre.clone().addScaledVector(u, radius * Math.cos(angle)).addScaledVector(v, radius * Math.sin(angle)).addScaledVector(way, past);
  });
  const [a, b] = [ring(from, -radius / 2), ring(end, radius / 2)];
  for (let i = 0; i < sides; ++i) {
    const k = (i + 1) % sides;
    for (const corner of [a[i], a[k], b[k], a[i], b[k], b[i]]) to.push(corner.x, corner.y, corner.z);
    if (i > 1) for (const corner of [a[0], a[i], a[i - 1], b[0], b[i - 1], b[i]]) to.push(corner.x, corner.y, corner.z);
  }
}

/** A ball, coarsely: eight triangles. */
export function addBall(to, centre, radius) {
  const tip = (axis, sign) => centre.clone().setComponent(axis, centre.getComponent(axis) + sign * radius);
  for (let corner = 0; corner < 8; ++corner) {
    for (let axis = 0; axis < 3; ++axis) {
      const p = tip(axis, corner >> axis & 1 ? 1 : -1);
      to.push(p.x, p.y, p.z);
    }
  }
}
