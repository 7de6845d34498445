// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Friction cones: the contact holds while the force is inside the cone, and the hand slides at its
// side. Shown on demand.
import { ConeGeometry, DoubleSide, Mesh, MeshBasicMaterial, Vector3 } from './libraries.js';
import { Pool } from './arrow.js';
import { colour } from './colours.js';
import { HAND_FLAGS } from './picture.js';

const ALONG_Y = new Vector3(0, 1, 0);
const SLIDES = 0.98; // of the cone's angle

export const drawnCones = {
  name: 'friction cones', view: 'touch', says: 'friction cone', mark: 'cone', hidden: true,
  make(group, view) { return new Cones(group, view); },
};

class Cones {
  constructor(group, view) {
    this.view = view;
    const material = () => new MeshBasicMaterial({ transparent: true, opacity: 0.22, depthWrite: false, side: DoubleSide });
    this.holds = material();
    this.slides = material();
    const shape = new ConeGeometry(1, 1, 40, 1, true).translate(0, -0.5, 0).rotateX(Math.PI); // apex at the contact
    this.cones = new Pool(() => {
      const cone = new Mesh(shape, this.holds);
      cone.hide = () => { cone.visible = false; };
      group.add(cone);
      return cone;
    });
  }

  paint() {
    this.holds.color = colour('side-neutral');
    this.slides.color = colour('force');
  }

  update(moment) {
    this.cones.begin();
    for (const hand of moment.hands.slice(0, 64)) {
      const friction = frictionOf(moment, hand);
      if (!(hand.flags & HAND_FLAGS.contact) || !friction || Math.hypot(...hand.normal) < 0.5) continue;
      const cone = this.cones.next();
      cone.visible = true;
      const height = Math.max(hand.newtons * this.view.metresPerNewton, 0.08 * (this.view.extent?.radius ?? 1)) * 0.9;
      const normal = new Vector3(...hand.normal).normalize();
      cone.position.fromArray(hand.surface);
      cone.quaternion.setFromUnitVectors(ALONG_Y, normal);
      cone.scale.set(friction * height, height, friction * height);
      const along = normal.dot(new Vector3(...hand.force));
      const across = Math.sqrt(Math.max(0, hand.newtons ** 2 - along ** 2));
      cone.material = across > SLIDES * friction * along ? this.slides : this.holds;
    }
    this.cones.end();
  }
}

// Friction of the nearest solid, or of the hand if another hand is nearer than two and a half
// radii.
function frictionOf(moment, hand) {
  const away = (place) => Math.hypot(...place.map((x, k) => x - hand.surface[k]));
  const radius = moment.handRadius(hand.index);
  const other = moment.hands.some((one) => one.index !== hand.index && away(one.position) < 2.5 * radius);
  const own = moment.handRow(hand.index)?.friction;
  if (other && Number.isFinite(own)) return own;
  const [nearest] = [...moment.touch.solids].sort((a, b) => away(a.position) - away(b.position));
  return Number.isFinite(nearest?.friction) ? nearest.friction : own;
}
