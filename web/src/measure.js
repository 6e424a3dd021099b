// SPDX-License-Identifier: MIT
// The distance between two points that the reader clicks: corners, where one is near the pointer.

import { BufferAttribute, BufferGeometry, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { byId } from "./dom.js";
import { measure } from "./format.js";
import { tone } from "./palette.js";
import { addBall, addRod } from "./rods.js";

const snapReach = 10; // pixels
const thickness = 0.0025; // of the distance to the camera

/** The corners of what was hit: where they are drawn, and where they are when nothing is moved apart. Those of a box are exact, as
 * drawn they are in float32. */
function cornersOf({ corners, model }, app, stage) {
  const offset = new Vector3(...stage.offsets.of(model));
  if (corners) return corners.map((corner) => ({ drawn: new Vector3(...corner).add(offset), inPlace: new Vector3(...corner) }));
  const box = app.frame.boxes.subarray(6 * model, 6 * model + 6).map((value, k) => value - app.scene.origin[k % 3]);
  const corner = (sides, i) => new Vector3(...[0, 1, 2].map((k) => sides[k + (i >> k & 1 ? 3 : 0)]));
  return Array.from({ length: 8 }, (_, i) => ({ drawn: corner(stage.boxOf(model), i), inPlace: corner(box, i) }));
}

/** The corner of what was hit that is drawn next to a place of the window, or else the point itself. */
function snapped(hit, app, stage, x, y) {
  const awayOf = ({ drawn }) => Math.hypot(stage.pixelOf(drawn)[0] - x, stage.pixelOf(drawn)[1] - y);
  const [nearest] = cornersOf(hit, app, stage).sort((a, b) => awayOf(a) - awayOf(b));
  return awayOf(nearest) <= snapReach ? nearest : { drawn: hit.point, inPlace: hit.point.clone().sub(new Vector3(...stage.offsets.of(hit.model))) };
}

export class Measure {
  constructor(app, stage) {
    this.app = app;
    this.stage = stage;
    this.points = [];
    this.button = byId("measure");
    this.button.addEventListener("click", () => this.set(!this.isOn));
    this.mark = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ depthTest: false, transparent: true }));
    stage.addMark(this.mark, tone.began);
    stage.addEventListener("spread", () => this.clear()); // points would not be where they were
    stage.addEventListener("draws", () => this.points.length > 0 && this.draw()); // as large from everywhere
    this.set(false);
  }

  set(isOn) {
    this.isOn = isOn;
    this.button.setAttribute("aria-pressed", isOn);
    this.stage.canvas.classList.toggle("measuring", isOn);
    byId("measure-panel").hidden = !isOn;
    this.clear();
  }

  clear() {
    this.points = [];
    this.update();
  }

  /** Takes the point at a place of the window: the first, or the second; a third starts a new measurement. */
  add(x, y, onlyBoxes) {
    const { app, stage } = this;
    const hit = app.hitAt(x, y, onlyBoxes);
    if (!hit || (!hit.corners && !app.isFinite(hit.model))) return; // sides at infinity are drawn somewhere
    if (this.points.length === 2) this.points = [];
    this.points.push(snapped(hit, app, stage, x, y));
    this.update();
  }

  update() {
    this.draw();
    this.stage.invalidate();
    byId("measure-result").textContent = this.text();
  }

  draw() {
    const { stage } = this;
    const corners = [];
    const radius = (point) => thickness * point.distanceTo(stage.camera.position);
    const drawn = this.points.map((point) => point.drawn);
    for (const point of drawn) addBall(corners, point, 3.5 * radius(point));
    if (drawn.length === 2) addRod(corners, ...drawn, Math.min(...drawn.map(radius)) / 2);
    this.mark.geometry.dispose();
    this.mark.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(corners), 3));
    this.mark.visible = corners.length > 0;
  }

  text() {
    if (this.points.length < 2) return this.points.length === 0 ? "click the first point" : "click the second point";
    const [a, b] = this.points.map((point) => point.inPlace);
    const way = b.clone().sub(a);
    const parts = ["x", "y", "z"].map((axis) => `${axis} ${measure(Math.abs(way[axis]), 4)}`);
    return `${measure(way.length(), 5)} (${parts.join(", ")})`;
  }
}
