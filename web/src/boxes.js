// SPDX-License-Identifier: MIT
// All boxes as one instanced draw. Edges are found in the fragment shader, so that a box is twelve triangles and no line.

import { BoxGeometry, DoubleSide, FrontSide, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial } from "three";
import { styleLookup } from "./styles.js";

const vertexShader = `
in vec3 centre;
in vec3 halfSize;
in float model;
out vec2 face;
out vec3 where;
flat out vec3 colour;
${styleLookup}
void main() {
  uvec4 style = styleOf(model);
  face = uv;
  colour = colourOf(style, model);
  vec4 p = modelViewMatrix * vec4(centre + position * halfSize, 1.0);
  where = p.xyz;
  bool skip = isSkipped(style) || halfSize.x < 0.0;
  gl_Position = skip ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * p;
}`;

const fragmentShader = `
uniform float fill;     // opacity between the edges
uniform float edgeFill; // and on them
uniform bool solid;
in vec2 face;
in vec3 where;
flat in vec3 colour;
out vec4 result;
void main() {
  vec2 distance = min(face, 1.0 - face) / max(fwidth(face), vec2(1e-6));
  float edge = 1.0 - smoothstep(0.6, 1.6, min(distance.x, distance.y));
  vec3 normal = normalize(cross(dFdx(where), dFdy(where)));
  float light = 0.55 + 0.45 * abs(normal.z);
  if (solid) {
    result = vec4(colour * light * mix(1.0, 0.55, edge), 1.0);
  } else {
    float opacity = mix(fill, edgeFill, edge);
    if (opacity < 0.004) discard;
    result = vec4(colour, opacity);
  }
}`;

function material(uniforms, options) {
  return new ShaderMaterial({ glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, ...options });
}

export class BoxCloud {
  constructor(count, shared) {
    this.count = count;
    const cube = new BoxGeometry(2, 2, 2);
    this.geometry = new InstancedBufferGeometry();
    this.geometry.index = cube.index;
    this.geometry.setAttribute("position", cube.attributes.position);
    this.geometry.setAttribute("uv", cube.attributes.uv);
    this.centres = new InstancedBufferAttribute(new Float32Array(3 * count), 3);
    this.halves = new InstancedBufferAttribute(new Float32Array(3 * count), 3);
    const numbers = Float32Array.from({ length: count }, (_, i) => i);
    this.geometry.setAttribute("centre", this.centres);
    this.geometry.setAttribute("halfSize", this.halves);
    this.geometry.setAttribute("model", new InstancedBufferAttribute(numbers, 1));
    this.geometry.instanceCount = count;
    this.main = material({ ...shared, pass: { value: 0 }, fill: { value: 0.1 }, edgeFill: { value: 0.9 }, solid: { value: false } });
    this.faint = material({ ...shared, pass: { value: 1 }, fill: { value: 0 }, edgeFill: { value: 0.22 }, solid: { value: false } });
    for (const part of [this.main, this.faint]) {
      part.transparent = true;
      part.depthWrite = false;
      part.side = DoubleSide;
    }
    this.objects = [new Mesh(this.geometry, this.main), new Mesh(this.geometry, this.faint)];
    for (const object of this.objects) object.frustumCulled = false;
    this.objects[0].renderOrder = 2;
    this.objects[1].renderOrder = 1;
  }

  /** "outlines", "solid" or "hidden". */
  setMode(mode) {
    const solid = mode === "solid";
    this.main.uniforms.solid.value = solid;
    this.main.transparent = !solid;
    this.main.depthWrite = solid;
    this.main.side = solid ? FrontSide : DoubleSide;
    this.main.needsUpdate = true;
    for (const object of this.objects) object.visible = mode !== "hidden";
  }

  /** How opaque faces are in outlines: less where many lie behind each other. */
  setFill(fill) {
    this.main.uniforms.fill.value = fill;
  }

  /** Takes the boxes of a frame, already cut to what can be drawn; a box that is not drawn has a negative half size. */
  setBoxes(drawn) {
    for (let i = 0; i < this.count; ++i) {
      for (let k = 0; k < 3; ++k) {
        this.centres.array[3 * i + k] = (drawn[6 * i + k] + drawn[6 * i + 3 + k]) / 2;
        this.halves.array[3 * i + k] = (drawn[6 * i + 3 + k] - drawn[6 * i + k]) / 2;
      }
    }
    this.centres.needsUpdate = this.halves.needsUpdate = true;
  }
}
