// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Depth: from each hand and each ball that can be felt a line down to the grid, and a shadow there;
// from the user's own hand a line to the nearest surface, with its distance.
import { BufferGeometry, CylinderGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial } from './libraries.js';
import { Pool } from './arrow.js';
import { colour } from './colours.js';
import { floorHeight } from './extents.js';
import { nearestSurface } from './nearest_surface.js';
import { HAND_FLAGS } from './picture.js';
import { metres } from './words.js';

const MOST_DROPS = 32;

export const drawnDepth = {
  name: 'drop lines', view: 'touch', large: true, says: 'height above the grid', mark: 'drop',
  make(group, view, labels) { return new Depth(group, view, labels); },
};

class Depth {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.lineMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.55 });
    this.shade = new MeshBasicMaterial({ transparent: true, opacity: 0.16, depthWrite: false });
    const disc = new CylinderGeometry(1, 1, 0.01, 32).rotateX(Math.PI / 2);
    this.lines = new Pool(() => new Line(group, this.lineMaterial));
    this.shadows = new Pool(() => {
      const shadow = new Mesh(disc, this.shade);
      shadow.hide = () => { shadow.visible = false; };
      group.add(shadow);
      return shadow;
    });
  }

  paint() {
    this.lineMaterial.color = colour('dim');
    this.shade.color = colour('ghost');
  }

  update(moment) {
    const { extent } = this.view;
    this.lines.begin();
    this.shadows.begin();
    const balls = extent ? ballsOf(moment) : [];
    for (const { position, radius } of balls.slice(0, MOST_DROPS)) this.drop(position, radius, floorHeight(extent));
    const own = moment.hands.find(({ flags }) => flags & HAND_FLAGS.yours);
    if (own) this.reach(moment, own, balls);
    this.lines.end();
    this.shadows.end();
  }

  drop([x, y, z], radius, floor) {
    if (z - radius < floor) return;
    this.lines.next().set([x, y, z - radius], [x, y, floor]);
    const shadow = this.shadows.next();
    shadow.visible = true;
    shadow.position.set(x, y, floor);
    shadow.scale.setScalar(radius);
  }

  // The line from the user's hand to what it would touch first.
  reach(moment, hand, balls) {
    const radius = moment.handRadius(hand.index);
    const near = nearestSurface(moment, hand, balls);
    if (!near || near.distance < 0.02 * radius) return;
    this.lines.next().set(hand.position, near.point);
    const [x, y, z] = hand.position.map((a, k) => (a + near.point[k]) / 2);
    this.labels.put(this.view, x, y, z, metres(near.distance), 'scale', 8, 6);
  }
}

// Hands, and what else can be felt as a ball.
export function ballsOf(moment) {
  const balls = moment.hands.map(({ position, index, slot }) => ({ position, slot, radius: moment.handRadius(index) }));
  const own = new Set(moment.hands.map(({ slot }) => slot));
  for (let i = 0; i < moment.count && balls.length < 2 * MOST_DROPS; ++i) {
    const slot = moment.picture.slot(i);
    const row = moment.roster.get(slot);
    if (row?.haptic && !own.has(slot) && !moment.bodyOf(row)) balls.push({ slot, position: [...moment.shown.subarray(3 * i, 3 * i + 3)], radius: row.radius || 0.01 });
  }
  return balls;
}

class Line {
  constructor(group, material) {
    this.line = new LineSegments(new BufferGeometry(), material);
    this.line.geometry.setAttribute('position', new Float32BufferAttribute(new Float32Array(6), 3));
    this.line.frustumCulled = false;
    group.add(this.line);
  }

  set(from, to) {
    const { position } = this.line.geometry.attributes;
    position.array.set([...from, ...to]);
    position.needsUpdate = true;
    this.line.visible = true;
  }

  hide() { this.line.visible = false; }
}
