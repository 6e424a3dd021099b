// SPDX-License-Identifier: MIT
// Where surfaces meet: lines as thin rods, since browsers draw lines one pixel wide, and the depth or the gap of a pair as a rod
// with two ends. Those of a pair that is chosen are in front of everything; of others, what is hidden is faint.

import { BufferAttribute, BufferGeometry, Color, Mesh, MeshBasicMaterial, Plane, Vector3 } from "three";
import { contactCorners, state } from "./exact.js";
import { addBall, addRod } from "./rods.js";

const mostLines = 30_000; // in all: of more, some are left out while no pair is chosen
/** How opaque the lines of so many contacts are where shapes hide them: of many, several lie on each other. */
const hiddenOpacity = (count) => Math.min(0.3, Math.max(0.08, 5 / count));

export class Contacts {
  /** `whole` is the size of the scene. */
  constructor(scene, whole) {
    this.scene = scene;
    this.whole = whole || 1;
    // First the halo of the pair that is chosen, so that its lines stand out from any colour, else the lines that may be hidden.
    this.objects = [0, 1].map(() => new Mesh(new BufferGeometry(), new MeshBasicMaterial({ depthTest: false, side: 2, transparent: true, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -8 })));
    this.shown = "";
  }

  /** Leaves out what lies beyond a plane, given by its normal and how far along that it is. */
  setCut([x, y, z, at]) {
    const plane = new Plane(new Vector3(-x, -y, -z), at);
    for (const { material } of this.objects) material.clippingPlanes = [plane];
  }

  paint(colour, background) {
    this.colours = { halo: new Color(background), line: new Color(colour) };
    this.paintFirst();
    this.objects[1].material.color = this.colours.line;
  }

  paintFirst() {
    const [{ material }] = this.objects;
    material.color = this.colours[this.isChosen ? "halo" : "line"];
    material.opacity = this.isChosen ? 0.65 : hiddenOpacity(this.count);
  }

  show(entries, isChosen) {
    const key = `${isChosen} ${entries.join()}`;
    if (this.shown === key) return;
    this.shown = key;
    this.isChosen = isChosen;
    this.count = entries.length;
    const lines = this.geometryOf(entries, 1);
    this.objects.forEach((object, pass) => {
      object.geometry.dispose();
      object.geometry = isChosen && pass === 0 ? this.geometryOf(entries, 2.2) : lines;
      object.visible = lines.getAttribute("position").count > 0;
    });
    this.objects[1].material.depthTest = !isChosen;
    if (this.colours) this.paintFirst();
  }

  geometryOf(entries, thickness) {
    const points = this.pointsOf(entries, this.isChosen, thickness);
    return new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  }

  pointsOf(entries, isChosen, thickness) {
    const points = [];
    const lines = entries.reduce((count, entry) => count + this.scene.exact.linesOf(entry).length / 6, 0);
    const step = Math.max(1, Math.ceil(lines / mostLines));
    for (const entry of entries) this.addEntry(points, entry, isChosen, thickness, step);
    return points;
  }

  addEntry(points, entry, isChosen, thickness, step) {
    const { exact } = this.scene;
    const pair = exact.of(entry);
    if (pair.state === state.notExamined) return;
    const place = (from) => new Vector3(...[0, 1, 2].map((k) => from[k] - this.scene.origin[k]));
    const corners = contactCorners(pair);
    const size = Math.hypot(...[0, 1, 2].map((k) => corners[k + 3] - corners[k]), pair.depth ?? 0, pair.distance);
    const radius = thickness * (isChosen ? 0.006 * (size || this.whole) : 0.0014 * this.whole);
    const lines = exact.linesOf(entry);
    for (let i = 0; i < lines.length; i += 6 * step) addRod(points, new Vector3().fromArray(lines, i), new Vector3().fromArray(lines, i + 3), radius);
    if (!isChosen || (!(pair.depth > 0) && pair.state <= state.touching)) return;
    const [first, second] = [place(pair.first), place(pair.second)];
    addRod(points, first, second, radius);
    for (const end of [first, second]) addBall(points, end, 3 * radius);
  }
}
