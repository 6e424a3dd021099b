// SPDX-License-Identifier: MIT
// One hash over all that the page is made from. scripts/check-page computes the same without Node.

import { createHash } from "node:crypto";
import { readdir, readFile } from "node:fs/promises";

const single = ["build.mjs", "index.html", "package-lock.json", "package.json", "report.html", "sources.mjs", "three.mjs"];

/** SHA-256 of the lines "hash  path" of all source files, ordered by path as bytes: what sha256sum prints. */
export async function sourcesHash(folder) {
  const sources = (await readdir(new URL("src/", folder))).map((name) => `src/${name}`);
  const lines = [];
  for (const path of [...single, ...sources].sort()) {
    lines.push(`${createHash("sha256").update(await readFile(new URL(path, folder))).digest("hex")}  ${path}\n`);
  }
  return createHash("sha256").update(lines.join("")).digest("hex");
}
