// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The predicted position of each entity, next to the shown one. The distance is drawn enlarged, so
// that it is visible.
import { BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, LineBasicMaterial, LineSegments, MeshBasicMaterial } from './libraries.js';
import { Bodies, leastScale, shapeOf, sizeOf } from './bodies.js';
import { colour } from './colours.js';

const TIMES = 4;
const MOST_BY_SOFTWARE = 250;

export const drawnGhosts = {
  name: 'predicted', view: 'world', large: true, says: `predicted, error × ${TIMES}`, mark: 'ghost',
  make(group, view) { return new Ghosts(group, view); },
};

class Ghosts {
  constructor(group, view) {
    this.view = view;
    this.material = new MeshBasicMaterial({ transparent: true, opacity: 0.34, depthWrite: false, side: DoubleSide });
    this.bodies = new Bodies(group, this.material);
    this.lineMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.8 });
    this.lines = new LineSegments(new BufferGeometry(), this.lineMaterial);
    this.lines.frustumCulled = false;
    group.add(this.lines);
    this.known = '';
  }

  paint() {
    this.material.color = colour('ghost');
    this.lineMaterial.color = colour('error');
  }

  update(moment) {
    const known = `${moment.rosterNumber} ${moment.picture.epoch} ${moment.count} ${this.view.few}`;
    if (known !== this.known) {
      this.known = known;
      this.rows = Array.from({ length: moment.count }, (_, i) => moment.roster.get(moment.picture.slot(i)));
      this.slots = this.rows.map((row) => shapeOf(row?.kind, row?.haptic, this.view.few));
    }
    if (!this.way || this.way.length < 6 * moment.count) {
      this.way = new Float32Array(6 * Math.ceil(1.2 * moment.count));
      this.lines.geometry.dispose();
      this.lines.geometry.setAttribute('position', new BufferAttribute(this.way, 3).setUsage(DynamicDrawUsage));
    }
    const off = this.off(moment);
    this.bodies.shape(off.map((i) => this.slots[i]));
    this.write(moment, off);
  }

  // Entities with a visible error: a pixel or more. With software rendering only the worst of them.
  off({ shown, predicted, count }) {
    const { position } = this.view.orbit.camera;
    const pixel = 0.65 / Math.max(200, this.view.rectangle.height);
    const list = [];
    for (let i = 0; i < count; ++i) {
      const o = 3 * i;
      const error = Math.hypot(shown[o] - predicted[o], shown[o + 1] - predicted[o + 1], shown[o + 2] - predicted[o + 2]);
      const depth = Math.hypot(shown[o] - position.x, shown[o + 1] - position.y, shown[o + 2] - position.z);
      if (TIMES * error > 2 * pixel * depth) list.push([i, error / depth]);
    }
    if (this.view.software && list.length > MOST_BY_SOFTWARE) list.sort(([, a], [, b]) => b - a).length = MOST_BY_SOFTWARE;
    return list.map(([i]) => i);
  }

  write(moment, off) {
    const { shown, predicted, turns } = moment;
    const scale = leastScale(this.view);
    const { way } = this;
    const { anchor } = this.view.orbit;
    const from = anchor.toArray();
    const turn = new Float32Array(4 * off.length);
    this.lines.position.copy(anchor);
    this.bodies.begin(anchor);
    off.forEach((i, n) => {
      const [x, y, z] = from.map((a, k) => {
        const at = shown[3 * i + k];
        const twin = at + TIMES * (predicted[3 * i + k] - at);
        way[6 * n + k] = at - a;
        way[6 * n + 3 + k] = twin - a;
        return twin;
      });
      for (let k = 0; k < 4; ++k) turn[4 * n + k] = turns[4 * i + k];
      this.bodies.set(n, x, y, z, turn, scale(x, y, z, sizeOf(moment, this.view, this.rows[i])));
    });
    this.bodies.end();
    const { position } = this.lines.geometry.attributes;
    this.lines.geometry.setDrawRange(0, 2 * off.length);
    position.clearUpdateRanges();
    position.addUpdateRange(0, 6 * off.length);
    position.needsUpdate = true;
  }
}
