// SPDX-License-Identifier: MIT
// The pairs of a frame: entries are numbered, those that were found first, then those that a rule excludes.

import { state } from "./exact.js";
import { isEmpty } from "./rules.js";

/** What a model or an entry is shown as. The numbers are places in the palette; see palette.js. */
export const kind = { free: 0, pair: 1, self: 2, excluded: 3, out: 4 };

/** Excluded pairs that a page has; of more it has none, as app/view/MakeViewScene.cpp says too. */
export const mostExcluded = 1_000_000;

export class PairTable {
  constructor(frame, { exact, bodyOf, hasBodies }) {
    this.frame = frame;
    this.exact = exact; // what shapes say of the pairs that were found, or null
    this.found = frame.pairs.length / 2;
    this.size = this.found + frame.excluded.length / 2;
    this.rows = hasBodies ? this.makeRows(bodyOf) : null;
  }

  /** The entries of the same two bodies, for each entry of them: the worst first, and none whose shapes are apart unless all are. */
  makeRows(bodyOf) {
    const rows = new Map();
    for (let entry = 0; entry < this.size; ++entry) {
      const [a, b] = [bodyOf(this.first(entry)), bodyOf(this.second(entry))];
      const key = `${Math.min(a, b)} ${Math.max(a, b)} ${entry < this.found}`;
      if (!rows.has(key)) rows.set(key, []);
      rows.get(key).push(entry);
    }
    const rowOf = new Array(this.size);
    for (const entries of rows.values()) {
      const isTested = this.exact !== null && entries[0] < this.found;
      if (isTested) this.exact.worstFirst(entries);
      else entries.sort((a, b) => this.volume(b) - this.volume(a) || a - b);
      const listed = this.isApart(entries[0]) ? entries : entries.filter((entry) => !this.isApart(entry));
      for (const entry of entries) rowOf[entry] = listed;
    }
    return rowOf;
  }

  /** The entries of the row that an entry is in; it stands for them if it is the first. */
  rowOf(entry) {
    return this.rows?.[entry] ?? [entry];
  }

  isRow(entry) {
    return this.rows === null || this.rows[entry][0] === entry;
  }

  /** How many rows there are in each state of shapes. */
  stateCounts() {
    const counts = new Array(Object.keys(state).length).fill(0);
    for (let entry = 0; entry < this.found; ++entry) {
      if (this.isRow(entry)) ++counts[this.exact.stateOf(entry)];
    }
    return counts;
  }

  first(entry) {
    return entry < this.found ? this.frame.pairs[2 * entry] : this.frame.excluded[2 * (entry - this.found)];
  }

  second(entry) {
    return entry < this.found ? this.frame.pairs[2 * entry + 1] : this.frame.excluded[2 * (entry - this.found) + 1];
  }

  kindOf(entry) {
    if (entry >= this.found) return kind.excluded;
    if (this.isApart(entry)) return kind.free;
    return this.first(entry) === this.second(entry) ? kind.self : kind.pair;
  }

  /** Whether only the boxes of a pair meet, and not its shapes. */
  isApart(entry) {
    return this.exact !== null && entry < this.found && this.exact.stateOf(entry) === state.apart;
  }

  /** How many rows there are of each kind. */
  counts() {
    const counts = { [kind.free]: 0, [kind.pair]: 0, [kind.self]: 0, [kind.excluded]: 0 };
    for (let entry = 0; entry < this.size; ++entry) {
      if (this.isRow(entry)) ++counts[this.kindOf(entry)];
    }
    return counts;
  }

  /** How far the boxes of an entry are apart, on the axis where that is most; not above 0 where they overlap. */
  gap(entry) {
    return Math.max(...sharedExtents(this.frame.boxes, this.first(entry), this.second(entry)).map((extent) => -extent));
  }

