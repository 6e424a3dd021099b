// SPDX-License-Identifier: MIT
// Solid parts as parts and not as one lump: corners and gaps are darker, and a line is drawn where one part ends before another.
// Both come from a picture of how far everything is, made beforehand, and are drawn over the shapes in one pass.

import { BufferAttribute, BufferGeometry, DepthTexture, GLSL3, Mesh, NearestFilter, ShaderMaterial, WebGLRenderTarget } from "three";

export const solidLayer = 1; // what casts shade: shapes that are not faint

const vertexShader = `
out vec2 at;
void main() {
  at = 0.5 * position.xy + 0.5;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

// Occlusion after McGuire and others, "The Alchemy Screen-Space Ambient Obscurance Algorithm" (2011): of points around one on the
// screen, those in front of its surface darken it, less the farther they are.
const fragmentShader = `
uniform sampler2D depths;
uniform sampler2D colours; // one a body
uniform vec2 size;         // in pixels
uniform vec2 slope;        // of the borders of the picture, across and up
uniform vec2 range;        // from where to where there is something to see
uniform float pixel;       // how many of the picture's are one on the screen
in vec2 at;
out vec4 result;
const int taps = 20;
float farAt(vec2 p) {
  float depth = textureLod(depths, p, 0.0).r;
  return range.x * range.y / (range.y - depth * (range.y - range.x));
}
vec3 placeAt(vec2 p) {
  float far = farAt(p);
  return vec3((2.0 * p - 1.0) * slope * far, -far);
}
float occlusion(vec3 place, vec3 normal) {
  float reach = 26.0 * pixel; // pixels
  float perPixel = 2.0 * slope.y * -place.z / size.y;
  float near = reach * perPixel;
  float turn = 6.2832 * fract(52.9829 * fract(dot(gl_FragCoord.xy, vec2(0.06711, 0.00584))));
  float sum = 0.0;
  for (int i = 0; i < taps; ++i) {
    float part = (float(i) + 0.5) / float(taps);
    float angle = turn + float(i) * 2.39996;
    vec2 p = at + reach * part * vec2(cos(angle), sin(angle)) / size;
    vec3 way = placeAt(p) - place;
    float square = dot(way, way);
    float above = max(0.0, dot(way, normal) - 0.02 * near);
    sum += above * smoothstep(4.0 * near * near, 0.0, square) / (square / near + 0.1 * near);
  }
  return min(1.0, 1.6 * sum / float(taps));
}
float outline(float far) {
  vec2 step = pixel / size;
  float most = 0.0;
  vec3 own = textureLod(colours, at, 0.0).rgb;
  for (int axis = 0; axis < 2; ++axis) {
    vec2 way = axis == 0 ? vec2(step.x, 0.0) : vec2(0.0, step.y);
    float a = farAt(at - way);
    float b = farAt(at + way);
    float bend = 2.0 - far / a - far / b; // 0 on a plane, positive where something ends before another
    most = max(most, smoothstep(0.015, 0.04, bend));
    vec3 change = abs(textureLod(colours, at + way, 0.0).rgb - own);
    most = max(most, smoothstep(0.04, 0.08, max(change.r, max(change.g, change.b))));
  }
  return most;
}
void main() {
  float depth = textureLod(depths, at, 0.0).r;
  if (depth >= 1.0) discard;
  vec3 place = placeAt(at);
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  float dark = max(0.75 * occlusion(place, normal), 0.55 * outline(-place.z));
  result = vec4(vec3(0.05), dark);
}`;

export class Shade {
  /** `shapes` are the meshes that are solid. */
  constructor(shapes) {
    this.shapes = shapes;
    for (const shape of shapes) shape.layers.enable(solidLayer);
    const uniforms = { depths: { value: null }, colours: { value: null }, size: { value: [1, 1] }, slope: { value: [1, 1] }, range: { value: [0, 1] }, pixel: { value: 1 } };
    const material = new ShaderMaterial({ glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, transparent: true, depthTest: false, depthWrite: false });
    const corners = new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3);
    this.object = new Mesh(new BufferGeometry().setAttribute("position", corners), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 0.5; // after what is solid, before what is faint
    this.object.visible = false;
  }

  /** Makes the picture of depths that the pass is drawn from, where there is something solid. */
  prepare(renderer, scene, camera) {
    this.object.visible = this.shapes.some((shape) => shape.visible);
    if (!this.object.visible) return;
    const { width, height } = renderer.domElement;
    if (this.target?.width !== width || this.target.height !== height) this.renew(width, height);
    const background = scene.background;
    const setLit = (isLit) => this.shapes.forEach((shape) => (shape.material.uniforms.lit.value = isLit));
    setLit(false);
    scene.background = null;
    camera.layers.set(solidLayer);
    renderer.setRenderTarget(this.target);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    camera.layers.set(0);
    scene.background = background;
    setLit(true);
    this.setView(camera, width, height, renderer.getPixelRatio());
  }

  renew(width, height) {
    this.target?.depthTexture.dispose();
    this.target?.dispose();
    this.target = new WebGLRenderTarget(width, height, { depthTexture: new DepthTexture(width, height), minFilter: NearestFilter, magFilter: NearestFilter });
  }

  setView(camera, width, height, ratio) {
    const { uniforms } = this.object.material;
    const up = Math.tan((camera.fov * Math.PI) / 360);
    uniforms.depths.value = this.target.depthTexture;
    uniforms.colours.value = this.target.texture;
    uniforms.size.value = [width, height];
    uniforms.slope.value = [up * camera.aspect, up];
    uniforms.range.value = [camera.near, camera.far];
    uniforms.pixel.value = ratio;
  }

  hide() {
    this.object.visible = false;
  }
}
