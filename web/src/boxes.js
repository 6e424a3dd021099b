// SPDX-License-Identifier: MIT
// All boxes in one draw without attributes or instances: the vertex shader makes each corner from the vertex's number
// and a texture that holds the boxes. Software renderers take an instance as a draw of its own, which would be a
// hundred thousand of them. Edges are found in the fragment shader, so that a box is twelve triangles and no line.

import { BufferAttribute, BufferGeometry, DataTexture, DoubleSide, FloatType, GLSL3, Mesh, NearestFilter, RGBAFormat, ShaderMaterial } from "three";
import { look, styleLookup } from "./styles.js";

const width = 2048; // texels; a box has two beside each other
const fineModels = 20_000; // of more, those that are faint are not drawn at all

const vertexShader = `
uniform highp sampler2D boxes;
uniform int count;
uniform int stride; // has no factor in common with count: any first part of the boxes is spread over all
uniform int faces;  // 6, or the 3 that the camera may see
uniform vec3 eye;
out vec2 face;
out float light;
flat out vec3 colour;
${styleLookup}
const vec2 corners[4] = vec2[4](vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1));
void main() {
  int perBox = 4 * faces;
  int model = int((uint(gl_VertexID / perBox) * uint(stride)) % uint(count));
  int corner = gl_VertexID % 4;
  int side = (gl_VertexID % perBox) / 4;
  uvec4 style = styleOf(float(model));
  ivec2 place = ivec2(2 * model % ${width}, 2 * model / ${width});
  vec3 low = texelFetch(boxes, place, 0).xyz;
  vec3 high = texelFetch(boxes, place + ivec2(1, 0), 0).xyz;
  int axis = side % 3;
  bool upper = faces == 3 ? eye[axis] > 0.5 * (low[axis] + high[axis]) : side < 3;
  face = corners[corner];
  vec3 p = low;
  p[axis] = upper ? high[axis] : low[axis];
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  p[u] = mix(low[u], high[u], face.x);
  p[v] = mix(low[v], high[v], face.y);
  light = axis == 0 ? 0.82 : axis == 1 ? 0.68 : 1.0;
  colour = colourOf(style, float(model));
  bool skip = isSkipped(style) || low.x > high.x;
  gl_Position = skip ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * modelViewMatrix * vec4(p, 1.0);
}`;

const fragmentShader = `
uniform float fill;     // opacity between the edges
uniform float edgeFill; // and on them
uniform bool solid;
in vec2 face;
in float light;
flat in vec3 colour;
out vec4 result;
void main() {
  vec2 distance = min(face, 1.0 - face) / max(fwidth(face), vec2(1e-6));
  float edge = 1.0 - smoothstep(0.6, 1.6, min(distance.x, distance.y));
  if (solid) {
    result = vec4(colour * light * mix(1.0, 0.55, edge), 1.0);
  } else {
    float opacity = mix(fill, edgeFill, edge);
    if (opacity < 0.004) discard;
    result = vec4(colour, opacity);
  }
}`;

const commonFactor = (a, b) => (b === 0 ? a : commonFactor(b, a % b));

/** A number near the golden section of `count` without a common factor with it, small enough for 32 bits. */
function strideOf(count) {
  let stride = Math.max(1, Math.min(Math.floor(count * 0.618), Math.floor(2 ** 32 / count) - 1));
  while (commonFactor(stride, count) !== 1) --stride;
  return stride;
}

/** The vertices of the two triangles of each face: four a face, so that each corner is computed once. */
function faceIndices(faces) {
  const indices = new Uint32Array(6 * faces);
  for (let face = 0, i = 0; face < faces; ++face) for (const corner of [0, 1, 2, 0, 2, 3]) indices[i++] = 4 * face + corner;
  return new BufferAttribute(indices, 1);
}

function textureOf(texels) {
  const texture = new DataTexture(texels, width, texels.length / 4 / width, RGBAFormat, FloatType);
  texture.magFilter = texture.minFilter = NearestFilter;
  return texture;
}

export class BoxCloud {
  constructor(count, shared) {
    this.count = count;
    this.texels = new Float32Array(4 * width * Math.max(1, Math.ceil((2 * count) / width)));
    this.texture = textureOf(this.texels);
    this.eye = { value: null };
    const uniforms = { ...shared, boxes: { value: this.texture }, count: { value: Math.max(1, count) }, stride: { value: strideOf(Math.max(1, count)) }, eye: this.eye };
    this.objects = [0, 1].map((pass) => this.makeObject(uniforms, pass));
    this.objects[0].renderOrder = 2;
    this.objects[1].renderOrder = 1;
    this.detail = 1;
    this.faces = 0; // of each box, that there are vertices for
  }

  makeObject(uniforms, pass) {
    const own = { pass: { value: pass }, faintBits: { value: look.faint }, fill: { value: 0 }, edgeFill: { value: 0.9 }, solid: { value: false }, faces: { value: 6 } };
    const material = new ShaderMaterial({ glslVersion: GLSL3, vertexShader, fragmentShader, uniforms: { ...uniforms, ...own }, transparent: true, depthWrite: false, side: DoubleSide });
    const object = new Mesh(new BufferGeometry(), material);
    object.frustumCulled = false;
    object.onBeforeRender = (renderer, scene, camera) => (this.eye.value = camera.position);
    return object;
  }

  /** "outlines", "solid" or "hidden"; and whether there are any that are faint. */
  setMode(mode, anyFaint) {
    const { material } = this.objects[0];
    const solid = mode === "solid";
    material.uniforms.solid.value = solid;
    material.uniforms.faces.value = solid ? 3 : 6;
    material.transparent = !solid;
    material.depthWrite = solid;
    material.needsUpdate = true;
    this.objects[0].visible = mode !== "hidden";
    this.objects[1].visible = mode !== "hidden" && anyFaint && this.count <= fineModels;
    for (const { visible, material: { uniforms } } of this.objects) if (visible) this.needFaces(uniforms.faces.value);
    this.setDetail(this.detail);
  }

  /** Makes the vertices for so many faces of each box, or more. */
  needFaces(faces) {
    if (this.faces >= faces) return;
    this.faces = faces;
    const indices = faceIndices(this.count * faces);
    for (const { geometry } of this.objects) geometry.dispose();
    for (const object of this.objects) object.geometry = new BufferGeometry().setIndex(indices);
  }

  /** How opaque faces are in outlines, and the edges of what is faint: less where many lie behind each other. */
  setFill(fill) {
    this.objects[0].material.uniforms.fill.value = fill;
    this.objects[1].material.uniforms.edgeFill.value = Math.max(0.03, 0.24 / Math.max(1, Math.sqrt(this.count / 150)));
  }

  /** Which part of the boxes is drawn, from 0 to 1. */
  setDetail(detail) {
    this.detail = detail;
    for (const { geometry, material } of this.objects) {
      geometry.setDrawRange(0, Math.ceil(this.count * detail) * 6 * material.uniforms.faces.value);
    }
  }

  /** Takes the boxes of a frame, already cut to what can be drawn; an empty one has min > max. */
  setBoxes(drawn) {
    for (let i = 0; i < this.count; ++i) {
      for (let k = 0; k < 3; ++k) {
        this.texels[8 * i + k] = drawn[6 * i + k];
        this.texels[8 * i + 4 + k] = drawn[6 * i + 3 + k];
      }
    }
    this.texture.needsUpdate = true;
  }
}
