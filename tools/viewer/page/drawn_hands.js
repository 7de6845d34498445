// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hands: a ball of the hand's radius at the device, a dot at the contact point on the surface, its
// name and state.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, SphereGeometry, Vector3 } from './libraries.js';
import { Pool } from './arrow.js';
import { colour, handColour } from './colours.js';
import { HAND_FLAGS } from './picture.js';
import { foreign } from './words.js';

const STATES = [[HAND_FLAGS.stopped, 'stopped'], [HAND_FLAGS.forceCut, 'force cut'], [HAND_FLAGS.softened, 'softened'], [HAND_FLAGS.limited, 'rate limited']];

export const drawnHands = {
  name: 'hands', view: 'touch', says: 'hand, and its point on a surface', mark: 'ball hands',
  make(group, view, labels) { return new Hands(group, view, labels); },
};

// State of a hand in words; empty if the state is normal.
export function handWords(flags) { return STATES.filter(([flag]) => flags & flag).map(([, word]) => word).join(', '); }

class Hands {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.balls = new Pool((i) => new Ball(group, i));
  }

  paint() { for (const ball of this.balls.list) ball.paint(); }

  update(moment) {
    this.balls.begin();
    for (const hand of moment.hands.slice(0, 64)) {
      const radius = moment.handRadius(hand.index);
      this.balls.next().set(hand, radius);
      if (this.view.rectangle.width < 400) continue;
      this.name(moment, hand, radius);
    }
    this.balls.end();
  }

  // Puts the name next to the ball, on the side away from the other hand of a pair.
  name(moment, hand, radius) {
    const [x, y, z] = hand.position;
    const side = hand.index % 2 ? 1 : -1;
    const aside = side * (6 + this.view.pixels(radius, hand.position));
    const kind = `${side < 0 ? 'left' : 'right'} hand-${hand.index % 4}`;
    const lift = this.lift(hand, side, this.view.pixels(radius, hand.position));
    const yours = hand.flags & HAND_FLAGS.yours ? ' (you)' : '';
    this.labels.put(this.view, x, y, z, `${foreign(moment.handName(hand.index), 24)}${yours}`, `hand ${kind}`, lift, aside);
    const words = handWords(hand.flags);
    if (words) this.labels.put(this.view, x, y, z, words, `state ${kind}`, lift - 16, aside);
  }

  // Height of the name [pixels]: below the newtons of the force arrow if these would overlap it.
  lift({ position, surface, force }, side, radius) {
    const { camera } = this.view.orbit;
    const { width, height } = this.view.rectangle;
    const at = new Vector3().fromArray(position).project(camera);
    const tip = new Vector3().fromArray(force).multiplyScalar(this.view.metresPerNewton).add(new Vector3().fromArray(surface)).project(camera);
    const beside = (side * (tip.x - at.x) * width) / 2 - radius;
    const above = ((tip.y - at.y) * height) / 2;
    return Math.hypot(...force) > 0.005 && Math.abs(beside) < 56 && above > -37 && above < 5 ? above + 3 : 9;
  }
}

class Ball {
  constructor(group, i) {
    this.i = i;
    this.material = new MeshLambertMaterial();
    this.ball = new Mesh(new SphereGeometry(1, 36, 24), this.material);
    this.dotMaterial = new MeshBasicMaterial({ depthTest: false });
    this.dot = new Mesh(new SphereGeometry(1, 16, 12), this.dotMaterial);
    this.lineMaterial = new LineBasicMaterial({ depthTest: false });
    this.line = new LineSegments(new BufferGeometry(), this.lineMaterial);
    this.line.geometry.setAttribute('position', new Float32BufferAttribute(new Float32Array(6), 3));
    this.line.frustumCulled = false;
    for (const part of [this.dot, this.line]) part.renderOrder = 2;
    group.add(this.ball, this.dot, this.line);
    this.paint();
  }

  paint() {
    this.material.color = colour(handColour(this.index ?? this.i));
    this.dotMaterial.color = colour('text');
    this.lineMaterial.color = colour('text');
  }

  set(hand, radius) {
    if (hand.index !== this.index) {
      this.index = hand.index;
      this.paint();
    }
    this.ball.visible = true;
    this.ball.scale.setScalar(radius);
    this.ball.position.fromArray(hand.position);
    const held = (hand.flags & HAND_FLAGS.contact) !== 0;
    this.dot.visible = held;
    this.line.visible = held;
    if (!held) return;
    this.dot.scale.setScalar(0.16 * radius);
    this.dot.position.fromArray(hand.surface);
    const { position } = this.line.geometry.attributes;
    position.array.set([...hand.position, ...hand.surface]);
    position.needsUpdate = true;
  }

  hide() { for (const part of [this.ball, this.dot, this.line]) part.visible = false; }
}
