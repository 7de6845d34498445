// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Beacons: a mark in the centre of the announced cell of each, and a ring that expands when the
// beacon is received.
import { BufferGeometry, DoubleSide, Float32BufferAttribute, Mesh, MeshBasicMaterial, SphereGeometry } from './libraries.js';
import { leastScale } from './bodies.js';
import { colour } from './colours.js';
import { Pool } from './arrow.js';
import { foreign } from './words.js';

const MOST_BEACONS = 64;
const PULSE = 0.8; // [s]

export const drawnBeacons = {
  name: 'beacons', view: 'world', says: 'beacon in its cell', mark: 'beacon',
  make(group, view, labels) { return new Beacons(group, view, labels); },
};

class Beacons {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.material = new MeshBasicMaterial();
    this.shape = new SphereGeometry(1, 4, 2).rotateX(Math.PI / 2).scale(0.8, 0.8, 1.3);
    this.ring = flatRing(0.94, 48);
    this.marks = new Pool(() => this.mark(group));
    this.heard = new Map(); // name -> [reception as stated, time of the picture with it]
  }

  mark(group) {
    const body = new Mesh(this.shape, this.material);
    const ring = new Mesh(this.ring, new MeshBasicMaterial({ transparent: true, depthWrite: false, side: DoubleSide }));
    group.add(body, ring);
    return { body, ring, hide() { body.visible = ring.visible = false; } };
  }

  paint() { this.material.color = colour('beacon'); }

  update(moment) {
    const { beacons } = moment.groups;
    const reach = 0.5 * (moment.cells.size || 0.1 * (this.view.extent?.radius ?? 1));
    const z = this.floor(moment);
    this.marks.begin();
    for (const beacon of beacons.slice(0, MOST_BEACONS)) this.show(this.marks.next(), beacon, z, reach, this.age(beacon, moment.time));
    this.marks.end();
    for (const name of this.heard.keys()) if (!beacons.some((one) => one.name === name)) this.heard.delete(name);
  }

  // Seconds since a picture first showed this reception; negative in earlier pictures.
  age({ name, heard }, now) {
    const known = this.heard.get(name);
    if (known?.[0] === heard) return now - known[1];
    this.heard.set(name, [heard, now]);
    return 0;
  }

  show({ body, ring }, { name, x, y }, z, reach, age) {
    const size = 1.1 * leastScale(this.view)(x, y, z, 0.08 * reach);
    body.visible = true;
    body.scale.setScalar(size);
    body.position.set(x, y, z + 1.3 * size);
    ring.visible = age >= 0 && age < PULSE;
    ring.material.color = this.material.color;
    ring.material.opacity = Math.max(0, 0.75 * (1 - age / PULSE));
    ring.scale.setScalar(Math.max(size, (0.2 + (0.8 * age) / PULSE) * reach));
    ring.position.set(x, y, z);
    if (this.view.rectangle.width <= 400) return;
    const text = foreign(name, 31);
    const at = this.labels.put(this.view, x, y, z + 2.6 * size, text, 'beacon', 8);
    const half = this.labels.widthOf(text) / 2 + 2; // bold
    if (at) this.labels.take(at[0] - half, at[1] - 25, at[0] + half, at[1] - 6);
  }

  // Height of the lowest entity.
  floor({ shown, count }) {
    let z = Infinity;
    for (let i = 0; i < count; ++i) if (shown[3 * i + 2] < z) z = shown[3 * i + 2];
    return Number.isFinite(z) ? z : 0;
  }
}

// A flat ring around a point, with an outer radius of 1.
export function flatRing(inner, count) {
  const at = Array.from({ length: count }, (_, i) => {
    const [a, b] = [i, i + 1].map((k) => (2 * Math.PI * k) / count);
    const point = (radius, angle) => [radius * Math.cos(angle), radius * Math.sin(angle), 0];
    const corners = [point(inner, a), point(1, a), point(1, b), point(inner, b)];
    return [0, 1, 2, 0, 2, 3].flatMap((k) => corners[k]);
  });
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(at.flat(), 3));
}
