// SPDX-License-Identifier: MIT
// The page of a report: rows are sorted and searched, clashes get a status and a comment, and both go out with the BCF. Without
// this script the page is as it is written.

import { bcfWithNotes } from "./bcf.js";
import { Notes, statuses } from "./notes.js";

const all = (selector, root = document) => [...root.querySelectorAll(selector)];

function make(tag, { label, ...properties } = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  if (label) element.setAttribute("aria-label", label);
  element.append(...children);
  return element;
}

const cards = new Map(all("figure[data-guid]").map((card) => [card.dataset.guid, card]));
const notes = new Notes(document.querySelector("h1").textContent, (guid) => cards.get(guid)?.dataset.status ?? statuses[0]);
const captions = new Map([...cards].map(([guid, card]) => [guid, card.textContent.toLowerCase()])); // before fields are added
const rows = all("tbody tr");
const listed = new Set(rows.map((row) => row.dataset.guid)); // of many clashes the table has only the first

/** What a cell is sorted by: its number, or its text in lower case; what is empty comes last. */
function keyOf(row, column) {
  const cell = row.cells[column];
  const text = cell.dataset.order ?? cell.textContent.trim();
  if (text === "") return null;
  const number = Number(text.replace("−", "-").replace("∞", "Infinity"));
  return Number.isNaN(number) ? text.toLowerCase() : number;
}

function compare(a, b) {
  if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
  return typeof a === "number" ? a - b : a.localeCompare(b, "en", { numeric: true });
}

/** Rows in the order of a column; those that are equal stay as they were listed, the worst first. */
function sortBy(column, sign) {
  const keys = new Map(rows.map((row) => [row, keyOf(row, column)]));
  const sorted = [...rows].sort((a, b) => {
    const [one, other] = [keys.get(a), keys.get(b)];
    if (one === null || other === null) return (one === null) - (other === null);
    return sign * compare(one, other);
  });
  const body = document.querySelector("tbody");
  for (const row of sorted) body.append(row); // one by one: a call takes only so many
}

