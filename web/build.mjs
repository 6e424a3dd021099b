// SPDX-License-Identifier: MIT
// Bundles the viewer into dist/viewer.html and the page of reports into dist/report.html, which the program carries. With --check
// it writes nothing and fails where these pages are not what the sources make.

import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFile, writeFile } from "node:fs/promises";
import { sourcesHash } from "./sources.mjs";
import { onlyWhatIsUsed } from "./three.mjs";

const here = new URL(".", import.meta.url);

/** What each page is made from. */
const pages = {
  "dist/viewer.html": { template: "index.html", script: "src/main.js", style: "src/style.css", notice: true },
  "dist/report.html": { template: "report.html", script: "src/report.js", style: "src/report.css", notice: false },
};

const common = {
  bundle: true,
  minify: true,
  write: false,
  charset: "ascii", // so that the page is the same whatever is put into it
  legalComments: "inline",
  target: ["chrome109", "firefox115", "safari16.4"],
  absWorkingDir: decodeURIComponent(here.pathname),
  plugins: [onlyWhatIsUsed],
};

async function bundle(entry, format) {
  const result = await build({ ...common, entryPoints: [entry], format });
  return result.outputFiles[0].text.trim();
}

// The single modules of three.js do not carry the notice of its licence.
const notice = "/*! three.js: Copyright 2010-2026 three.js authors, SPDX-License-Identifier: MIT */";

const sha256 = (text) => createHash("sha256").update(text).digest("base64");

async function made({ template, script: entry, style: sheet, notice: isWithThree }) {
  const script = `${isWithThree ? `${notice}\n` : ""}${await bundle(entry, "iife")}`.replaceAll("</script", "<\\/script");
  const style = await bundle(sheet);
  const marks = { "SCRIPT-HASH": sha256(script), "STYLE-HASH": sha256(style), "SOURCES-HASH": await sourcesHash(here), STYLE: style, SCRIPT: script };
  const text = await readFile(new URL(template, here), "utf8");
  return text.replace(/SCRIPT-HASH|STYLE-HASH|SOURCES-HASH|(?<=<style>)STYLE|(?<=<script>)SCRIPT/g, (mark) => marks[mark]);
}

for (const [name, parts] of Object.entries(pages)) {
  const target = new URL(name, here);
  const text = await made(parts);
  if (process.argv.includes("--check")) {
    if ((await readFile(target, "utf8").catch(() => "")) === text) continue;
    console.error(`web/${name} is not what web/ makes: run ./dev web`);
    process.exit(1);
  }
  await writeFile(target, text);
  console.log(`web/${name}: ${(text.length / 1024).toFixed(0)} KiB`);
}
