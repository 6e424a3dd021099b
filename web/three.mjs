// SPDX-License-Identifier: MIT
// What of three.js is bundled: its single modules, so that what nobody imports stays out, and of its shaders those of plain
// colours, the only ones of its own that the page draws with. A shader that was missing would not compile, and the tests
// look for what the browser complains of.

import { readFile } from "node:fs/promises";
import { basename } from "node:path";
import { fileURLToPath } from "node:url";

const three = fileURLToPath(new URL("node_modules/three/src", import.meta.url));
const shaders = `${three}/renderers/shaders`;
const used = "meshbasic"; // MeshBasicMaterial and LineBasicMaterial

/** The parts that a shader includes, or the code that puts shaders together, and those that they include. */
async function partsOf(path, parts = new Set()) {
  for (const [, part] of (await readFile(path, "utf8")).matchAll(/(?:#include <|ShaderChunk\[\s*')(\w+)(?:>|'\s*\])/g)) {
    if (parts.has(part)) continue;
    parts.add(part);
    await partsOf(`${shaders}/ShaderChunk/${part}.glsl.js`, parts);
  }
  return parts;
}

/** A shader's part without comments, indents and empty lines, which no browser needs. */
const terse = (text) => text.replace(/^\s*\/\/.*$|[ \t]+\/\/.*$/gm, "").replace(/\n\s+/g, "\n");

export const onlyWhatIsUsed = {
  name: "three",
  async setup(build) {
    const parts = await partsOf(`${three}/renderers/webgl/WebGLProgram.js`, await partsOf(`${shaders}/ShaderLib/${used}.glsl.js`));
    build.onResolve({ filter: /^three$/ }, () => ({ path: `${three}/Three.js`, sideEffects: false }));
    build.onLoad({ filter: /shaders\/ShaderChunk\/.*\.glsl\.js$/ }, async ({ path }) => ({ contents: parts.has(basename(path, ".glsl.js")) ? terse(await readFile(path, "utf8")) : 'export default "";' }));
    build.onLoad({ filter: /shaders\/ShaderLib\/.*\.glsl\.js$/ }, ({ path }) => (basename(path, ".glsl.js") === used ? undefined : { contents: 'export const vertex = "", fragment = "";' }));
  },
};
