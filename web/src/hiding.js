// SPDX-License-Identifier: MIT
// How many models the reader has hidden, with buttons to take that back.

import { byId } from "./dom.js";
import { counted } from "./format.js";

export function setUpHiding(app) {
  byId("hidden-undo").addEventListener("click", () => app.changeVisibility("undo"));
  byId("hidden-show").addEventListener("click", () => app.changeVisibility("showAll"));
  const update = () => {
    const count = app.visibility.hidden.size;
    byId("hidden-panel").hidden = count === 0;
    byId("hidden-count").textContent = `${counted(count, "model")} hidden`;
  };
  app.addEventListener("visibility", update);
  update();
}