function makeSortable() {
  const heads = all("thead th");
  heads.forEach((head, column) => {
    const button = make("button", { type: "button", title: "Sort" }, head.textContent);
    head.replaceChildren(button);
    button.addEventListener("click", () => {
      const isDown = head.getAttribute("aria-sort") === "ascending";
      heads.forEach((other) => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", isDown ? "descending" : "ascending");
      sortBy(column, isDown ? -1 : 1);
    });
  });
}

/** Two columns more: status and comment, of the clashes that have a picture. */
function addColumns() {
  const head = document.querySelector("thead tr");
  head?.append(make("th", {}, "status"), make("th", {}, "comment"));
  for (const row of rows) row.append(make("td", { className: "status" }), make("td", { className: "comment" }));
}

function showInRow(row) {
  const { guid } = row.dataset;
  const note = notes.of(guid);
  const isNoted = cards.has(guid);
  const status = row.querySelector(".status");
  status.textContent = isNoted ? notes.statusOf(guid) : "";
  if (isNoted) status.dataset.order = statuses.indexOf(status.textContent);
  row.querySelector(".comment").textContent = isNoted ? note?.comment ?? "" : "";
}

function showInCard(card) {
  const note = notes.of(card.dataset.guid);
  const [status, comment, origin] = ["select", "textarea", ".origin"].map((part) => card.querySelector(`.review ${part}`));
  status.value = notes.statusOf(card.dataset.guid);
  if (comment.value !== (note?.comment ?? "")) comment.value = note?.comment ?? "";
  origin.textContent = note && note.report !== notes.report ? `noted in the report of ${note.report}` : "";
  origin.hidden = origin.textContent === "";
}

function addFields() {
  for (const [guid, card] of cards) {
    const status = make("select", { label: "Status" }, ...statuses.map((name) => make("option", {}, name)));
    const comment = make("textarea", { label: "Comment", placeholder: "Comment", rows: 1 });
    const save = () => notes.set(guid, { status: status.value, comment: comment.value });
    status.addEventListener("change", save);
    comment.addEventListener("input", save);
    card.querySelector("figcaption").append(make("div", { className: "review" }, status, comment, make("span", { className: "origin", hidden: true })));
  }
}

const controls = {
  search: make("input", { type: "search", placeholder: "Search names and comments", label: "Search names and comments", autocomplete: "off" }),
  status: make("select", { label: "Show clashes of a status" }, make("option", { value: "" }, "any status"), ...statuses.map((name) => make("option", {}, name))),
  count: make("output"),
  author: make("input", { className: "author", placeholder: "Your name", label: "Your name, as the author of comments", value: notes.author, autocomplete: "name" }),
  bcf: make("button", { type: "button", className: "bcf", title: "clashes.bcf with the status and the comment of each clash" }, "BCF with comments"),
  problem: make("output", { className: "problem" }),
};

const textOf = (row) => [...row.cells].map((cell) => cell.textContent).join(" ").toLowerCase();

/** Hides what the search and the choice of a status leave out. */
function filter() {
  const words = controls.search.value.toLowerCase().split(/\s+/).filter(Boolean);
  const isWanted = (text, status) => [status, ""].includes(controls.status.value) && words.every((word) => text.includes(word));
  const shown = new Set();
  for (const row of rows) {
    row.hidden = !isWanted(textOf(row), row.querySelector(".status").textContent);
    if (!row.hidden) shown.add(row.dataset.guid);
  }
  for (const [guid, card] of cards) {
    const [status, comment] = ["select", "textarea"].map((part) => card.querySelector(`.review ${part}`).value);
    card.hidden = listed.has(guid) ? !shown.has(guid) : !isWanted(`${captions.get(guid)} ${comment.toLowerCase()}`, status);
  }
  controls.count.textContent = shown.size === rows.length ? "" : `${shown.size} of ${rows.length}`;
}

function show(guid) {
  for (const row of rows) if (guid === null || row.dataset.guid === guid) showInRow(row);
  for (const [key, card] of cards) if (guid === null || key === guid) showInCard(card);
  controls.problem.textContent = notes.isKept ? "" : "This browser keeps no comments for this page: save the BCF before you leave.";
  if (guid === null) filter();
}

let archive; // the bytes of clashes.bcf, once they were asked for

/** A page that is a file may not read the one beside it, but may run it: this one hands over clashes.bcf. */
const archiveBytes = () =>
  (archive ??= new Promise((done, failed) => {
    window.allpairsBcf = (text) => done(Uint8Array.from(atob(text), (character) => character.charCodeAt(0)));
    document.head.append(make("script", { src: "clashes.bcf.js", onerror: () => failed(new Error("clashes.bcf.js is not beside this page")) }));
  }));

async function saveBcf() {
  try {
    const parts = await bcfWithNotes(await archiveBytes(), (guid) => (cards.has(guid) ? notes.of(guid) : null), controls.author.value.trim() || "Allpairs");
    const link = make("a", { href: URL.createObjectURL(new Blob(parts, { type: "application/octet-stream" })), download: "clashes.bcf" });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  } catch (problem) {
    archive = undefined;
    controls.problem.textContent = `Not saved: ${problem.message}`;
  }
}

function start() {
  addColumns();
  addFields();
  makeSortable();
  const bar = make("div", { className: "controls" }, controls.search, controls.status, controls.count);
  if (cards.size > 0) bar.append(controls.author, controls.bcf);
  bar.append(controls.problem);
  document.querySelector(".clashes").before(bar);
  controls.search.addEventListener("input", filter);
  controls.status.addEventListener("change", filter);
  controls.author.addEventListener("input", () => (notes.author = controls.author.value.trim()));
  controls.bcf.addEventListener("click", saveBcf);
  notes.addEventListener("change", ({ guid }) => show(guid));
  show(null);
  addEventListener("pageshow", () => { // on the way back browsers fill fields in as they were left
    controls.author.value = notes.author || controls.author.value;
    show(null);
  });
}

if (rows.length > 0) start();
document.documentElement.dataset.ready = "true";
