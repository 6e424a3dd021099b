// SPDX-License-Identifier: MIT
// What tells up from down and far from near: a grid at the lowest point of the scene, and the three axes in a corner.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Vector3 } from "three";
import { byId } from "./dom.js";

const cells = 8; // across the longer side of the scene, or up to twice as many
const mostLines = 64; // each way

/** The largest of 1, 2 and 5 times a power of ten that is not above a length. */
function roundStep(length) {
  const unit = 10 ** Math.floor(Math.log10(length));
  return [5, 2, 1].find((times) => times * unit <= length) * unit;
}

/** Points of lines between two corners of a plane, at multiples of a step from `origin`, which is where the file's zero is. */
function gridPoints([low, high], step, origin) {
  const points = [];
  for (const [u, v] of [[0, 1], [1, 0]]) {
    const first = Math.ceil((low[u] + origin[u]) / step) * step - origin[u];
    const lines = Math.floor((high[u] - first) / step) + 1; // counted from here: far from zero numbers have gaps
    for (let i = 0; i < Math.min(lines, mostLines); ++i) {
      for (const end of [low[v], high[v]]) {
        const point = [];
        point[u] = first + i * step;
        point[v] = end;
        points.push(point);
      }
    }
  }
  return points;
}

export class Ground {
  constructor() {
    this.object = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.35, depthWrite: false }));
    this.object.frustumCulled = false;
    this.object.renderOrder = -1;
  }

  /** Puts the grid below a box, six numbers from `origin`; `up` is 1 to 3 for x to z, below 0 for the other way. */
  place(whole, origin, up) {
    const k = Math.abs(up) - 1;
    const across = [0, 1, 2].filter((axis) => axis !== k);
    const sides = across.map((axis) => whole[axis + 3] - whole[axis]);
    const longer = Math.max(...sides, whole[k + 3] - whole[k]);
    if (!(longer > 0 && longer < 1e30)) return;
    const margin = longer / 4;
    const plane = [across.map((axis) => whole[axis] - margin), across.map((axis) => whole[axis + 3] + margin)];
    const level = up > 0 ? whole[k] - 1e-3 * longer : whole[k + 3] + 1e-3 * longer; // a part that stands on it hides it
    const places = gridPoints(plane, roundStep(longer / cells), across.map((axis) => origin[axis])).flatMap((point) => {
      const place = [];
      place[k] = level;
      across.forEach((axis, i) => (place[axis] = point[i]));
      return place;
    });
    this.object.geometry.dispose();
    this.object.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
  }
}

/** Draws the axes as the camera sees them. */
export function setUpAxes(stage) {
  const [centre, length] = [32, 22]; // of 64
  const lines = [...byId("axes").querySelectorAll("line")];
  const names = [...byId("axes").querySelectorAll("text")];
  stage.addEventListener("drawn", () => {
    const turn = stage.camera.quaternion.clone().invert();
    lines.forEach((line, k) => {
      const way = new Vector3().setComponent(k, 1).applyQuaternion(turn);
      line.setAttribute("x2", centre + length * way.x);
      line.setAttribute("y2", centre - length * way.y);
      names[k].setAttribute("x", centre + 1.3 * length * way.x);
      names[k].setAttribute("y", centre - 1.3 * length * way.y);
    });
  });
}