  /** Whether boxes do not overlap and are a pair all the same, as they lie within the distance. */
  isNear(entry) {
    if (this.exact !== null || entry >= this.found) return false;
    const { boxes } = this.frame;
    const [a, b] = [6 * this.first(entry), 6 * this.second(entry)];
    for (let k = 0; k < 3; ++k) {
      if (boxes[a + k] > boxes[b + 3 + k] || boxes[b + k] > boxes[a + 3 + k]) return true;
    }
    return false;
  }

  /** The volume that the two boxes share; of a self pair that of its box. */
  volume(entry) {
    return volumeOf(sharedExtents(this.frame.boxes, this.first(entry), this.second(entry)));
  }

  /** The entry of two models, in either order, or -1. */
  find(a, b) {
    for (let entry = 0; entry < this.size; ++entry) {
      const first = this.first(entry);
      const second = this.second(entry);
      if ((first === a && second === b) || (first === b && second === a)) return entry;
    }
    return -1;
  }

  /** The entries, found ones only, that have a model in them. */
  entriesOf(model) {
    const entries = [];
    for (let entry = 0; entry < this.found; ++entry) {
      if ((this.first(entry) === model || this.second(entry) === model) && !this.isApart(entry)) entries.push(entry);
    }
    return entries;
  }
}

/** How far two boxes reach into each other, per axis; negative where they are apart. Those that meet at infinity touch there. */
export function sharedExtents(boxes, a, b) {
  return [0, 1, 2].map((k) => {
    const low = Math.max(boxes[6 * a + k], boxes[6 * b + k]);
    const high = Math.min(boxes[6 * a + 3 + k], boxes[6 * b + 3 + k]);
    return low === high ? 0 : high - low; // and not infinity minus infinity
  });
}

/** The volume of what two boxes share, from its extents: none where one of these is, and not infinity times zero. */
export const volumeOf = (extents) => (extents.every((extent) => extent > 0) ? extents[0] * extents[1] * extents[2] : 0);

const outFlags = 16 | 32;

/** The kind of each model: of its pairs the strongest. */
export function modelKinds(table, count) {
  const { frame } = table;
  const kinds = new Uint8Array(count);
  for (let i = 0; i < count; ++i) {
    const flags = frame.flags[i];
    if (!(flags & 1) || flags & outFlags || isEmpty(frame.boxes, i)) kinds[i] = kind.out;
  }
  const raise = (model, to, below) => {
    if (below.includes(kinds[model])) kinds[model] = to;
  };
  for (let entry = table.size - 1; entry >= 0; --entry) {
    const is = table.kindOf(entry);
    const below = is === kind.pair ? [kind.free, kind.self, kind.excluded] : is === kind.self ? [kind.free, kind.excluded] : [kind.free];
    raise(table.first(entry), is, below);
    raise(table.second(entry), is, below);
  }
  return kinds;
}

/** How many partners each model has; itself counts as one. */
export function partnerCounts(table, count) {
  const counts = new Uint32Array(count);
  for (let entry = 0; entry < table.found; ++entry) {
    if (table.isApart(entry)) continue;
    ++counts[table.first(entry)];
    if (table.first(entry) !== table.second(entry)) ++counts[table.second(entry)];
  }
  return counts;
}

const keyOf = (pairs, i, count) => Math.max(pairs[2 * i], pairs[2 * i + 1]) * count + Math.min(pairs[2 * i], pairs[2 * i + 1]);

function sortedKeys(pairs, count) {
  const keys = Float64Array.from({ length: pairs.length / 2 }, (_, i) => keyOf(pairs, i, count));
  return keys.every((key, i) => i === 0 || keys[i - 1] <= key) ? keys : keys.sort(); // as sequences have them, they are
}

/** The pairs of one frame that another does not have, as [first, second] lists. */
export function pairsWithout(pairs, others, count) {
  const keys = sortedKeys(pairs, count);
  const known = sortedKeys(others, count);
  const result = [];
  for (let i = 0, k = 0; i < keys.length; ++i) {
    while (k < known.length && known[k] < keys[i]) ++k;
    if (known[k] !== keys[i]) result.push([Math.floor(keys[i] / count), keys[i] % count]);
  }
  return result;
}
