// SPDX-License-Identifier: MIT
// What is shown and chosen, and who must know when it changes.

import { state } from "./exact.js";
import { kind, modelKinds, PairTable, pairsWithout, partnerCounts } from "./pairs.js";
import { look } from "./styles.js";
import { tone } from "./palette.js";
import { Visibility } from "./visibility.js";

const flashMs = 700;
const sizeOf = (box) => Math.hypot(...[0, 1, 2].map((k) => box[k + 3] - box[k]));

/** Whether one is seen through the other only. */
const isNested = (finding) => [state.contained, state.duplicate, state.undecided].includes(finding.state);

export class App extends EventTarget {
  constructor(scene) {
    super();
    this.scene = scene;
    this.stage = null; // until there is a picture; for good where the browser has no WebGL
    this.show = { boxes: scene.sequence === null && scene.exact === null, shapes: true, links: false, excluded: true, region: scene.region !== null };
    this.boxMode = scene.models > 3000 ? "solid" : "outlines";
    this.models = []; // chosen: none, one, or the two of a pair
    this.visibility = new Visibility(scene.models);
    this.setFrame(0);
  }

  get frame() {
    return this.scene.frames[this.index];
  }

  /** Shows everything in a picture from now on. */
  attach(stage) {
    this.stage = stage;
    stage.setFrame(this.frame);
    this.restyle();
    if (this.models.length > 0) this.lookAtChosen();
    this.emit("show");
  }

  emit(name) {
    this.dispatchEvent(new Event(name));
  }

  setFrame(index, { flash = false } = {}) {
    this.index = index;
    this.table = new PairTable(this.frame, this.scene);
    this.kinds = modelKinds(this.table, this.scene.models);
    this.partners = partnerCounts(this.table, this.scene.models);
    this.counts = this.table.counts();
    this.entry = this.entryOfChosen();
    this.stage?.setFrame(this.frame);
    if (flash && index > 0) this.flash();
    else this.clearFlash();
    this.restyle();
    this.emit("frame");
    this.emit("choice");
  }

  /** The pairs that began and ended since the frame before, whichever was shown then. */
  changesOf(index) {
    const { frames, models } = this.scene;
    const [was, now] = [frames[index - 1].pairs, frames[index].pairs];
    return { began: pairsWithout(now, was, models), ended: pairsWithout(was, now, models) };
  }

  flash() {
    const { began, ended } = this.changesOf(this.index);
    this.flashing = new Map();
    for (const pair of ended) pair.forEach((model) => this.flashing.set(model, tone.ended));
    for (const pair of began) pair.forEach((model) => this.flashing.set(model, tone.began));
    this.stage?.setLines(this.stage.flashes[0], began);
    this.stage?.setLines(this.stage.flashes[1], ended);
    clearTimeout(this.flashTimer);
    this.flashTimer = setTimeout(() => {
      this.clearFlash();
      this.restyle();
    }, flashMs);
  }

  clearFlash() {
    this.flashing = null;
    for (const lines of this.stage?.flashes ?? []) lines.visible = false;
  }

  /** Chooses nothing, a model, or the two models of a pair. */
  choose(models, { look: frames = true } = {}) {
    this.models = models.length === 2 && models[0] === models[1] ? [models[0]] : models;
    this.isSelf = models.length === 2 && models[0] === models[1];
    this.entry = this.entryOfChosen();
    if (this.visibility.reveal(models)) this.emit("visibility");
    this.restyle();
    if (frames && models.length > 0) this.lookAtChosen();
    this.emit("choice");
  }

  /** The entry of the pair that is chosen, in the table of the frame, or -1. */
  entryOfChosen() {
    return this.chosenPair ? this.table.find(...this.chosenPair) : -1;
  }

  /** A model while a pair of it is chosen, and the other way round, stays chosen when the frame changes. */
  get chosenPair() {
    return this.isSelf ? [this.models[0], this.models[0]] : this.models.length === 2 ? this.models : null;
  }

  /** If one model is chosen and this one is a partner of it: their pair. Else null. */
  pairWith(model) {
    const { table } = this;
    const entry = this.models.length === 1 && this.models[0] !== model ? table.find(this.models[0], model) : -1;
    const arePartners = entry >= 0 && entry < table.found && !table.isApart(entry);
    return arePartners ? [table.first(entry), table.second(entry)] : null;
  }

  /** What shapes say of the pair that is chosen, or null. */
  get finding() {
    return this.scene.exact !== null && this.entry >= 0 && this.entry < this.table.found ? this.scene.exact.of(this.entry) : null;
  }

  lookAtChosen() {
    if (!this.stage || this.models.length === 0) return;
    const { finding } = this;
    if (finding && finding.state !== state.notExamined && !this.stage.isExploded) return this.stage.lookAtContact(finding, this.models, this.scene.exact.viewOf(this.entry));
    const corners = this.stage.boxAround(this.models);
    if (corners) this.stage.lookAt(corners);
  }

