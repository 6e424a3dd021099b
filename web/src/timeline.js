// SPDX-License-Identifier: MIT
// The line of time of a sequence of frames: how many pairs there are at each, play, step, and what began and ended.

import { byId, make } from "./dom.js";
import { counted, grouped } from "./format.js";

const svg = "http://www.w3.org/2000/svg";

export class Timeline {
  constructor(app) {
    this.app = app;
    this.count = app.scene.frames.length;
    this.element = byId("timeline");
    this.element.hidden = this.count < 2;
    if (this.count < 2) return;
    this.slider = byId("time-slider");
    this.slider.max = this.count - 1;
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    this.playButton = byId("play");
    this.playButton.addEventListener("click", () => this.toggle());
    byId("step-back").addEventListener("click", () => this.step(-1));
    byId("step-on").addEventListener("click", () => this.step(1));
    this.drawCounts();
    app.addEventListener("frame", () => this.update());
    this.update();
  }

  drawCounts() {
    const counts = this.app.scene.frames.map((frame) => frame.pairs.length / 2);
    const most = Math.max(1, ...counts);
    const points = counts.map((count, i) => `${i},${(1 - count / most) * 0.92 + 0.04}`);
    const chart = byId("time-chart");
    chart.setAttribute("viewBox", `0 0 ${this.count - 1} 1`);
    const area = document.createElementNS(svg, "polygon");
    area.setAttribute("points", `0,1 ${points.join(" ")} ${this.count - 1},1`);
    this.mark = document.createElementNS(svg, "line");
    this.mark.setAttribute("y1", 0);
    this.mark.setAttribute("y2", 1);
    chart.replaceChildren(area, this.mark);
    byId("time-most").textContent = `at most ${counted(most, "pair")}`;
  }

  update() {
    const { app } = this;
    this.slider.value = app.index;
    this.slider.setAttribute("aria-valuetext", `frame ${app.index + 1} of ${this.count}, ${counted(app.table.found, "pair")}`);
    this.mark.setAttribute("x1", app.index);
    this.mark.setAttribute("x2", app.index);
    byId("time-frame").textContent = `Frame ${grouped(app.index + 1)} of ${grouped(this.count)}`;
    byId("time-pairs").textContent = counted(app.table.found, "pair");
    byId("time-began").replaceChildren(make("b", "", `+${grouped(app.changes.began.length)}`), " began");
    byId("time-ended").replaceChildren(make("b", "", `−${grouped(app.changes.ended.length)}`), " ended");
  }

  go(index) {
    if (index !== this.app.index) this.app.setFrame(index, { flash: true });
  }

  step(by) {
    if (this.count < 2) return;
    this.pause();
    this.go(Math.min(this.count - 1, Math.max(0, this.app.index + by)));
  }

  toggle() {
    if (this.count < 2) return;
    if (this.timer) this.pause();
    else this.play();
  }

  play() {
    this.playButton.textContent = "❚❚";
    this.playButton.setAttribute("aria-label", "Pause");
    const next = () => {
      this.go((this.app.index + 1) % this.count);
      this.timer = setTimeout(next, 1000 / Number(byId("speed").value));
    };
    this.timer = setTimeout(next, 0);
  }

  pause() {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.playButton.textContent = "▶";
    this.playButton.setAttribute("aria-label", "Play");
  }
}
