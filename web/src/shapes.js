// SPDX-License-Identifier: MIT
// The meshes of all models, drawn together: triangles, lines and points that look their colour up by model.

import { BufferAttribute, BufferGeometry, DoubleSide, GLSL3, LineSegments, Mesh, Points, ShaderMaterial } from "three";
import { look, styleLookup } from "./styles.js";

const vertexShader = `
in float model;
uniform highp sampler2D offsets; // how far each model is moved to be apart from the others
uniform bool exploded;
uniform bool calm;     // each model has a colour of its own, since what clashes is shown by where
uniform float neutral; // how much of grey is in the colour of a shape, so that boxes stand out
out vec3 where;
out vec3 place;
flat out vec3 colour;
${styleLookup}
vec3 calmColour(float hue) {
  float turn = 6.2832 * hue / 256.0;
  return vec3(0.62) + 0.13 * cos(vec3(turn, turn - 2.094, turn + 2.094)) + 0.06 * sin(7.0 * hue);
}
void main() {
  uvec4 style = styleOf(model);
  colour = mix(colourOf(style, model), vec3(0.72), style.r < 5u ? neutral : 0.1);
  if (calm && style.r < 5u) colour = calmColour(float(style.b));
  vec3 moved = exploded ? position + texelFetch(offsets, texelOf(model), 0).xyz : position;
  vec4 p = modelViewMatrix * vec4(moved, 1.0);
  where = p.xyz;
  place = position;
  gl_PointSize = 3.0;
  gl_Position = isSkipped(style) ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * p;
}`;

const fragmentShader = `
uniform float opacity;
uniform bool lit;
uniform vec4 cut; // what lies beyond this plane is not drawn
in vec3 where;
in vec3 place;
flat in vec3 colour;
out vec4 result;
void main() {
  if (dot(place, cut.xyz) > cut.w) discard;
  float light = 1.0;
  if (lit) {
    vec3 normal = normalize(cross(dFdx(where), dFdy(where)));
    light = 0.5 + 0.5 * abs(dot(normal, normalize(vec3(0.3, 0.45, 0.85))));
  }
  result = vec4(colour * light, opacity);
}`;

/** The model of each vertex, from where each model's indices end. */
function modelsOfVertices(mesh) {
  const models = new Float32Array(mesh.vertices.length / 3);
  for (const [indices, ends] of [[mesh.triangles, mesh.triangleEnds], [mesh.lines, mesh.lineEnds], [mesh.points, mesh.pointEnds]]) {
    let begin = 0;
    for (let model = 0; model < ends.length; ++model) {
      for (let i = begin; i < ends[model]; ++i) models[indices[i]] = model;
      begin = ends[model];
    }
  }
  return models;
}

function materialOf(shared, pass, lit) {
  const faint = pass === 1;
  const uniforms = { ...shared, pass: { value: pass }, faintBits: { value: look.faint | look.ghost }, opacity: { value: faint ? (shared.calm.value ? 0.07 : 0.1) : 1 }, lit: { value: lit }, neutral: { value: lit ? 0.45 : 0 } };
  return new ShaderMaterial({
    glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, side: DoubleSide,
    transparent: faint, depthWrite: !faint, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
}

/** The objects to draw, none where there are only boxes. */
export function makeShapes(mesh, shared) {
  if (mesh.vertices.length === 0) return [];
  const positions = new BufferAttribute(mesh.vertices, 3);
  const models = new BufferAttribute(modelsOfVertices(mesh), 1);
  const parts = [[Mesh, mesh.triangles, true], [LineSegments, mesh.lines, false], [Points, mesh.points, false]];
  const objects = [];
  for (const [Kind, indices, lit] of parts) {
    if (indices.length === 0) continue;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", positions);
    geometry.setAttribute("model", models);
    geometry.setIndex(new BufferAttribute(indices, 1));
    for (const pass of [0, 1]) {
      const object = new Kind(geometry, materialOf(shared, pass, lit));
      object.frustumCulled = false;
      object.renderOrder = pass;
      objects.push(object);
    }
  }
  return objects;
}