  /** Looks at everything that is not hidden. */
  lookAtAll() {
    if (!this.stage) return;
    const shown = this.visibility.hidden.size > 0 ? Array.from({ length: this.scene.models }, (_, i) => i).filter((i) => this.visibility.isShown(i)) : [];
    this.stage.lookAt(this.stage.boxAround(shown) ?? this.stage.sight);
  }

  /** What a ray through a place of the window meets first, as Stage.hitAt() gives it: what is faint only where nothing else is. */
  hitAt(x, y, onlyBoxes) {
    const isShown = (model) => this.visibility.isShown(model);
    const isSolid = (model) => isShown(model) && !this.stage.styles.isFaint(model);
    return this.stage.hitAt(x, y, isSolid, onlyBoxes) ?? this.stage.hitAt(x, y, isShown, onlyBoxes);
  }

  /** Hides models, shows all again, or takes the last of these back: a method of Visibility, and what it is to know. */
  changeVisibility(how, ...more) {
    this.visibility[how](...more);
    if (this.models.every((model) => this.visibility.isShown(model))) this.restyle();
    else this.choose([]); // what is hidden is no longer chosen, so that what was behind it is seen
    this.emit("visibility");
  }

  /** Whether no side of a model's box is at infinity. */
  isFinite(model) {
    return this.frame.boxes.subarray(6 * model, 6 * model + 6).every(Number.isFinite);
  }

  /** Moves bodies apart, by a part of how far they are from the middle; 0 leaves them where they are. */
  explode(factor) {
    this.stage?.setExplosion(factor);
    this.restyle();
  }

  toggle(what) {
    this.show[what] = !this.show[what];
    this.restyle();
    this.emit("show");
  }

  setBoxMode(mode) {
    this.boxMode = mode;
    this.restyle();
    this.emit("show");
  }

  toneOf(model) {
    const place = this.models.indexOf(model);
    if (place >= 0) return place === 0 ? tone.first : tone.second;
    const flash = this.flashing?.get(model);
    if (flash !== undefined) return flash;
    const is = this.kinds[model];
    return is === kind.excluded && !this.show.excluded ? kind.free : is;
  }

  restyle() {
    const { stage, scene } = this;
    if (!stage) return;
    const near = this.models.length === 1 ? new Set(this.table.entriesOf(this.models[0]).flatMap((e) => [this.table.first(e), this.table.second(e)])) : null;
    const chosenModels = new Set(this.models);
    let anyFaint = false;
    for (let i = 0; i < scene.models; ++i) {
      const chosen = this.models.length === 0 || chosenModels.has(i) || near?.has(i);
      const isAround = this.finding !== null && this.models[1 - this.innerOfChosen()] === i && isNested(this.finding);
      const faint = !chosen || isAround || (this.models.length === 0 && this.kinds[i] === kind.out);
      const shown = this.visibility.isShown(i) ? look.shown : 0;
      stage.styles.set(i, this.toneOf(i), shown | (faint ? look.faint : near && !chosenModels.has(i) ? look.ghost : 0));
      anyFaint ||= faint;
    }
    stage.styles.update();
    stage.boxes.setMode(this.show.boxes ? this.boxMode : "hidden", anyFaint);
    stage.boxes.setFill(stage.shapes.length > 0 ? 0.03 : 0.1);
    for (const shape of stage.shapes) shape.visible = this.show.shapes;
    stage.region.visible = this.show.region && scene.region !== null;
    stage.setLines(stage.links, this.show.links ? this.foundPairs() : []);
    stage.setChosen(this.models.filter((model) => this.visibility.isShown(model)), this.show.boxes);
    if (scene.exact !== null) stage.setContact(this.contactsInSight(), this.finding !== null);
  }

  /** Which of the two that are chosen is the smaller. */
  innerOfChosen() {
    const [first, second] = this.models.map((model) => sizeOf(this.stage.boxOf(model)));
    return first < second ? 0 : 1;
  }

  /** The contacts to show: that of the pair that is chosen, else those of a model or all; none of models that are hidden, and
   * none while bodies are not where they touch. */
  contactsInSight() {
    if (this.stage.isExploded) return [];
    if (this.finding) return this.isInSight(this.entry) ? [this.entry] : [];
    const all = this.models.length === 1 ? this.table.entriesOf(this.models[0]) : Array.from({ length: this.table.found }, (_, e) => e);
    return all.filter((e) => this.scene.exact.stateOf(e) <= state.clash && this.isInSight(e));
  }

  isInSight(entry) {
    return this.visibility.isShown(this.table.first(entry)) && this.visibility.isShown(this.table.second(entry));
  }

  foundPairs() {
    const entries = Array.from({ length: this.table.found }, (_, e) => e).filter((e) => !this.table.isApart(e) && this.isInSight(e));
    return entries.map((e) => [this.table.first(e), this.table.second(e)]);
  }
}
