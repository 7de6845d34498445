// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The force on each hand: an arrow at its contact point, with the force in newtons.
import { MeshBasicMaterial } from './libraries.js';
import { Arrow, Pool } from './arrow.js';
import { colour } from './colours.js';
import { digits } from './words.js';

const LEAST = 0.005; // [N], below it nothing is felt

export const drawnForces = {
  name: 'forces', view: 'touch', says: 'force on the hand', mark: 'line force',
  make(group, view, labels) { return new Forces(group, view, labels); },
};

class Forces {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.material = new MeshBasicMaterial({ depthTest: false });
    this.arrows = new Pool(() => {
      const arrow = new Arrow(group, this.material);
      for (const part of [arrow.shaft, arrow.tip]) part.renderOrder = 1;
      return arrow;
    });
  }

  paint() { this.material.color = colour('force'); }

  update(moment) {
    this.arrows.begin();
    for (const { surface, force, newtons, index } of moment.hands.slice(0, 64)) {
      this.put(surface, force, newtons, index % 2 ? '' : ' before'); // same side as its name: away from the other hand of a pair
    }
    const own = new Set(moment.hands.map((hand) => hand.slot));
    for (const { felt, point, force, newtons } of moment.contacts.slice(0, 64)) {
      if (!own.has(felt) && moment.roster.get(felt)?.haptic) this.put(point, force, newtons, '');
    }
    this.arrows.end();
  }

  put(from, force, newtons, side) {
    const width = 0.009 * (this.view.extent?.radius ?? 1);
    const shown = this.arrows.next().set(from, force, newtons * this.view.metresPerNewton, width);
    if (!shown && newtons < LEAST) return;
    const { tipAt } = this.arrows.list[this.arrows.used - 1];
    const [x, y, z] = shown ? tipAt.toArray() : from;
    const kind = `newtons${side}${this.view.rectangle.width < 400 ? ' small' : ''}`;
    this.labels.put(this.view, x, y, z, `${digits(newtons)} N`, kind, 10);
  }
}
