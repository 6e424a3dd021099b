// SPDX-License-Identifier: MIT
// A list of any length: only the rows in sight are in the document.

const tallest = 8_000_000; // pixels; browsers give up on elements somewhat above that
let lists = 0;

export class VirtualList {
  /** `fill(row, index)` puts the content of a row; `choose(index)` is called when one is clicked or Enter is pressed. */
  constructor(element, { fill, choose, label }) {
    this.element = element;
    this.fill = fill;
    this.choose = choose;
    this.length = 0;
    this.current = -1;
    this.id = `list${++lists}`;
    this.space = document.createElement("div");
    this.space.className = "space";
    element.append(this.space);
    element.classList.add("list");
    element.tabIndex = 0;
    element.setAttribute("role", "listbox");
    element.setAttribute("aria-label", label);
    this.rows = new Map();
    element.addEventListener("scroll", () => this.show(), { passive: true });
    element.addEventListener("keydown", (event) => this.onKey(event));
    element.addEventListener("click", (event) => this.onClick(event));
    new ResizeObserver(() => this.resize()).observe(element);
  }

  setLength(length) {
    this.length = length;
    if (this.current >= length) this.current = -1;
    this.resize();
  }

  /** The row that is chosen, or -1; it is brought into sight. */
  setCurrent(index, inSight = true) {
    this.current = index;
    if (index >= 0 && inSight) this.bringIntoSight(index);
    this.refresh();
  }

  refresh() {
    for (const row of this.rows.values()) row.remove();
    this.rows.clear();
    this.show();
  }

  resize() {
    const probe = document.createElement("div");
    probe.className = "row";
    this.space.append(probe);
    this.rowHeight = Math.max(probe.getBoundingClientRect().height, 1);
    probe.remove();
    this.height = Math.min(this.length * this.rowHeight, tallest);
    this.space.style.height = `${this.height}px`;
    this.refresh();
  }

  /** The index, with a fraction, of the row at the top. Where the list is too tall, scrolling is scaled. */
  top() {
    const sight = this.element.clientHeight;
    const scrolled = this.height > sight ? this.element.scrollTop / (this.height - sight) : 0;
    return scrolled * Math.max(0, this.length - sight / this.rowHeight);
  }

  bringIntoSight(index) {
    const sight = this.element.clientHeight;
    const fit = Math.floor(sight / this.rowHeight);
    const top = this.top();
    if (index >= Math.ceil(top) && index < Math.floor(top) + fit) return;
    const wanted = Math.max(0, index - Math.floor(fit / 2));
    const range = Math.max(1e-9, this.length - sight / this.rowHeight);
    this.element.scrollTop = Math.min(1, wanted / range) * Math.max(0, this.height - sight);
  }

  show() {
    const top = this.top();
    const begin = Math.max(0, Math.floor(top) - 2);
    const end = Math.min(this.length, Math.ceil(top + this.element.clientHeight / this.rowHeight) + 2);
    for (const [index, row] of this.rows) {
      if (index >= begin && index < end) continue;
      row.remove();
      this.rows.delete(index);
    }
    for (let index = begin; index < end; ++index) this.place(index, this.element.scrollTop + (index - top) * this.rowHeight);
    const active = this.rows.get(this.current);
    if (active) this.element.setAttribute("aria-activedescendant", active.id);
    else this.element.removeAttribute("aria-activedescendant");
  }

  place(index, y) {
    let row = this.rows.get(index);
    if (!row) {
      row = document.createElement("div");
      row.className = "row";
      row.id = `${this.id}-${index}`;
      row.dataset.index = index;
      row.setAttribute("role", "option");
      row.setAttribute("aria-setsize", this.length);
      row.setAttribute("aria-posinset", index + 1);
      row.setAttribute("aria-selected", index === this.current);
      this.fill(row, index);
      this.rows.set(index, row);
      this.space.append(row);
    }
    row.style.transform = `translateY(${y}px)`;
  }

  onClick(event) {
    const row = event.target.closest(".row");
    if (row) this.choose(Number(row.dataset.index));
  }

  onKey(event) {
    const page = Math.max(1, Math.floor(this.element.clientHeight / this.rowHeight) - 1);
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
    if (event.ctrlKey || event.metaKey || event.altKey || this.length === 0) return;
    if (event.key in steps) {
      const next = this.current < 0 ? 0 : Math.min(this.length - 1, Math.max(0, this.current + steps[event.key]));
      this.setCurrent(next);
      this.choose(next);
    } else if (event.key === "Enter" && this.current >= 0) {
      this.choose(this.current);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }
}
