// SPDX-License-Identifier: MIT
// A BCF file with what was noted about its topics.
// Reference: buildingSMART, BIM Collaboration Format 2.1 and 3.0, markup.xsd.

import { readZip, textOf, withText, writeZip } from "./zip.js";

/** The text with only the characters that XML has. */
const printable = (text) => text.replace(/[^\t\n\r\x20-\uD7FF\uE000-\uFFFD\u{10000}-\u{10FFFF}]/gu, "\uFFFD");

function append(parent, name, text, before = null) {
  const element = parent.ownerDocument.createElementNS(null, name);
  if (text !== undefined) element.textContent = printable(text);
  return parent.insertBefore(element, before);
}

/** Children of a topic's markup: BCF 3.0 has comments and viewpoints in the topic, 2.1 behind it. */
function addComment(markup, topic, note, author) {
  const inTopic = topic.querySelector(":scope > Viewpoints");
  const isThree = inTopic !== null;
  const viewpoint = isThree ? inTopic.querySelector("ViewPoint") : markup.querySelector(":scope > Viewpoints");
  const parent = isThree ? append(topic, "Comments", undefined, inTopic) : markup;
  const comment = append(parent, "Comment", undefined, isThree ? null : viewpoint);
  comment.setAttribute("Guid", note.guid);
  append(comment, "Date", note.date);
  append(comment, "Author", author);
  append(comment, "Comment", note.comment);
  if (viewpoint) append(comment, "Viewpoint").setAttribute("Guid", viewpoint.getAttribute("Guid"));
}

/** The markup of a topic with a note: its status, when it was changed, and the comment, which shows the topic's viewpoint. */
export function withNote(text, note, author) {
  const document = new DOMParser().parseFromString(text, "application/xml");
  const markup = document.documentElement;
  const topic = markup.querySelector(":scope > Topic");
  if (!topic) throw new Error("a topic without markup");
  topic.setAttribute("TopicStatus", note.status);
  const behind = topic.querySelector(":scope > CreationAuthor").nextSibling;
  append(topic, "ModifiedDate", note.date, behind);
  append(topic, "ModifiedAuthor", author, behind);
  if (note.comment.trim() !== "") addComment(markup, topic, note, author);
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(markup)}\n`;
}

/** The parts of a BCF file, for a Blob, with the notes that `noteOf` gives for the GUIDs of topics. */
export async function bcfWithNotes(bytes, noteOf, author) {
  const entries = readZip(bytes).map(async (entry) => {
    const [, guid] = /^([^/]+)\/markup\.bcf$/.exec(entry.name) ?? [];
    const note = guid && noteOf(guid);
    return note ? withText(entry, withNote(await textOf(entry), note, author)) : entry;
  });
  return writeZip(await Promise.all(entries));
}
