// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Many bodies as one plain mesh whose corners are computed here. Software GL draws instances one by
// one, four times slower.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from './libraries.js';

// Corners in body axes (x forward, y right, z down) for a radius of 1; each face with its share of
// the light. These are drawn where there are many, and of what can be felt.
const PLAIN = {
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
PLAIN.subsurface = PLAIN.surface;
PLAIN.munition = PLAIN.air;
PLAIN.haptic = PLAIN.other;

// A right side, mirrored to the left: a closed outline from nose to tail.
function outline(side) { return [...side, ...side.filter(([, y]) => y > 0).reverse().map(([x, y]) => [x, -y])]; }

// A prism over an outline, with a roof that may be smaller and set back; around its middle, since
// outlines need not be convex.
function prism(points, bottom, top, roof = 1, back = 0, light = 1) {
  const count = points.length;
  const middle = points.reduce((sum, [x]) => sum + x / count, 0);
  const low = points.map(([x, y]) => [x, y, -bottom]);
  const high = points.map(([x, y]) => [middle + (x - middle) * roof + back, y * roof, -top]);
  const faces = points.flatMap((_, i) => {
    const j = (i + 1) % count;
    const [dx, dy] = [points[j][0] - points[i][0], points[j][1] - points[i][1]];
    const side = light * (0.6 - (0.14 * (dx + 0.6 * dy)) / (Math.hypot(dx, dy) || 1)); // the light comes from the front left
    return [[i, j, count + j, side], [i, count + j, count + i, side], [count + i, count + j, 2 * count, light]];
  });
  return [[...low, ...high, [middle + back, 0, -top]], faces];
}

function joined(...parts) {
  const corners = [];
  const faces = parts.flatMap(([own, of]) => {
    const first = corners.length;
    corners.push(...own);
    return of.map(([a, b, c, light]) => [a + first, b + first, c + first, light]);
  });
  return [corners, faces];
}

// Drawn where there are few: length 2 with the nose at 1, or a height of 2.
const DETAILED = {
  land: joined(prism(outline([[1, 0], [0.45, 0.54], [-1, 0.54]]), 0.06, 0.4, 0.94), prism(outline([[0.12, 0.42], [-0.88, 0.42]]), 0.4, 0.74, 0.84, -0.03, 0.64)),
  air: joined(prism(outline([[1, 0], [0.62, 0.13], [-0.7, 0.11], [-1, 0.03]]), -0.04, 0.16, 0.9), prism(outline([[0.28, 0], [-0.28, 1], [-0.52, 1], [-0.4, 0]]), 0, 0.06, 0.97, 0, 0.9),
    prism(outline([[-0.68, 0], [-0.88, 0.42], [-1, 0.42], [-0.94, 0]]), 0, 0.06, 0.97, 0, 0.9), prism(outline([[-0.66, 0.03], [-0.98, 0.03]]), 0.1, 0.42, 0.7, -0.05, 0.76)),
  surface: joined(prism(outline([[1, 0], [0.55, 0.2], [-0.85, 0.22], [-1, 0.15]]), 0, 0.14, 1.05), prism(outline([[0.2, 0.12], [-0.5, 0.14]]), 0.14, 0.34, 0.86, -0.02, 0.8),
    prism(outline([[0.02, 0.06], [-0.2, 0.06]]), 0.34, 0.52, 0.7, 0, 0.66)),
  subsurface: joined(prism(outline([[1, 0], [0.88, 0.13], [0.55, 0.19], [-0.5, 0.17], [-1, 0.04]]), -0.1, 0.16, 0.72), prism(outline([[-0.78, 0], [-0.9, 0.26], [-1, 0.26], [-0.98, 0]]), 0, 0.06, 0.97, 0, 0.84),
    prism(outline([[0.44, 0], [0.34, 0.06], [0.06, 0.05]]), 0.16, 0.42, 0.86, 0, 0.72)),
  life: joined(prism(outline([[0.2, 0], [0.1, 0.3], [-0.16, 0.3]]), 0, 1.45, 1.15), prism(outline([[0.34, 0], [0.06, 0.24], [-0.2, 0.16]]), 1.5, 2, 0.8, 0, 0.86)),
  munition: joined(prism(outline([[1, 0], [0.7, 0.13], [-0.96, 0.13]]), -0.08, 0.14, 0.7), prism(outline([[-0.55, 0], [-0.86, 0.4], [-1, 0.4], [-0.98, 0]]), 0, 0.06, 0.97, 0, 0.84)),
  other: PLAIN.other,
  haptic: PLAIN.haptic,
};
const CORNER_ROOM = Math.max(...[...Object.values(PLAIN), ...Object.values(DETAILED)].map(([corners]) => corners.length));

// Half of the usual length of each kind [m], since DIS has none.
const NOMINAL = { land: 2.3, air: 8, surface: 50, subsurface: 40, life: 0.9, munition: 2, other: 1, haptic: 1 };

function classOf(kind, haptic) {
  if (haptic) return 'haptic';
  const words = String(kind ?? '');
  if (/life/.test(words)) return 'life';
  if (/munition/.test(words)) return 'munition';
  if (/subsurface/.test(words)) return 'subsurface';
  if (/surface/.test(words)) return 'surface';
  if (/air|space/.test(words)) return 'air';
  return /land|platform/.test(words) ? 'land' : 'other';
}

export function shapeOf(kind, haptic, detailed) { return (detailed ? DETAILED : PLAIN)[classOf(kind, haptic)]; }
export function nominalRadius(row) { return NOMINAL[classOf(row?.kind, row?.haptic)]; }

export class Bodies {
  constructor(group, material) {
    this.geometry = new BufferGeometry();
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.corner = new Float32Array(3 * CORNER_ROOM);
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

  // The drawn corners of body i.
  cornersOf(i) {
    if (!this.shapes?.[i]) return [];
    const first = 9 * this.shapes.slice(0, i).reduce((sum, [, faces]) => sum + faces.length, 0);
    const { x, y, z } = this.mesh.position;
    const corners = [];
    for (let o = first; o < first + 9 * this.shapes[i][1].length; o += 3) corners.push([x + this.at[o], y + this.at[o + 1], z + this.at[o + 2]]);
    return corners;
  }

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

// Of an entity of unknown size: the usual one of its kind, or a metre; less in a small scene.
export function sizeOf(moment, view, row) {
  const known = moment.radiusOf(row);
  if (known) return known;
  const reach = view.extent?.radius ?? 25;
  return row?.kind && moment.exercise ? Math.min(nominalRadius(row), 0.1 * reach) : Math.min(1, 0.04 * reach);
}

const FEW_SYMBOLS = 60; // these are larger, and have their details
const SYMBOL = 12; // [pixels], least radius of one of few
const SYMBOL_OF_SOME = 10; // of one of more than 20
const SMALL = 7.7; // of one of many, or in the inset

// Least radius of a symbol of few [pixels]; 0 if there are many.
export function fewSymbols(moment, view) {
  if (!moment.exercise || moment.count > FEW_SYMBOLS || view.rectangle.width <= 300) return 0;
  return moment.count > 20 ? SYMBOL_OF_SOME : SYMBOL;
}

// Least drawn size of a body is some pixels, so that a vehicle is visible in a picture of
// kilometres.
export function leastScale(view) {
  const { few } = view;
  const { position, fov } = view.orbit.camera;
  const { height } = view.rectangle;
  const share = ((few || SMALL * Math.min(1, height / 200)) * 2 * Math.tan((fov * Math.PI) / 360)) / height;
  return (x, y, z, radius) => Math.max(radius, share * Math.hypot(x - position.x, y - position.y, z - position.z));
}
