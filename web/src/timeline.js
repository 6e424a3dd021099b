// SPDX-License-Identifier: MIT
// The line of time of a sequence of frames: how many pairs there are at each, play, step, and what began and ended.

import { byId, make } from "./dom.js";
import { counted, grouped } from "./format.js";

/** Of any number of counts, more than a call takes as arguments, too. */
const mostOf = (counts) => counts.reduce((most, count) => Math.max(most, count), 0);

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
    byId("speed").addEventListener("change", () => this.timer && this.restart());
    byId("step-back").addEventListener("click", () => this.step(-1));
    byId("step-on").addEventListener("click", () => this.step(1));
    this.drawCounts();
    this.drawMarks();
    app.addEventListener("frame", () => {
      this.update();
      if (this.timer && app.index !== this.due) this.restart(); // somebody chose another frame: it goes on from there
    });
    this.update();
  }

  drawCounts() {
    const counts = this.app.scene.frames.map((frame) => frame.pairs.length / 2);
    const most = mostOf(counts);
    const points = counts.map((count, i) => `${i},${(1 - count / Math.max(1, most)) * 0.92 + 0.04}`);
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

  /** Where pairs begin, above, and where they end, below: a stroke at each frame, as high as there are many. */
  drawMarks() {
    const { began, ended } = this.app.scene;
    const most = Math.max(1, mostOf(began.subarray(1)), mostOf(ended)); // in the first frame all begin
    const stroke = (count, frame, from, to) => (count === 0 ? "" : `M${frame},${from}L${frame},${from + (to - from) * (0.25 + (0.75 * Math.min(count, most)) / most)}`);
    const strokes = (counts, from, to) => Array.from(counts, (count, frame) => stroke(count, frame, from, to)).join("");
    const makePath = (className, data) => {
      const path = document.createElementNS(svg, "path");
      path.setAttribute("class", className);
      path.setAttribute("d", data);
      return path;
    };
    this.mark.before(makePath("began", strokes(began, 0, 0.3)), makePath("ended", strokes(ended, 1, 0.7)));
  }

  update() {
    const { app } = this;
    this.slider.value = app.index;
    this.slider.setAttribute("aria-valuetext", `frame ${app.index} of 0 to ${this.count - 1}, ${counted(app.table.found, "pair")}`);
    this.mark.setAttribute("x1", app.index);
    this.mark.setAttribute("x2", app.index);
    byId("time-frame").textContent = `Frame ${grouped(app.index)} of 0 to ${grouped(this.count - 1)}`;
    byId("time-pairs").textContent = counted(app.table.found, "pair");
    byId("time-began").replaceChildren(make("b", "", `+${grouped(app.scene.began[app.index])}`), " began");
    byId("time-ended").replaceChildren(make("b", "", `−${grouped(app.scene.ended[app.index])}`), " ended");
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
    this.speed = Number(byId("speed").value);
    this.begin = { index: this.app.index, time: performance.now() };
    this.due = this.app.index;
    this.timer = setTimeout(() => this.goOn(), 1000 / this.speed);
  }

  /** Shows the frame that is due: after one that took long, some are left out, so that time goes on as it is chosen. */
  goOn() {
    const steps = Math.max(1, Math.floor(((performance.now() - this.begin.time) * this.speed) / 1000));
    this.due = (this.begin.index + steps) % this.count;
    this.go(this.due);
    const next = this.begin.time + ((steps + 1) * 1000) / this.speed;
    this.timer = setTimeout(() => this.goOn(), Math.max(0, next - performance.now()));
  }

  restart() {
    this.pause();
    this.play();
  }

  pause() {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.playButton.textContent = "▶";
    this.playButton.setAttribute("aria-label", "Play");
  }
}
