// SPDX-License-Identifier: MIT
// A sequence of meshes: the models are triangles, each frame has the places of the vertices, and all else is made from
// those when a frame is shown.

/** One frame; its boxes are those of the triangles. Only the frame that was asked last keeps them. */
class MeshFrame {
  constructor(sequence, index, parts) {
    Object.assign(this, parts);
    this.sequence = sequence;
    this.index = index;
  }

  get boxes() {
    return this.sequence.boxesOf(this);
  }
}

export class MeshSequence {
  constructor(corners, positions, frames) {
    this.corners = corners;
    const size = positions.length / frames;
    this.positionsOf = (index) => positions.subarray(size * index, size * (index + 1));
    this.positions = positions;
  }

  frame(index, parts) {
    return new MeshFrame(this, index, parts);
  }

  boxesOf(frame) {
    if (this.current !== frame) {
      this.boxes = boxesOf(this.corners, this.positionsOf(frame.index));
      this.current = frame;
    }
    return this.boxes;
  }

  /** The shape to draw: three vertices of its own for each triangle, because each has a colour. */
  mesh() {
    const { length } = this.corners;
    const none = new Uint32Array(length / 3);
    const ends = Uint32Array.from(none, (_, i) => 3 * (i + 1));
    const triangles = Uint32Array.from({ length }, (_, i) => i);
    const empty = new Uint32Array(0);
    return { vertices: new Float32Array(3 * length), triangles, triangleEnds: ends, lines: empty, lineEnds: none, points: empty, pointEnds: none };
  }

  /** Moves the vertices of the shape to where they are in a frame, from the scene's origin. */
  place(vertices, index, origin) {
    const from = this.positionsOf(index);
    const { corners } = this;
    for (let i = 0; i < corners.length; ++i) {
      for (let k = 0; k < 3; ++k) vertices[3 * i + k] = from[3 * corners[i] + k] - origin[k];
    }
  }

  /** Whether two triangles have a vertex in common. */
  shareVertex(a, b) {
    const ofB = this.corners.subarray(3 * b, 3 * b + 3);
    return this.corners.subarray(3 * a, 3 * a + 3).some((corner) => ofB.includes(corner));
  }
}

function boxesOf(corners, positions) {
  const boxes = new Float64Array(2 * corners.length);
  for (let i = 0; i < corners.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = positions[3 * corners[i] + k];
      const b = positions[3 * corners[i + 1] + k];
      const c = positions[3 * corners[i + 2] + k];
      boxes[2 * i + k] = Math.min(a, b, c);
      boxes[2 * i + 3 + k] = Math.max(a, b, c);
    }
  }
  return boxes;
}
