// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An arrow from a point. Its length is proportional to a force.
import { ConeGeometry, CylinderGeometry, Group, Mesh, Vector3 } from './libraries.js';

const ARROW_AXIS = new Vector3(0, 1, 0);
let shaftShape = null;
let tipShape = null;

export class Arrow {
  constructor(group, material) {
    shaftShape ??= new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0);
    tipShape ??= new ConeGeometry(2.6, 6.5, 20).translate(0, 3.25, 0);
    this.parts = new Group();
    this.shaft = new Mesh(shaftShape, material);
    this.tip = new Mesh(tipShape, material);
    this.parts.add(this.shaft, this.tip);
    this.tipAt = new Vector3();
    this.along = new Vector3();
    group.add(this.parts);
  }

  // `width` [m]: radius of the shaft.
  set(from, direction, length, width) {
    this.along.fromArray(direction);
    this.parts.visible = length > width && this.along.lengthSq() > 0;
    if (!this.parts.visible) return false;
    this.along.normalize();
    this.parts.position.fromArray(from);
    this.parts.quaternion.setFromUnitVectors(ARROW_AXIS, this.along);
    const head = Math.min(6.5 * width, 0.6 * length);
    this.shaft.scale.set(width, length - head, width);
    this.tip.scale.setScalar(head / 6.5);
    this.tip.position.y = length - head;
    this.tipAt.fromArray(from).addScaledVector(this.along, length);
    return true;
  }

  hide() { this.parts.visible = false; }
}

// A pool of objects. Each is made once, as needed; unused ones are hidden.
export class Pool {
  constructor(make) {
    this.make = make;
    this.list = [];
    this.used = 0;
  }

  begin() { this.used = 0; }
  next() { return this.list[this.used++] ?? this.grow(); }
  end() { for (const one of this.list.slice(this.used)) one.hide(); }

  grow() {
    this.list.push(this.make(this.list.length));
    return this.list.at(-1);
  }
}
