// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contacts between entities of the world, as a listener computes them: an arrow with the force in
// newtons.
import { MeshBasicMaterial } from './libraries.js';
import { Arrow, Pool } from './arrow.js';
import { colour } from './colours.js';
import { digits } from './words.js';

const MOST_LABELS = 24;

export const drawnContacts = {
  name: 'contacts', view: 'world', says: 'force on an entity', mark: 'line force',
  make(group, view, labels) { return new Contacts(group, view, labels); },
};

class Contacts {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.material = new MeshBasicMaterial();
    this.arrows = new Pool(() => new Arrow(group, this.material));
  }

  paint() { this.material.color = colour('force'); }

  update({ contacts }) {
    const away = this.view.orbit.now.distance;
    this.arrows.begin();
    for (const { point, force, newtons } of contacts.slice(0, 256)) {
      const arrow = this.arrows.next();
      if (!arrow.set(point, force, (0.16 * away * newtons) / this.view.scale, 0.0022 * away)) continue;
      if (newtons < 0.005 || this.arrows.used > MOST_LABELS) continue;
      const { x, y, z } = arrow.tipAt;
      if (this.view.rectangle.width > 400) this.labels.put(this.view, x, y, z, `${digits(newtons)} N`, 'newtons', 6);
    }
    this.arrows.end();
  }
}
