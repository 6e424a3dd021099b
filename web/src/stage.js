// SPDX-License-Identifier: MIT
// The 3D picture: what is in it, the camera, and when to draw. It draws only when something has changed.

import {
  Box3, Box3Helper, BoxGeometry, BufferAttribute, BufferGeometry, Color, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, Vector4, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { BoxCloud } from "./boxes.js";
import { Contacts } from "./contacts.js";
import { contactCorners } from "./exact.js";
import { drawable, spreadBoxes, wideEnough } from "./extent.js";
import { Ground } from "./ground.js";
import { paletteOf, tone } from "./palette.js";
import { pick } from "./pick.js";
import { Shade } from "./shade.js";
import { Sharpness } from "./sharpness.js";
import { makeShapes } from "./shapes.js";
import { approach, move, turn } from "./steer.js";
import { ModelOffsets, ModelStyles } from "./styles.js";

const sizeOf = (corners) => Math.hypot(...[0, 1, 2].map((k) => corners[k + 3] - corners[k]));

const manyModels = 5000; // of more, some may be missing while the picture moves
const tooManyModels = 20_000; // of more, some are missing from the first picture

const emptyBox = () => new Box3(new Vector3(0, 0, 0), new Vector3(0, 0, 0));

export class Stage extends EventTarget {
  /** `whole` is what wholeOf() gives of the scene. */
  constructor(canvas, scene, whole) {
    super();
    this.canvas = canvas;
    this.data = scene;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    this.renderer.localClippingEnabled = true;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(40, 1, 0.1, 1000);
    this.sharpness = new Sharpness(() => this.invalidate(), scene.models > manyModels ? 0.5 : 1, scene.models <= tooManyModels);
    this.styles = new ModelStyles(scene.models, scene.bodyOf);
    this.offsets = new ModelOffsets(scene.models);
    this.explosion = 0;
    this.marks = []; // with their tones: what others add
    const palette = Array.from({ length: 11 }, () => new Color());
    this.shared = { styles: { value: this.styles.texture }, offsets: { value: this.offsets.texture }, exploded: { value: false }, palette: { value: palette }, calm: { value: scene.exact !== null }, cut: { value: new Vector4(0, 0, 0, 1) } };
    this.whole = whole;
    this.build();
    this.setUp(this.data.up);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  build() {
    this.boxes = new BoxCloud(this.data.models, this.shared);
    this.shapes = makeShapes(this.data.mesh, this.shared);
    this.region = new Box3Helper(emptyBox(), tone.region);
    this.links = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.6, depthTest: false }));
    this.flashes = [tone.began, tone.ended].map(() => new LineSegments(new BufferGeometry(), new LineBasicMaterial({ depthTest: false })));
    this.overlap = new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial({ transparent: true, opacity: 0.5, depthTest: false }));
    this.overlapEdges = new Box3Helper(emptyBox(), 0xffffff);
    this.overlapEdges.material.depthTest = false;
    this.chosen = [tone.first, tone.second].map(() => new Box3Helper(emptyBox(), 0xffffff));
    this.contacts = new Contacts(this.data, sizeOf(this.whole));
    const marks = [this.region, this.links, ...this.flashes, this.overlap, this.overlapEdges, ...this.chosen, ...this.contacts.objects];
    marks.forEach((mark, i) => {
      mark.visible = false;
      mark.frustumCulled = false;
      mark.renderOrder = 10 + i;
    });
    this.shade = new Shade(this.shapes.filter((shape) => shape.isMesh && !shape.material.transparent));
    this.ground = new Ground();
    this.scene.add(this.ground.object, ...this.boxes.objects, ...this.shapes, this.shade.object, ...marks);
    if (this.data.region) this.place(this.region, drawable(this.data.region, this.data.origin, wideEnough(this.data, this.whole)));
  }

  /** Draws an object in front of all else, in the colour of a tone. */
  addMark(mark, is) {
    mark.frustumCulled = false;
    mark.renderOrder = 100;
    this.scene.add(mark);
    this.marks.push([mark, is]);
    if (this.tones) mark.material.color.set(this.tones[is]);
  }

  place(helper, corners) {
    helper.box.min.fromArray(corners, 0);
    helper.box.max.fromArray(corners, 3);
    helper.visible = true;
    helper.updateMatrixWorld(true);
  }

  setTheme(theme) {
    const { background, tones } = paletteOf(theme);
    this.scene.background = new Color(background);
    this.shared.palette.value.forEach((colour, i) => colour.setStyle(tones[i], "srgb-linear"));
    this.tones = tones;
    const paint = (object, i) => object.material.color.set(tones[i]);
    for (const [mark, is] of this.marks) paint(mark, is);
    paint(this.ground.object, tone.region);
    paint(this.region, tone.region);
    paint(this.links, tone.overlap);
    paint(this.flashes[0], tone.began);
    paint(this.flashes[1], tone.ended);
    paint(this.overlap, tone.overlap);
    paint(this.overlapEdges, tone.overlap);
    this.contacts.paint(tones[tone.overlap], background);
    paint(this.chosen[0], tone.first);
    paint(this.chosen[1], tone.second);
    this.invalidate();
  }

  /** Draws no shape beyond a plane, given by its normal and how far along that it is. */
  setCut(plane) {
    this.shared.cut.value.fromArray(plane);
    this.contacts.setCut(plane);
    this.invalidate();
  }

  /** Takes the boxes of a frame. */
  setFrame(frame) {
    this.inPlace = drawable(frame.boxes, this.data.origin, this.whole);
    if (this.data.sequence) this.moveShapes(frame.index);
    this.spread();
  }

  /** Moves bodies away from the middle of the scene: by `factor` times how far from it they are. */
  setExplosion(factor) {
    this.explosion = factor;
    if (!this.isExploded) this.offsets.texels.fill(0);
    this.ground.place(this.sight, this.data.origin, this.up);
    this.spread();
  }

  get isExploded() {
    return this.explosion > 0;
  }

  /** Puts boxes and shapes where they are drawn. */
  spread() {
    this.drawn = this.inPlace;
    this.shared.exploded.value = this.isExploded;
    if (this.isExploded) {
      this.drawn = spreadBoxes({ boxes: this.inPlace, bodyOf: this.data.bodyOf, whole: this.whole, factor: this.explosion, offsets: this.offsets });
      this.offsets.texture.needsUpdate = true;
    }
    this.boxes.setBoxes(this.drawn);
    this.dispatchEvent(new Event("spread"));
    this.invalidate();
  }

  /** What there is to see, as six numbers. */
  get sight() {
    const stretch = 1 + this.explosion;
    return this.whole.map((value, k) => {
      const middle = (this.whole[k % 3] + this.whole[(k % 3) + 3]) / 2;
      return middle + stretch * (value - middle);
    });
  }

  moveShapes(index) {
    this.data.sequence.place(this.data.mesh.vertices, index, this.data.origin);
    for (const shape of this.shapes) shape.geometry.getAttribute("position").needsUpdate = true;
  }

  boxOf(model) {
    return this.drawn.subarray(6 * model, 6 * model + 6);
  }

  /** The box around those of some models, as six numbers, or null where all of these are empty. */
  boxAround(models) {
    const corners = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    for (const model of models) {
      const box = this.boxOf(model);
      if (box[0] > box[3]) continue; // empty
      for (let k = 0; k < 3; ++k) {
        corners[k] = Math.min(corners[k], box[k]);
        corners[k + 3] = Math.max(corners[k + 3], box[k + 3]);
      }
    }
    return corners[0] <= corners[3] ? corners : null;
  }

  /** Draws the boxes of up to two models bold, and what they share. */
  setChosen(models, showBoxes = true) {
    this.chosen.forEach((helper, i) => {
      helper.visible = showBoxes && models[i] !== undefined && this.boxOf(models[i])[0] <= this.boxOf(models[i])[3];
      if (helper.visible) this.place(helper, this.boxOf(models[i]));
    });
    const isPair = models.length === 2 && models[0] !== models[1];
    this.overlap.visible = this.overlapEdges.visible = isPair && showBoxes && this.placeOverlap(...models.map((m) => this.boxOf(m)));
    this.invalidate();
  }

  /** Draws the contacts of some entries; of one that is chosen with its depth or gap. */
  setContact(entries, isChosen) {
    this.contacts.show(entries, isChosen);
    this.invalidate();
  }

  /** Looks at where two models meet, with some of both around it, from the side that shows most. */
  lookAtContact(finding, models, view) {
    const contact = contactCorners(finding).map((value, k) => value - this.data.origin[k % 3]);
    const sizes = models.map((model) => sizeOf(this.boxOf(model)));
    const half = Math.min(Math.max(1.6 * sizeOf(contact), 0.75 * Math.min(...sizes)), 0.6 * (sizes[0] + (sizes[1] ?? 0))) / 2 || 1;
    const corners = [-1, 1].flatMap((sign) => [0, 1, 2].map((k) => (contact[k] + contact[k + 3]) / 2 + (sign * half) / Math.sqrt(3)));
    this.lookAt(corners, view ? new Vector3(...view).negate() : undefined);
    this.backOutOf(models);
  }

  /** Moves the camera back until it is in neither box: from within a large part one sees nothing but that part. */
  backOutOf(models) {
    const { position } = this.camera;
    const { target } = this.controls;
    const isWithin = (box) => [0, 1, 2].every((k) => position.getComponent(k) > box[k] && position.getComponent(k) < box[k + 3]);
    const isIn = () => models.some((model) => isWithin(this.boxOf(model)));
    for (let step = 0; step < 24 && isIn(); ++step) position.sub(target).multiplyScalar(1.2).add(target);
    this.controls.update();
  }

  placeOverlap(a, b) {
    const shared = [0, 1, 2].map((k) => Math.max(a[k], b[k])).concat([3, 4, 5].map((k) => Math.min(a[k], b[k])));
    if ([0, 1, 2].some((k) => shared[k] > shared[k + 3])) return false;
    this.overlap.position.set(...[0, 1, 2].map((k) => (shared[k] + shared[k + 3]) / 2));
    const thinnest = 1e-7 * sizeOf(this.whole) || 1e-9; // a scale of zero has no inverse
    this.overlap.scale.set(...[0, 1, 2].map((k) => Math.max(shared[k + 3] - shared[k], thinnest)));
    this.place(this.overlapEdges, shared);
    return true;
  }

  /** Lines between the middles of pairs of models. */
  setLines(object, pairs) {
    const points = new Float32Array(6 * pairs.length);
    pairs.forEach((pair, p) => pair.forEach((model, end) => {
      const box = this.boxOf(model);
      for (let k = 0; k < 3; ++k) points[6 * p + 3 * end + k] = (box[k] + box[k + 3]) / 2;
    }));
    object.geometry.dispose();
    object.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(points, 3));
    object.visible = pairs.length > 0;
    this.invalidate();
  }

  /** Which axis points up: 1 to 3 for x to z, below 0 for the other way. Looks at everything again. */
  setUp(axis) {
    this.up = axis;
    const sign = Math.sign(axis);
    const unit = (k, length) => new Vector3().setComponent(k, length);
    const [right, ahead] = { 1: [unit(1, sign), unit(2, 1)], 2: [unit(0, sign), unit(2, -1)], 3: [unit(0, sign), unit(1, 1)] }[Math.abs(axis)];
    this.camera.up.copy(unit(Math.abs(axis) - 1, sign));
    this.ground.place(this.sight, this.data.origin, axis);
    this.controls?.dispose();
    this.controls = this.makeControls();
    const direction = right.multiplyScalar(0.75).sub(ahead).addScaledVector(this.camera.up, 0.65);
    this.lookAt(this.sight, direction);
  }

  makeControls() {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.zoomToCursor = true;
    controls.addEventListener("change", () => this.invalidate());
    controls.addEventListener("start", () => this.sharpness.hold(true));
    controls.addEventListener("end", () => this.sharpness.hold(false));
    return controls;
  }

  /** Moves the camera so that a box, six numbers, fills the picture; keeps its direction unless one is given. */
  lookAt(corners, direction = this.camera.position.clone().sub(this.controls.target)) {
    const wholeSize = sizeOf(this.whole) || 1;
    const slack = Math.max(1e-5 * wholeSize, 0.15 * sizeOf(corners)) / 2;
    const centre = new Vector3(...[0, 1, 2].map((k) => (corners[k] + corners[k + 3]) / 2));
    const back = direction.clone().normalize();
    const distance = this.distanceToFit(corners, centre, back) + slack;
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(back, distance);
    this.camera.near = Math.min(distance, wholeSize) / 500;
    this.camera.far = distance + 20 * wholeSize;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.invalidate();
  }

  /** Moves the camera as keys say: "turn" or "move" by steps to the right and up, "approach" by steps. */
  steer(how, ...steps) {
    ({ turn, move, approach })[how](this.camera, this.controls.target, ...steps);
    this.controls.update();
    this.invalidate();
  }

  /** How far from its centre the camera must be for all corners of a box to be in the picture. */
  distanceToFit(corners, centre, back) {
    const right = new Vector3().crossVectors(this.camera.up, back).normalize();
    const up = new Vector3().crossVectors(back, right);
    const slope = Math.tan((this.camera.fov * Math.PI) / 360) * 0.94;
    let distance = 0;
    for (let i = 0; i < 8; ++i) {
      const corner = new Vector3(...[0, 1, 2].map((k) => corners[k + (i >> k & 1 ? 3 : 0)])).sub(centre);
      const across = Math.max(Math.abs(corner.dot(right)) / this.camera.aspect, Math.abs(corner.dot(up)));
      distance = Math.max(distance, corner.dot(back) + across / slope);
    }
    return distance;
  }

  /** What a ray through a place of the window meets first, as pick() gives it, with the point; or null. */
  hitAt(clientX, clientY, isShown, onlyBoxes) {
    const area = this.canvas.getBoundingClientRect();
    const place = new Vector2(((clientX - area.left) / area.width) * 2 - 1, 1 - ((clientY - area.top) / area.height) * 2);
    const caster = new Raycaster();
    this.camera.updateMatrixWorld();
    caster.setFromCamera(place, this.camera);
    const ray = { origin: caster.ray.origin.toArray(), direction: caster.ray.direction.toArray() };
    const hit = pick({ ...ray, drawn: this.drawn, offsets: this.offsets, count: this.data.models, mesh: this.data.mesh, isShown, onlyBoxes, cut: this.shared.cut.value.toArray() });
    return hit && { ...hit, point: caster.ray.at(hit.distance, new Vector3()) };
  }

  /** Where a point of the scene is in the window: x and y in pixels. */
  pixelOf(point) {
    const area = this.canvas.getBoundingClientRect();
    const place = point.clone().project(this.camera);
    return [area.left + ((place.x + 1) / 2) * area.width, area.top + ((1 - place.y) / 2) * area.height];
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    if (this.size?.[0] === clientWidth && this.size[1] === clientHeight) return;
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.size = [clientWidth, clientHeight];
    this.invalidate();
  }

  /** Draws soon, once, and not before the last picture is done. */
  invalidate() {
    if (this.fence) this.isStale = true;
    else this.pending ??= requestAnimationFrame(() => this.draw());
  }

  /** The whole picture as the bytes of a PNG. */
  async picture() {
    if (this.fence) await new Promise((done) => this.addEventListener("drawn", done, { once: true }));
    cancelAnimationFrame(this.pending);
    this.sharpness.isFinal = true;
    this.draw();
    return new Promise((done) => this.canvas.toBlob(done)); // at once: what is drawn is kept until the browser has shown it
  }

  draw() {
    this.pending = undefined;
    if (!this.size) return;
    const scale = this.sharpness.next();
    this.isWhole = scale === 1;
    const ratio = Math.min(window.devicePixelRatio, 2) * Math.max(scale, 0.5);
    this.boxes.setDetail(this.data.models > manyModels ? scale * scale : 1);
    if (this.renderer.getPixelRatio() !== ratio || this.drawnSize !== this.size) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(...this.size, false);
      this.drawnSize = this.size;
    }
    const begin = performance.now();
    this.dispatchEvent(new Event("draws"));
    if (this.sharpness.isShaded) this.shade.prepare(this.renderer, this.scene, this.camera);
    else this.shade.hide();
    this.renderer.render(this.scene, this.camera);
    this.awaitGraphics(begin);
  }

  /** Browsers queue pictures; a slow renderer would lag behind the pointer by seconds. */
  awaitGraphics(begin) {
    const gl = this.renderer.getContext();
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      if (this.fence && gl.getSyncParameter(this.fence, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost()) return requestAnimationFrame(look);
      gl.deleteSync(this.fence);
      this.fence = null;
      this.sharpness.took(performance.now() - begin, this.shade.object.visible);
      this.dispatchEvent(new Event("drawn"));
      if (this.isWhole) this.dispatchEvent(new Event("complete"));
      if (this.isStale) this.invalidate();
      this.isStale = false;
    };
    requestAnimationFrame(look);
  }
}
