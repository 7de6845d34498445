// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Many bodies as one plain mesh whose corners are computed here. Software GL draws instances one by
// one, four times slower.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from './libraries.js';

// Corners in body axes (x forward, y right, z down) for a radius of 1; each face with its share of
// the light.
const SHAPES = {
  land: [[[1.2, 0, 0], [-0.8, 0.75, 0], [-0.45, 0, 0], [-0.8, -0.75, 0], [-0.3, 0, -0.42]],
    [[0, 1, 4, 0.82], [1, 2, 4, 0.55], [2, 3, 4, 0.62], [3, 0, 4, 1]]],
  air: [[[1.4, 0, 0], [-0.9, 1.25, 0.05], [-0.5, 0, -0.1], [-0.9, -1.25, 0.05], [-0.9, 0, -0.5]],
    [[0, 1, 2, 0.8], [0, 2, 3, 1], [0, 2, 4, 0.6]]],
  surface: [[[1.6, 0, 0], [0.5, 0.45, 0], [-1.2, 0.4, 0], [-1.2, -0.4, 0], [0.5, -0.45, 0], [-0.2, 0, -0.5]],
    [[0, 1, 5, 0.8], [1, 2, 5, 0.7], [2, 3, 5, 0.55], [3, 4, 5, 0.9], [4, 0, 5, 1]]],
  life: [[[0.5, 0, -0.5], [-0.3, 0.45, -0.5], [-0.3, -0.45, -0.5], [0, 0, -1.4], [0, 0, 0]],
    [[0, 1, 3, 0.85], [1, 2, 3, 0.7], [2, 0, 3, 1], [0, 1, 4, 0.6], [1, 2, 4, 0.5], [2, 0, 4, 0.7]]],
  other: [[[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, -1], [0, 0, 1]],
    [[0, 1, 4, 0.9], [1, 2, 4, 0.75], [2, 3, 4, 0.85], [3, 0, 4, 1], [0, 1, 5, 0.6], [1, 2, 5, 0.5], [2, 3, 5, 0.55], [3, 0, 5, 0.65]]],
};

export function shapeOf(kind, haptic) {
  if (haptic) return SHAPES.other;
  const words = String(kind ?? '');
  if (/life/.test(words)) return SHAPES.life;
  if (/munition|air|space/.test(words)) return SHAPES.air;
  if (/surface|sea|ship/.test(words)) return SHAPES.surface;
  return /land|platform/.test(words) ? SHAPES.land : SHAPES.other;
}

export class Bodies {
  constructor(group, material) {
    this.geometry = new BufferGeometry();
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.corner = new Float32Array(24);
    this.room(0);
    group.add(this.mesh);
  }

  room(faces) {
    this.geometry.dispose();
    this.at = new Float32Array(9 * faces);
    this.tint = new Float32Array(9 * faces);
    for (const [name, values] of [['position', this.at], ['color', this.tint]]) {
      this.geometry.setAttribute(name, new BufferAttribute(values, 3).setUsage(DynamicDrawUsage));
    }
  }

  // Sets the shapes, in the order of the bodies; colours() has to follow.
  shape(shapes) {
    this.shapes = shapes;
    const faces = shapes.reduce((sum, shape) => sum + shape[1].length, 0);
    if (9 * faces > this.at.length) this.room(Math.ceil(1.2 * faces));
    this.geometry.setDrawRange(0, 3 * faces);
    this.floats = 9 * faces;
  }

  begin(anchor) {
    this.write = 0;
    this.mesh.position.copy(anchor);
  }

  // Writes body i at a place, rotated by a unit quaternion; calls come in order of i.
  set(i, x, y, z, turns, scale) {
    const { corner, at } = this;
    const anchor = this.mesh.position;
    const [corners, faces] = this.shapes[i];
    const w = turns[4 * i];
    const q0 = turns[4 * i + 1];
    const q1 = turns[4 * i + 2];
    const q2 = turns[4 * i + 3];
    for (let k = 0; k < corners.length; ++k) {
      const a = corners[k][0] * scale;
      const b = corners[k][1] * scale;
      const c = corners[k][2] * scale;
      const tx = 2 * (q1 * c - q2 * b);
      const ty = 2 * (q2 * a - q0 * c);
      const tz = 2 * (q0 * b - q1 * a);
      corner[3 * k] = x - anchor.x + a + w * tx + q1 * tz - q2 * ty;
      corner[3 * k + 1] = y - anchor.y + b + w * ty + q2 * tx - q0 * tz;
      corner[3 * k + 2] = z - anchor.z + c + w * tz + q0 * ty - q1 * tx;
    }
    let o = this.write;
    for (const face of faces) {
      for (let k = 0; k < 3; ++k) {
        const from = 3 * face[k];
        at[o++] = corner[from];
        at[o++] = corner[from + 1];
        at[o++] = corner[from + 2];
      }
    }
    this.write = o;
  }

  end() { this.send(this.geometry.attributes.position); }

  // Sets the colour of each body i to `colourOf(i)`.
  colours(colourOf) {
    let o = 0;
    this.shapes.forEach(([, faces], i) => {
      const { r, g, b } = colourOf(i);
      for (const [, , , light] of faces) {
        for (let k = 0; k < 3; ++k) {
          this.tint[o++] = r * light;
          this.tint[o++] = g * light;
          this.tint[o++] = b * light;
        }
      }
    });
    this.send(this.geometry.attributes.color);
  }

  send(attribute) {
    attribute.clearUpdateRanges();
    attribute.addUpdateRange(0, this.floats);
    attribute.needsUpdate = true;
  }
}

// Of an entity of unknown size: a metre, or less in a small scene.
export function sizeOf(moment, view, row) { return moment.radiusOf(row) ?? Math.min(1, 0.04 * (view.extent?.radius ?? 25)); }

// Least drawn size of a body is some pixels, so that a vehicle is visible in a picture of
// kilometres.
export function leastScale(view) {
  const { position } = view.orbit.camera;
  const share = 5 / Math.max(200, view.rectangle.height);
  return (x, y, z, radius) => Math.max(radius, share * Math.hypot(x - position.x, y - position.y, z - position.z));
}
