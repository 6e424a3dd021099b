// SPDX-License-Identifier: MIT
// How each model is drawn, in a texture with one texel a model: its tone, and whether it is shown or faint. Boxes and
// meshes look it up by the model's index, so that a change costs one small upload however large the shapes are.

import { DataTexture, FloatType, NearestFilter, RGBAFormat, RGBAIntegerFormat, UnsignedByteType } from "three";

const width = 1024;

export const look = { shown: 1, faint: 2, ghost: 4 }; // a ghost's shape is faint, its box is not

/** How far each model is moved to be apart from the others, in a texture with one texel a model. */
export class ModelOffsets {
  constructor(count) {
    this.texels = new Float32Array(4 * width * Math.max(1, Math.ceil(count / width)));
    this.texture = new DataTexture(this.texels, width, this.texels.length / 4 / width, RGBAFormat, FloatType);
    this.texture.magFilter = this.texture.minFilter = NearestFilter;
  }

  of(model) {
    return this.texels.subarray(4 * model, 4 * model + 3);
  }
}

export class ModelStyles {
  /** `bodyOf` says what each model is a part of: parts of one body have one colour where each body has its own. */
  constructor(count, bodyOf) {
    const height = Math.max(1, Math.ceil(count / width));
    this.texels = new Uint8Array(4 * width * height);
    this.texture = new DataTexture(this.texels, width, height, RGBAIntegerFormat, UnsignedByteType);
    this.texture.internalFormat = "RGBA8UI";
    this.texture.magFilter = this.texture.minFilter = NearestFilter;
    for (let i = 0; i < count; ++i) this.texels[4 * i + 2] = (256 * (0.61803 * bodyOf(i) + 0.55)) % 256; // neighbours are far apart
    this.update();
  }

  set(model, tone, flags) {
    this.texels[4 * model] = tone;
    this.texels[4 * model + 1] = flags;
  }

  isFaint(model) {
    return (this.texels[4 * model + 1] & (look.faint | look.ghost)) !== 0;
  }

  update() {
    this.texture.needsUpdate = true;
  }
}

/** What both vertex shaders begin with. */
export const styleLookup = `
uniform highp usampler2D styles;
uniform vec3 palette[11];
uniform int pass; // 0: what is solid, 1: what is faint
uniform uint faintBits;
ivec2 texelOf(float model) {
  int i = int(model + 0.5);
  return ivec2(i % ${width}, i / ${width});
}
uvec4 styleOf(float model) { return texelFetch(styles, texelOf(model), 0); }
bool isSkipped(uvec4 style) {
  bool faint = (style.g & faintBits) != 0u;
  return (style.g & 1u) == 0u || faint != (pass == 1);
}
vec3 colourOf(uvec4 style, float model) {
  float shade = 0.92 + 0.16 * fract(sin(model * 12.9898) * 43758.5453);
  return palette[int(style.r)] * (style.r < 5u ? shade : 1.0);
}`;
