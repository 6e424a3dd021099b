// SPDX-License-Identifier: MIT
// The section plane: across an axis, what lies beyond it is not drawn.

import { byId } from "./dom.js";
import { coordinate } from "./format.js";

const off = [0, 0, 0, 1]; // no point is beyond it

/** The panel over the picture that moves the plane, and the button that switches it. */
export class Section {
  constructor(stage) {
    this.stage = stage;
    this.isOn = false;
    this.isFlipped = false;
    this.button = byId("section");
    this.button.hidden = stage.shapes.length === 0;
    this.axis = byId("section-axis");
    this.slider = byId("section-slider");
    this.button.addEventListener("click", () => {
      this.isOn = !this.isOn;
      this.update();
    });
    byId("section-flip").addEventListener("click", () => {
      this.isFlipped = !this.isFlipped;
      this.update();
    });
    this.axis.addEventListener("change", () => this.update());
    this.slider.addEventListener("input", () => this.update());
    this.update();
  }

  update() {
    const k = Number(this.axis.value);
    const { whole, data } = this.stage;
    const at = whole[k] + (this.slider.value / 1000) * (whole[k + 3] - whole[k]);
    const sign = this.isFlipped ? -1 : 1;
    const plane = off.slice();
    plane[k] = sign;
    plane[3] = sign * at;
    this.button.setAttribute("aria-pressed", this.isOn);
    byId("section-panel").hidden = !this.isOn;
    const place = `${"xyz"[k]} ${this.isFlipped ? "≥" : "≤"} ${coordinate(at + data.origin[k], 4)}`;
    byId("section-place").textContent = place;
    this.slider.setAttribute("aria-valuetext", place);
    this.stage.setCut(this.isOn ? plane : off);
  }
}
