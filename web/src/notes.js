// SPDX-License-Identifier: MIT
// What a reader notes about clashes: a status and a comment each. The browser keeps them under the GUID of the clash, which a
// later report of the same parts has too.

const prefix = "allpairs-note:";

export const statuses = ["Open", "In progress", "Accepted", "Closed"];

/** 128 random bits in the form of a UUID, version 4 (RFC 9562). */
function newGuid() {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  bytes[6] = (bytes[6] & 0x0f) | 0x40;
  bytes[8] = (bytes[8] & 0x3f) | 0x80;
  const digits = Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
  return [digits.slice(0, 8), digits.slice(8, 12), digits.slice(12, 16), digits.slice(16, 20), digits.slice(20)].join("-");
}

/** A note that was kept; what is no note is none. */
function parsed(text) {
  try {
    const note = JSON.parse(text);
    const isNote = statuses.includes(note.status) && [note.comment, note.guid, note.date, note.report].every((part) => typeof part === "string");
    return isNote ? note : null;
  } catch {
    return null;
  }
}

/** Tells "change", with the GUID of the clash or null for all, when a note is another, in this window or another one. */
export class Notes extends EventTarget {
  /** `ownStatus` gives the status that the topic of a clash has by itself. */
  constructor(report, ownStatus) {
    super();
    this.report = report;
    this.ownStatus = ownStatus;
    this.unkept = new Map(); // where the browser keeps nothing
    this.isKept = true;
    addEventListener("storage", (event) => {
      if (event.key === null || event.key.startsWith(prefix)) this.tell(event.key?.slice(prefix.length) ?? null);
    });
  }

  tell(guid) {
    const event = new Event("change");
    event.guid = guid;
    this.dispatchEvent(event);
  }

  /** The note on a clash, or null; where nobody chose a status, with the topic's own, which a later report may change. */
  of(guid) {
    const note = this.kept(guid);
    const isOwn = note?.isOwn ?? note?.status === statuses[0]; // notes from before had this one where nobody chose
    return note && { ...note, status: isOwn ? this.ownStatus(guid) : note.status };
  }

  statusOf(guid) {
    return this.of(guid)?.status ?? this.ownStatus(guid);
  }

  kept(guid) {
    if (this.unkept.has(guid)) return this.unkept.get(guid);
    try {
      return parsed(localStorage.getItem(prefix + guid));
    } catch {
      return null;
    }
  }

  /** Notes it; one that says nothing is taken away. */
  set(guid, { status, comment }) {
    const before = this.of(guid);
    const isOwn = status === this.ownStatus(guid);
    const note = isOwn && comment === "" ? null : { status, isOwn, comment, guid: before?.guid ?? newGuid(), date: new Date().toISOString().replace(/\.\d+/, ""), report: this.report };
    try {
      if (note) localStorage.setItem(prefix + guid, JSON.stringify(note));
      else localStorage.removeItem(prefix + guid);
      this.unkept.delete(guid);
    } catch {
      this.unkept.set(guid, note);
      this.isKept = false;
    }
    this.tell(guid);
  }

  /** Who writes comments. */
  get author() {
    try {
      return localStorage.getItem("allpairs-author") ?? "";
    } catch {
      return "";
    }
  }

  set author(name) {
    try {
      localStorage.setItem("allpairs-author", name);
    } catch {
      // it has to be said again the next time
    }
  }
}
