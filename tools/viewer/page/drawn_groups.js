// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The members received recently in one near or contact group: an outline around them, in the colour
// of that group.
import { BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, Mesh, MeshBasicMaterial, Vector3 } from './libraries.js';
import { leastScale, sizeOf } from './bodies.js';
import { colour } from './colours.js';
import { hull } from './hull.js';

const MOST_GROUPS = 48;
const MOST_MEMBERS = 200; // of a group
const CORNERS = 12; // of the circle around one member
const MARGIN = 7; // [pixels] between a body and the outline
const MOST_PIECES = 4096; // pieces of outlines
const WIDTHS = { near: 1.2, contact: 2.6 }; // [pixels]

function drawnGroup(name, tier, says) {
  return { name, view: 'world', says, mark: `outline ${tier}`, make(group, view) { return new Groups(group, view, tier); } };
}

export const drawnGroups = drawnGroup('near groups', 'near', 'share a near group');
export const drawnContactGroups = drawnGroup('contact groups', 'contact', 'share a contact group');

class Groups {
  constructor(group, view, tier) {
    Object.assign(this, { view, tier });
    this.at = new Float32Array(18 * MOST_PIECES);
    this.tint = new Float32Array(18 * MOST_PIECES);
    this.geometry = new BufferGeometry();
    for (const [name, values] of [['position', this.at], ['color', this.tint]]) {
      this.geometry.setAttribute(name, new BufferAttribute(values, 3).setUsage(DynamicDrawUsage));
    }
    const material = new MeshBasicMaterial({ vertexColors: true, depthTest: false, transparent: true, opacity: 0.85, side: DoubleSide });
    this.lines = new Mesh(this.geometry, material);
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 1;
    group.add(this.lines);
    this.corner = new Vector3();
  }

  // Neighbours in the scene's numbering have different lightness.
  paint() {
    const [own, sky] = [colour(this.tier), colour('sky')];
    this.shades = [0, 0.14, 0.28].map((share) => own.clone().lerp(sky, share));
  }

  update(moment) {
    this.written = 0;
    this.lines.position.copy(this.view.orbit.anchor);
    for (const { tier, group, slots } of moment.groups.groups.slice(0, MOST_GROUPS)) {
      if (tier === this.tier) this.outline(this.around(moment, slots), this.shades[group % this.shades.length]);
    }
    this.geometry.setDrawRange(0, 6 * this.written);
    for (const attribute of Object.values(this.geometry.attributes)) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, 18 * this.written);
      attribute.needsUpdate = true;
    }
  }

  // Circles around the members, in pixels of the picture; members behind the camera are omitted.
  around(moment, slots) {
    const { width, height } = this.view.rectangle;
    const scale = leastScale(this.view);
    const points = [];
    for (const slot of slots.slice(0, MOST_MEMBERS)) {
      const i = moment.picture.indexOf(slot);
      if (i < 0) continue;
      const place = [...moment.shown.subarray(3 * i, 3 * i + 3)];
      const radius = MARGIN + this.view.pixels(scale(...place, sizeOf(moment, this.view, moment.roster.get(slot))), place);
      this.corner.fromArray(place).project(this.view.orbit.camera);
      if (Math.abs(this.corner.z) > 1) continue;
      const [x, y] = [(this.corner.x * width) / 2, (this.corner.y * height) / 2];
      for (let k = 0; k < CORNERS; ++k) {
        const angle = (2 * Math.PI * k) / CORNERS;
        points.push([x + radius * Math.cos(angle), y + radius * Math.sin(angle)]);
      }
    }
    return hull(points);
  }

  outline(points, shade) {
    const half = WIDTHS[this.tier] / 2;
    points.forEach(([x, y], i) => {
      if (this.written >= MOST_PIECES) return;
      const [u, v] = points[(i + 1) % points.length];
      const length = Math.hypot(u - x, v - y) || 1;
      const [dx, dy] = [(half * (v - y)) / length, (half * (x - u)) / length];
      const corners = [[x - dx, y - dy], [x + dx, y + dy], [u + dx, v + dy], [u - dx, v - dy]];
      [0, 1, 2, 0, 2, 3].forEach((corner, k) => this.put(18 * this.written + 3 * k, corners[corner], shade));
      ++this.written;
    });
  }

  // A point of the picture, placed just behind the near plane.
  put(o, [x, y], shade) {
    const { width, height } = this.view.rectangle;
    this.corner.set((2 * x) / width, (2 * y) / height, 0).unproject(this.view.orbit.camera).sub(this.lines.position).toArray(this.at, o);
    shade.toArray(this.tint, o);
  }
}
