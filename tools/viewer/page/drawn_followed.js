// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The followed entity: its name, and a mark above it; in an exercise a ring round it.
import { ConeGeometry, DoubleSide, Mesh, MeshBasicMaterial } from './libraries.js';
import { leastScale, sizeOf } from './bodies.js';
import { colour } from './colours.js';
import { flatRing } from './drawn_beacons.js';
import { foreign } from './words.js';

export const drawnFollowed = {
  name: 'followed', view: 'world', says: 'followed', mark: 'followed',
  make(group, view, labels) { return new Followed(group, view, labels); },
};

class Followed {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.material = new MeshBasicMaterial();
    this.mark = new Mesh(new ConeGeometry(0.55, 1.1, 4).rotateX(-Math.PI / 2), this.material);
    this.ring = new Mesh(flatRing(0.9, 48), new MeshBasicMaterial({ side: DoubleSide, transparent: true, opacity: 0.75 }));
    group.add(this.mark, this.ring);
  }

  paint() { this.material.color = this.ring.material.color = colour('text'); }

  update(moment) {
    const i = moment.picture.indexOf(moment.followed);
    this.mark.visible = i >= 0 && !moment.exercise;
    this.ring.visible = i >= 0 && moment.exercise;
    if (i < 0) return;
    const [x, y, z] = moment.shown.subarray(3 * i, 3 * i + 3);
    const scale = leastScale(this.view)(x, y, z, sizeOf(moment, this.view, moment.roster.get(moment.followed)));
    this.mark.scale.setScalar(scale);
    this.mark.position.set(x, y, z + 2.4 * scale);
    this.ring.scale.setScalar(1.75 * scale);
    this.ring.position.set(x, y, z);
    if (!moment.exercise) this.labels.put(this.view, x, y, z + 3.2 * scale, foreign(moment.name(moment.followed), 24), 'name', 4);
  }
}
