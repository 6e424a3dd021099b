// SPDX-License-Identifier: MIT
// What goes out of the page: what is listed as CSV and JSON, the names of what is chosen, and the picture.

import { byId } from "./dom.js";
import { placeOf, state, states } from "./exact.js";
import { kind, sharedExtents } from "./pairs.js";

const keptMs = 60_000; // until a file that is saved is let go
const number = (value) => (value === null || Number.isNaN(value) ? null : Number.isFinite(value) ? value : value > 0 ? "inf" : "-inf");
const along = (name, values) => Object.fromEntries(["x", "y", "z"].map((axis, k) => [name ? `${name}_${axis}` : axis, number(values[k])]));
const nothing = [null, null, null];

/** What shapes say of a pair, with the names of the columns of a report's clashes.csv. */
function findingFields(finding) {
  if (finding.state === state.notExamined) return { state: states[finding.state], depth: null, distance: null, ...along("", nothing), ...along("normal", nothing) };
  const place = placeOf(finding);
  return { state: states[finding.state], depth: number(finding.depth), distance: number(finding.distance), ...along("", place), ...along("normal", finding.normal) };
}

const kindWords = { [kind.pair]: "pair", [kind.self]: "self", [kind.excluded]: "excluded" };

/** What boxes say of a pair, also with the names of a report's columns; `kind` is only here. */
function boxFields({ table, frame }, entry) {
  const extents = sharedExtents(frame.boxes, table.first(entry), table.second(entry));
  return { kind: kindWords[table.kindOf(entry)], ...along("overlap", extents), volume: number(table.volume(entry)) };
}

/** All pairs of the rows that are listed, in their order: pairs of one row have its number. */
export function listedPairs(app, items) {
  const { scene, table } = app;
  return items.flatMap((item, row) => table.rowOf(item).map((entry) => {
    const [first, second] = [table.first(entry), table.second(entry)];
    const names = { number: row + 1, first: scene.nameOf(first), second: scene.nameOf(second) };
    const ifc = scene.ids.length > 0 ? { first_type: scene.kinds[first], first_id: scene.ids[first], second_type: scene.kinds[second], second_id: scene.ids[second] } : {};
    if (scene.exact === null) return { ...names, ...boxFields(app, entry), ...ifc };
    const isTested = entry < table.found;
    const fields = findingFields(isTested ? scene.exact.of(entry) : { state: state.notExamined });
    return { ...names, ...fields, ...(isTested ? {} : { state: "excluded" }), ...ifc };
  }));
}

export function listedModels({ scene, frame, partners, visibility }, items) {
  return items.map((model) => {
    const box = frame.boxes.subarray(6 * model, 6 * model + 6);
    const ifc = scene.ids.length > 0 ? { ifcType: scene.kinds[model], globalId: scene.ids[model] } : {};
    return { model, name: scene.nameOf(model), type: scene.typeNames[scene.types[model]], ...ifc, partners: partners[model], hidden: !visibility.isShown(model), ...along("min", box), ...along("max", box.subarray(3)) };
  });
}

/** A text as a field: quoted where that is needed, and with ' before what a spreadsheet would take for a formula, by the rule of
 * looksLikeFormula() in src/view/Text.cpp. */
function field(value) {
  if (value === null) return "";
  if (typeof value !== "string" || value === "-inf") return String(value);
  const text = /^'*[=+\-@\t\r]/.test(value) ? `'${value}` : value;
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** The columns of a list without an entry: those that its entries would have. */
const columns = {
  pairs: ({ scene }) => [
    "number", "first", "second",
    ...(scene.exact === null ? ["kind", "overlap_x", "overlap_y", "overlap_z", "volume"] : Object.keys(findingFields({ state: state.notExamined }))),
    ...(scene.ids.length > 0 ? ["first_type", "first_id", "second_type", "second_id"] : []),
  ],
  models: ({ scene }) => [
    "model", "name", "type", ...(scene.ids.length > 0 ? ["ifcType", "globalId"] : []), "partners", "hidden",
    ...["min", "max"].flatMap((corner) => ["x", "y", "z"].map((axis) => `${corner}_${axis}`)),
  ],
};

/** Rows as CSV, or these columns where there is none; a mark says that it is UTF-8 where it is not ASCII, as
 * spreadsheets want it. */
export function csvOf(rows, none = []) {
  const text = [rows.length > 0 ? Object.keys(rows[0]) : none, ...rows.map(Object.values)].map((cells) => `${cells.map(field).join(",")}\n`).join("");
  return /[\u0080-\uffff]/.test(text) ? `\ufeff${text}` : text;
}

export const jsonOf = (rows) => `[${rows.map((row) => `\n  ${JSON.stringify(row)}`).join(",")}\n]\n`;

function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), keptMs);
}

/** The buttons that save a panel's list. */
export function setUpSaving(app, panels) {
  const kinds = { csv: [csvOf, "text/csv"], json: [jsonOf, "application/json"] };
  const listed = { pairs: listedPairs, models: listedModels };
  for (const [list, panel] of Object.entries(panels)) {
    for (const [suffix, [format, type]] of Object.entries(kinds)) {
      byId(`${list}-${suffix}`).addEventListener("click", () => save(`${list}.${suffix}`, new Blob([format(listed[list](app, panel.items), columns[list](app))], { type })));
    }
  }
}

/** The button that saves the picture. */
export function setUpPictures(stage) {
  const element = byId("save-picture");
  element.hidden = false;
  element.addEventListener("click", async () => save("picture.png", await stage.picture()));
}

/** Copies the names of the models that are chosen, a line each. */
export async function copyNames(app) {
  const text = app.models.map(app.scene.nameOf).join("\n");
  if (text === "") return;
  try {
    await navigator.clipboard.writeText(text);
  } catch { // where a page may not, what is selected may be copied
    const area = document.body.appendChild(document.createElement("textarea"));
    area.value = text;
    area.select();
    document.execCommand("copy");
    area.remove();
  }
}
