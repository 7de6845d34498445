// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities that can be felt and are no hand of this program: hands and bodies of others, as balls
// of their radius.
import { Mesh, MeshLambertMaterial, SphereGeometry } from './libraries.js';
import { Pool } from './arrow.js';
import { colour, SIDE_COLOURS } from './colours.js';
import { foreign } from './words.js';

const MOST_BALLS = 128;
const NAMED_BALLS = 8;

export const drawnTouchEntities = {
  name: 'felt entities', view: 'touch', says: 'entity of another peer', mark: 'ball side-friendly',
  make(group, view, labels) { return new TouchEntities(group, view, labels); },
};

class TouchEntities {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.materials = SIDE_COLOURS.map(() => new MeshLambertMaterial());
    const shape = new SphereGeometry(1, 28, 18);
    this.balls = new Pool(() => {
      const ball = new Mesh(shape, this.materials[0]);
      ball.hide = () => { ball.visible = false; };
      group.add(ball);
      return ball;
    });
  }

  paint() { this.materials.forEach((material, i) => { material.color = colour(SIDE_COLOURS[i]); }); }

  update(moment) {
    const { picture, shown } = moment;
    const own = new Set(moment.hands.map((hand) => hand.slot));
    this.balls.begin();
    for (let i = 0; i < moment.count && this.balls.used < MOST_BALLS; ++i) {
      const slot = picture.slot(i);
      const row = moment.roster.get(slot);
      if (!row?.haptic || own.has(slot)) continue;
      const ball = this.balls.next();
      ball.visible = true;
      ball.material = this.materials[picture.side(i)];
      ball.position.fromArray(shown, 3 * i);
      const radius = row.radius || 0.01;
      ball.scale.setScalar(radius);
      if (this.view.rectangle.width < 400 || this.balls.used > NAMED_BALLS || moment.bodyOf(row)) continue;
      this.labels.put(this.view, shown[3 * i], shown[3 * i + 1], shown[3 * i + 2] - 1.25 * radius,
        foreign(moment.name(slot), 24), 'hand', -10);
    }
    this.balls.end();
  }
}
