// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A grid below the touched objects, with the length of its squares as a scale.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments } from './libraries.js';
import { colour } from './colours.js';
import { floorHeight } from './extents.js';
import { roundUp } from './words.js';

const HALF = 6; // squares from the middle to the edge

export const drawnFloor = {
  name: 'floor', view: 'touch', says: 'grid for scale', mark: 'cell-plain',
  make(group, view, labels) { return new Floor(group, view, labels); },
};

class Floor {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.material = new LineBasicMaterial({ vertexColors: true });
    this.lines = new LineSegments(new BufferGeometry(), this.material);
    this.lines.frustumCulled = false;
    group.add(this.lines);
    this.key = '';
  }

  paint() { this.key = ''; }

  update(moment) {
    const { extent } = this.view;
    if (!extent) return;
    const step = roundUp(extent.radius / 4);
    const key = `${step} ${moment.touchNumber} ${extent.centre.map((x) => Math.round(x / step))}`;
    if (key !== this.key) this.make(step, extent, key);
    if (this.view.rectangle.width > 400) {
      const [x, y, z] = this.corner;
      this.labels.put(this.view, x, y, z, `one square ${step < 1 ? `${Math.round(step * 1e3)} mm` : `${step} m`}`, 'scale', 0);
    }
  }

  make(step, { centre, radius }, key) {
    this.key = key;
    const [cx, cy] = centre.map((x) => Math.round(x / step) * step);
    const z = floorHeight({ centre, radius });
    const near = colour('grid');
    const far = colour('sky');
    const at = [];
    const tint = [];
    // Each line consists of pieces, so that it fades towards the edge.
    const point = (x, y) => {
      at.push(x * step, y * step, 0);
      const share = Math.min(1, Math.hypot(x, y) / HALF) ** 1.5;
      tint.push(near.r + (far.r - near.r) * share, near.g + (far.g - near.g) * share, near.b + (far.b - near.b) * share);
    };
    for (let a = -HALF; a <= HALF; ++a) {
      for (let b = -HALF; b < HALF; ++b) {
        point(a, b);
        point(a, b + 1);
        point(b, a);
        point(b + 1, a);
      }
    }
    this.lines.geometry.setAttribute('position', new Float32BufferAttribute(at, 3));
    this.lines.geometry.setAttribute('color', new Float32BufferAttribute(tint, 3));
    this.lines.position.set(cx, cy, z);
    this.corner = [cx, cy - 2 * step, z];
  }
}
