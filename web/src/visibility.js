// SPDX-License-Identifier: MIT
// Which models the reader has hidden, and what to undo.

const mostSteps = 20; // that can be undone

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
    const isSo = this.hidden.size === this.count - kept.size && models.every((model) => this.isShown(model));
    if (kept.size > 0 && !isSo) this.change(new Set(Array.from({ length: this.count }, (_, i) => i).filter((i) => !kept.has(i))));
  }

  /** Shows models that are chosen. Returns whether one was hidden. */
  reveal(models) {
    if (models.every((model) => this.isShown(model))) return false;
    this.change(new Set([...this.hidden].filter((model) => !models.includes(model))));
    return true;
  }

  showAll() {
    if (this.hidden.size > 0) this.change(new Set());
  }

  undo() {
    this.hidden = this.past.pop() ?? this.hidden;
  }
}
