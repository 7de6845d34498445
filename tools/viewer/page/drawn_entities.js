// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities as shown: the shape depends on the kind, the nose points forward, the colour depends on
// the side. Entities that the followed one does not receive are faint.
import { Color, DoubleSide, MeshBasicMaterial } from './libraries.js';
import { Bodies, fewSymbols, leastScale, shapeOf, sizeOf } from './bodies.js';
import { colour, SIDE_COLOURS } from './colours.js';
import { EntityNames } from './entity_names.js';
import { NONE } from './picture.js';

export const drawnEntities = {
  name: 'entities', view: 'world', says: 'entity as shown', mark: 'body side-friendly',
  make(group, view, labels) { return new Entities(group, view, labels); },
};

class Entities {
  constructor(group, view, labels) {
    this.view = view;
    this.names = new EntityNames(view, labels);
    this.bodies = new Bodies(group, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
    this.known = '';
    this.tinted = '';
  }

  paint() {
    this.teams = SIDE_COLOURS.map(colour);
    this.faint = this.teams.map((team) => new Color().lerpColors(team, colour('sky'), 0.72));
    this.tinted = '';
  }

  update(moment) {
    const { picture } = moment;
    this.view.few = fewSymbols(moment, this.view);
    const known = `${moment.rosterNumber} ${picture.epoch} ${moment.count} ${this.view.few}`;
    if (known !== this.known) {
      this.known = known;
      this.rows = Array.from({ length: moment.count }, (_, i) => moment.roster.get(picture.slot(i)));
      this.bodies.shape(this.rows.map((row) => shapeOf(row?.kind, row?.haptic, this.view.few)));
      this.tinted = '';
    }
    // Entities change cells, so the set of faint entities is updated once a second.
    const tinted = `${moment.followed} ${moment.cellsNumber} ${moment.followed === NONE ? '' : Math.floor(moment.time)}`;
    if (tinted !== this.tinted) {
      this.tinted = tinted;
      this.tint(moment);
    }
    const sized = `${known} ${moment.touchNumber} ${this.view.extent?.radius.toPrecision(1)}`;
    if (sized !== this.sized) {
      this.sized = sized;
      this.sizes = this.rows.map((row) => sizeOf(moment, this.view, row));
    }
    const scale = leastScale(this.view);
    const { shown, turns } = moment;
    this.bodies.begin(this.view.orbit.anchor);
    for (let i = 0; i < moment.count; ++i) {
      const x = shown[3 * i];
      const y = shown[3 * i + 1];
      const z = shown[3 * i + 2];
      this.bodies.set(i, x, y, z, turns, scale(x, y, z, this.sizes[i]));
    }
    this.bodies.end();
    if (moment.exercise) this.names.draw(moment, this.rows, (i, x, y, z) => scale(x, y, z, this.sizes[i]));
  }

  tint(moment) {
    const { picture, followed } = moment;
    const heard = moment.heardBy(followed);
    const all = followed === NONE || !heard.size;
    this.bodies.colours((i) => {
      const near = all || heard.has(picture.cell(i)) || picture.slot(i) === followed;
      return (near ? this.teams : this.faint)[picture.side(i)];
    });
  }
}
