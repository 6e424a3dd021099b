// SPDX-License-Identifier: MIT
// Fewer pixels while the picture moves and drawing is slow, as without a graphics processor; all of them when it rests.

const slow = 60; // milliseconds between two frames of a movement
const rest = 180; // milliseconds without a frame
const coarsest = 0.35;

export class Sharpness {
  constructor(again) {
    this.again = again;
    this.scale = 1;
    this.last = -Infinity;
  }

  /** How many pixels of the picture there are to one of the page, for a frame at this time. */
  ratio(time, devicePixelRatio) {
    const full = Math.min(devicePixelRatio, 2);
    const since = time - this.last;
    this.last = time;
    clearTimeout(this.timer);
    if (this.isFinal) {
      this.isFinal = false;
      return full;
    }
    if (since < 1000) {
      if (since > slow) this.scale = Math.max(coarsest, this.scale * 0.8);
      else if (since < slow / 3) this.scale = Math.min(1, this.scale * 1.1);
    }
    if (this.scale < 1) this.timer = setTimeout(() => this.finish(), rest);
    return full * this.scale;
  }

  finish() {
    this.isFinal = true;
    this.again();
  }
}
