// SPDX-License-Identifier: MIT
// Fewer pixels, fewer of many boxes and no shade while the picture moves and drawing is slow, as without a graphics processor;
// all of them when it rests.

const slow = 70; // milliseconds from one frame of a movement to the next
const rest = 250; // milliseconds without a frame, or twice what one takes
const coarsest = 0.15;

export class Sharpness {
  /** Begins with a whole picture, or where that would take long with one of `scale`. */
  constructor(again, scale, isWhole) {
    this.again = again;
    this.scale = scale;
    this.cost = 0;
    this.isFinal = isWhole;
    this.isFirst = !isWhole;
    this.isMoving = false; // while the pointer holds the picture, it does not rest
    this.shadeIsSlow = false;
  }

  /** Whether the frame that next() was asked about has shade. */
  get isShaded() {
    return this.wasFinal || !this.shadeIsSlow;
  }

  /** How fine to draw the next frame, up to 1. */
  next() {
    clearTimeout(this.timer);
    this.wasFinal = this.isFinal;
    this.isFinal = false;
    if (this.wasFinal) return 1;
    this.plan();
    return this.scale;
  }

  plan() {
    if ((this.scale < 1 || this.shadeIsSlow) && !this.isMoving) this.timer = setTimeout(() => this.finish(), Math.max(rest, 2 * this.cost));
  }

  /** The pointer takes hold of the picture, or lets go. */
  hold(isMoving) {
    this.isMoving = isMoving;
    clearTimeout(this.timer);
    this.plan();
  }

  /** How long the last frame took until the browser was ready for another, and whether it had shade. */
  took(milliseconds, hadShade) {
    if (hadShade && milliseconds > slow / 2) this.shadeIsSlow = true;
    if (this.wasFinal) return; // that was the whole picture, and says little about a coarse one
    this.cost = milliseconds;
    if (this.isFirst && !this.isMoving) { // nothing has moved yet: there is no rest to wait for
      clearTimeout(this.timer);
      this.finish();
    }
    this.isFirst = false;
    const factor = milliseconds > slow ? Math.max(0.5, slow / milliseconds) : milliseconds < slow / 2 ? 1.15 : 1;
    this.scale = Math.min(1, Math.max(coarsest, this.scale * factor));
  }

  finish() {
    this.isFinal = true;
    this.again();
  }
}
