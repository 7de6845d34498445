// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The position of a hand as predicted by others: a translucent copy of the ball, at the place given
// by the last update.
import { Mesh, MeshBasicMaterial, SphereGeometry } from './libraries.js';
import { Pool } from './arrow.js';
import { colour } from './colours.js';

export const drawnHandGhosts = {
  name: 'predicted hand', view: 'touch', says: 'hand as others predict it', mark: 'ghost-ball',
  make(group) { return new HandGhosts(group); },
};

class HandGhosts {
  constructor(group) {
    this.material = new MeshBasicMaterial({ transparent: true, opacity: 0.3, depthWrite: false });
    const shape = new SphereGeometry(1, 32, 20);
    this.balls = new Pool(() => {
      const ball = new Mesh(shape, this.material);
      ball.hide = () => { ball.visible = false; };
      group.add(ball);
      return ball;
    });
  }

  paint() { this.material.color = colour('ghost'); }

  update(moment) {
    this.balls.begin();
    for (const hand of moment.hands.slice(0, 64)) {
      const i = moment.picture.indexOf(hand.slot);
      if (i < 0) continue;
      const ball = this.balls.next();
      ball.visible = true;
      ball.position.fromArray(moment.predicted, 3 * i);
      ball.scale.setScalar(0.995 * moment.handRadius(hand.index)); // slightly smaller, so that only the part outside the ball shows
    }
    this.balls.end();
  }
}
