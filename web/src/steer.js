// SPDX-License-Identifier: MIT
// The camera moved by keys: around what it looks at, along the picture, nearer and farther.

import { Vector3 } from "three";

const turnStep = Math.PI / 36;
const moveStep = 0.05; // of the height of the picture
const zoomStep = 1.2;
const closestToPole = 0.02; // radians: at the pole itself no direction is up

/** Turns the camera around its target, to the right and up by steps. */
export function turn(camera, target, right, up) {
  const offset = camera.position.clone().sub(target);
  const polar = offset.angleTo(camera.up);
  const wanted = Math.min(Math.PI - closestToPole, Math.max(closestToPole, polar - up * turnStep));
  const axis = new Vector3().crossVectors(camera.up, offset).normalize();
  offset.applyAxisAngle(axis, wanted - polar).applyAxisAngle(camera.up, right * turnStep);
  camera.position.copy(target).add(offset);
}

/** Moves the camera and its target along the picture. */
export function move(camera, target, right, up) {
  const height = 2 * camera.position.distanceTo(target) * Math.tan((camera.fov * Math.PI) / 360);
  const back = camera.position.clone().sub(target).normalize();
  const across = new Vector3().crossVectors(camera.up, back).normalize();
  const step = across.clone().multiplyScalar(right).addScaledVector(new Vector3().crossVectors(back, across), up).multiplyScalar(moveStep * height);
  camera.position.add(step);
  target.add(step);
}

/** Brings the camera nearer to its target by steps, or with a negative number farther from it. */
export function approach(camera, target, steps) {
  camera.position.sub(target).multiplyScalar(zoomStep ** -steps).add(target);
}
