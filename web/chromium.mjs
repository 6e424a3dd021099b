// SPDX-License-Identifier: MIT
// Which Chromium draws the pages, wherever it comes from: the one without windows of its own, which draws them in two thirds of
// the time, or else the whole browser.

import { execFileSync } from "node:child_process";

const find = "command -v chromium-headless-shell || command -v chromium";
export const chromiumPath = () => execFileSync("sh", ["-c", find], { encoding: "utf8" }).trim();
