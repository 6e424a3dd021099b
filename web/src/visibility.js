// SPDX-License-Identifier: MIT
// Which models the reader has hidden, and what to undo.

const mostSteps = 100; // that can be undone

export class Visibility {
  constructor(count) {
    this.count = count;
    this.hidden = new Set();
    this.past = [];
  }

  isShown(model) {
    return !this.hidden.has(model);
  }

  change(hidden) {
    this.past.push(this.hidden);
    if (this.past.length > mostSteps) this.past.shift();
    this.hidden = hidden;
  }

  hide(models) {
    if (models.some((model) => this.isShown(model))) this.change(new Set([...this.hidden, ...models]));
  }

  /** Hides all other models. */
  isolate(models) {
    const kept = new Set(models);
    if (kept.size > 0) this.change(new Set(Array.from({ length: this.count }, (_, i) => i).filter((i) => !kept.has(i))));
  }

  showAll() {
    if (this.hidden.size > 0) this.change(new Set());
  }

  undo() {
    this.hidden = this.past.pop() ?? this.hidden;
  }
}
