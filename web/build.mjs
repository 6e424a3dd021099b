// SPDX-License-Identifier: MIT
// Bundles the viewer into dist/viewer.html, the one page that the program carries. With --check it writes nothing and
// fails where that page is not what the sources make.

import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFile, writeFile } from "node:fs/promises";
import { sourcesHash } from "./sources.mjs";
import { onlyWhatIsUsed } from "./three.mjs";

const here = new URL(".", import.meta.url);
const target = new URL("dist/viewer.html", here);

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

async function page() {
  const script = `${notice}\n${await bundle("src/main.js", "iife")}`.replaceAll("</script", "<\\/script");
  const style = await bundle("src/style.css");
  const marks = { "SCRIPT-HASH": sha256(script), "STYLE-HASH": sha256(style), "SOURCES-HASH": await sourcesHash(here), STYLE: style, SCRIPT: script };
  const template = await readFile(new URL("index.html", here), "utf8");
  return template.replace(/SCRIPT-HASH|STYLE-HASH|SOURCES-HASH|(?<=<style>)STYLE|(?<=<script>)SCRIPT/g, (mark) => marks[mark]);
}

const text = await page();
if (process.argv.includes("--check")) {
  if ((await readFile(target, "utf8").catch(() => "")) !== text) {
    console.error("web/dist/viewer.html is not what web/ makes: run ./dev web");
    process.exit(1);
  }
} else {
  await writeFile(target, text);
  console.log(`web/dist/viewer.html: ${(text.length / 1024).toFixed(0)} KiB`);
}
