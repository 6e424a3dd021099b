// SPDX-License-Identifier: MIT
// What is chosen, in the address: #pair=first,second or #model=name, and of a sequence &frame=3. Names are as in the lists; one
// that several models have, or that begins with @, is @ and the model's number.

export class Address {
  constructor(app) {
    this.app = app;
    this.follow();
    app.addEventListener("choice", () => this.write());
    window.addEventListener("hashchange", () => this.follow());
  }

  /** The models by name, -1 for several; made when it is first asked for, since there may be many. */
  get models() {
    if (!this.byName) {
      const { scene } = this.app;
      this.byName = new Map();
      for (let i = 0; i < scene.models; ++i) this.byName.set(scene.nameOf(i), this.byName.has(scene.nameOf(i)) ? -1 : i);
    }
    return this.byName;
  }

  keyOf(model) {
    const name = this.app.scene.nameOf(model);
    return encodeURIComponent(this.models.get(name) === -1 || name.startsWith("@") ? `@${model}` : name);
  }

  /** The model that a key names, or -1. */
  modelOf(key) {
    try {
      const name = decodeURIComponent(key);
      const number = /^@(\d+)$/.exec(name);
      if (number) return Number(number[1]) < this.app.scene.models ? Number(number[1]) : -1;
      return this.models.get(name) ?? -1;
    } catch {
      return -1; // no text that was encoded
    }
  }

  text() {
    const { app } = this;
    const parts = [];
    if (app.scene.frames.length > 1 && app.index > 0) parts.push(`frame=${app.index}`);
    if (app.chosenPair) parts.push(`pair=${app.chosenPair.map((model) => this.keyOf(model)).join(",")}`);
    else if (app.models.length === 1) parts.push(`model=${this.keyOf(app.models[0])}`);
    return parts.join("&");
  }

  write() {
    const text = this.text();
    if (this.isFollowing || text === location.hash.slice(1)) return;
    try {
      history.replaceState(null, "", text ? `#${text}` : location.pathname + location.search);
    } catch {
      // browsers allow only so many a minute
    }
  }

  /** Does something that the address does not say. */
  without(act) {
    this.isFollowing = true;
    try {
      act();
    } finally {
      this.isFollowing = false;
    }
  }

  /** Chooses what the address says, as text() says it: without a frame it is the first, without names nothing is chosen.
   * What is not of this page is left alone. */
  follow() {
    const text = location.hash.slice(1);
    const parts = new Map(text.split("&").map((part) => [part.split("=")[0], part.slice(part.indexOf("=") + 1)]));
    if (text !== "" && !["frame", "pair", "model"].some((name) => parts.has(name))) return;
    const keys = parts.has("pair") ? parts.get("pair").split(",") : parts.has("model") ? [parts.get("model")] : [];
    const models = keys.map((key) => this.modelOf(key));
    const areOfPage = models.length <= 2 && !models.includes(-1);
    const { app } = this;
    const frame = parts.has("frame") ? Number(parts.get("frame")) : areOfPage ? 0 : app.index;
    const isOfPage = app.scene.frames[frame] !== undefined;
    this.without(() => {
      if (isOfPage && frame !== app.index) app.setFrame(frame);
      if (areOfPage && (isOfPage || models.length > 0)) app.choose(models);
    });
  }
}
