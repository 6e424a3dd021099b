// SPDX-License-Identifier: MIT
// Bodies apart from each other, to see each of them whole: the button, and the slider that says how far.

import { byId } from "./dom.js";

export class Explosion {
  constructor(app) {
    this.app = app;
    this.isOn = false;
    this.button = byId("explode");
    this.slider = byId("explode-slider");
    this.button.addEventListener("click", () => {
      this.isOn = !this.isOn;
      this.update();
      app.lookAtAll();
    });
    this.slider.addEventListener("input", () => this.update());
  }

  update() {
    this.button.setAttribute("aria-pressed", this.isOn);
    byId("explode-panel").hidden = !this.isOn;
    this.slider.setAttribute("aria-valuetext", `${this.slider.value} % of the way from the middle`);
    this.app.explode(this.isOn ? this.slider.value / 100 : 0);
  }
}
