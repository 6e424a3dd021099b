// SPDX-License-Identifier: MIT
// Which Chromium draws the pages: the first on the search path, wherever it comes from.

import { execFileSync } from "node:child_process";

export const chromiumPath = () => execFileSync("sh", ["-c", "command -v chromium"], { encoding: "utf8" }).trim();
