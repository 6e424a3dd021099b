// SPDX-License-Identifier: MIT
// Zip archives in memory, as far as BCF files need them: entries are read, some are replaced, and all are written again.
// Reference: PKWARE, .ZIP file format specification (APPNOTE), 6.3.

const endMark = 0x06054b50;
const listMark = 0x02014b50;
const entryMark = 0x04034b50;

const table = Uint32Array.from({ length: 256 }, (_, byte) => {
  let rest = byte;
  for (let bit = 0; bit < 8; ++bit) rest = rest & 1 ? (rest >>> 1) ^ 0xedb88320 : rest >>> 1;
  return rest;
});

function checksumOf(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = (sum >>> 8) ^ table[(sum ^ byte) & 255];
  return ~sum >>> 0;
}

/** Where the end of the list of entries begins: a comment of up to 64 KiB may follow it. */
function endOf(view) {
  for (let at = view.byteLength - 22; at >= 0; --at) if (view.getUint32(at, true) === endMark) return at;
  throw new Error("no zip archive");
}

/** Throws where numbers do not fit into 16 and 32 bits: only zip64 archives have such, and are not written here. */
function checkSize(count, place) {
  if (count >= 0xffff || place >= 0xffffffff) throw new Error("clashes.bcf has too many topics for comments to be added here");
}

/** The entries of an archive in their order, compressed as they are. */
export function readZip(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const end = endOf(view);
  const entries = [];
  let at = view.getUint32(end + 16, true);
  checkSize(view.getUint16(end + 10, true), at);
  for (let left = view.getUint16(end + 10, true); left > 0; --left) {
    if (view.getUint32(at, true) !== listMark) throw new Error("a damaged zip archive");
    const [size, nameLength, extraLength, noteLength] = [view.getUint32(at + 20, true), ...[28, 30, 32].map((place) => view.getUint16(at + place, true))];
    const local = view.getUint32(at + 42, true);
    const begin = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
    entries.push({
      name: new TextDecoder().decode(bytes.subarray(at + 46, at + 46 + nameLength)),
      method: view.getUint16(at + 10, true),
      moment: view.getUint32(at + 12, true),
      checksum: view.getUint32(at + 16, true),
      length: view.getUint32(at + 24, true),
      packed: bytes.subarray(begin, begin + size),
    });
    at += 46 + nameLength + extraLength + noteLength;
  }
  return entries;
}

/** The text of an entry, which is stored or deflated. */
export async function textOf(entry) {
  if (entry.method === 0) return new TextDecoder().decode(entry.packed);
  const stream = new Blob([entry.packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).text();
}

/** An entry with another text instead. */
export function withText(entry, text) {
  const packed = new TextEncoder().encode(text);
  return { ...entry, method: 0, checksum: checksumOf(packed), length: packed.length, packed };
}

function header(mark, size, entry, name, place) {
  const view = new DataView(new ArrayBuffer(size));
  view.setUint32(0, mark, true);
  const at = mark === listMark ? 6 : 4; // the list has the version of the writer besides
  if (mark === listMark) view.setUint16(4, 20, true);
  view.setUint16(at, 20, true);
  view.setUint16(at + 2, 0x800, true); // names are UTF-8
  view.setUint16(at + 4, entry.method, true);
  [entry.moment, entry.checksum, entry.packed.length, entry.length].forEach((number, i) => view.setUint32(at + 6 + 4 * i, number, true));
  view.setUint16(at + 22, name.length, true);
  if (mark === listMark) view.setUint32(42, place, true);
  return view;
}

/** The parts of an archive with these entries, for a Blob. */
export function writeZip(entries) {
  const [parts, list] = [[], []];
  let place = 0;
  for (const entry of entries) {
    const name = new TextEncoder().encode(entry.name);
    parts.push(header(entryMark, 30, entry, name), name, entry.packed);
    list.push(header(listMark, 46, entry, name, place), name);
    place += 30 + name.length + entry.packed.length;
  }
  checkSize(entries.length, place);
  const end = new DataView(new ArrayBuffer(22));
  end.setUint32(0, endMark, true);
  end.setUint16(8, entries.length, true);
  end.setUint16(10, entries.length, true);
  end.setUint32(12, list.reduce((sum, part) => sum + part.byteLength, 0), true);
  end.setUint32(16, place, true);
  return [...parts, ...list, end];
}
