// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner of each body, if more than one peer can own it: the body has a pale shade of the colour
// of the owner's first hand. At a change the colour is full for a moment, and a ring expands.
import { Color, DoubleSide, Mesh, MeshBasicMaterial, MeshLambertMaterial } from './libraries.js';
import { colour, HAND_COLOURS, handColour } from './colours.js';
import { flatRing } from './drawn_beacons.js';
import { solidReach, solidShape } from './solid_shapes.js';

const OTHER = 'side-other'; // colour of a peer without a hand here
const WHITE = new Color(1, 1, 1);
const PALE = 0.35; // share of white
const FLASH = 0.8; // [s]

export const drawnOwners = {
  name: 'owners', view: 'touch', says: 'owner of a body', mark: 'hands',
  make(group, view) { return new Owners(group, view); },
};

class Owners {
  constructor(group, view) {
    Object.assign(this, { group, view });
    this.ring = flatRing(0.96, 48);
    this.marks = [];
    this.number = -1;
  }

  paint() { this.colours = new Map([...HAND_COLOURS, OTHER].map((name) => [name, colour(name)])); }

  update(moment) {
    if (moment.touchNumber !== this.number) this.rebuild(moment);
    const differ = moment.ownersDiffer;
    for (const mark of this.marks) this.show(mark, moment, differ ? moment.owners[mark.body]?.owner : undefined);
  }

  rebuild(moment) {
    this.number = moment.touchNumber;
    for (const { tint, ring } of this.marks) {
      tint.geometry.dispose();
      for (const mesh of [tint, ring]) mesh.removeFromParent();
    }
    this.marks = moment.touch.solids.filter(({ body }) => body !== undefined).flatMap((solid) => this.mark(solid));
  }

  mark(solid) {
    const shape = solidShape(solid);
    if (!shape) return [];
    const tint = new Mesh(shape, new MeshLambertMaterial({ polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 }));
    const ring = new Mesh(this.ring, new MeshBasicMaterial({ transparent: true, depthWrite: false, side: DoubleSide }));
    this.group.add(tint, ring);
    return [{ body: solid.body, reach: solidReach(solid, shape), tint, ring, changed: -Infinity }];
  }

  show(mark, moment, owner) {
    const { tint, ring, reach, last } = mark;
    const body = moment.bodies[mark.body];
    tint.visible = !!body && owner !== undefined;
    if (owner !== undefined && owner !== last) {
      if (last !== undefined) mark.changed = moment.time;
      mark.last = owner;
    }
    const age = (moment.time - mark.changed) / FLASH;
    ring.visible = tint.visible && age >= 0 && age < 1;
    if (!tint.visible) return;
    const hand = moment.handOfPeer(owner);
    ring.material.color = this.colours.get(hand ? handColour(hand.index) : OTHER);
    tint.material.color.copy(ring.material.color).lerp(WHITE, ring.visible ? PALE * age : PALE);
    const [w, x, y, z] = body.turn;
    tint.position.fromArray(body.position);
    tint.quaternion.set(x, y, z, w).normalize();
    ring.position.fromArray(body.position);
    ring.quaternion.copy(this.view.orbit.camera.quaternion);
    ring.scale.setScalar(reach * (1 + 0.3 * age));
    ring.material.opacity = 0.9 * (1 - age);
  }
}
