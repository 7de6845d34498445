// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keeps the entities of an exercise in the world view. It begins above them, north up. Turning the
// picture leaves it on; moving it switches it off, and so does zooming among several entities.
import { Vector3 } from './libraries.js';

const NORTH_UP = -Math.PI / 2;
const TILT = 0.95;
const SLACK = 1.15; // of a new fit, so that the next one is not due at once
const SHRUNK = 2.4; // so much smaller is what is fitted anew
const LEAP = 1.5; // [s] between two moments: the camera leaps too
const FEW = 100; // entities that are measured in each picture

export class AutoCamera {
  constructor(view) {
    this.view = view;
    this.forget();
  }

  forget() {
    this.on = true;
    this.led = false;
    this.centre = new Vector3();
    this.radius = 0;
    this.key = '';
  }

  // Called for each new moment; `extent` is what is to be seen.
  lead(moment, extent) {
    const { orbit } = this.view;
    const followed = moment.picture.indexOf(moment.followed);
    const centre = new Vector3().fromArray(followed < 0 ? extent.centre : moment.shown, followed < 0 ? 0 : 3 * followed);
    const leaps = !(Math.abs(moment.time - this.time) < LEAP);
    this.time = moment.time;
    if (!this.led) {
      Object.assign(orbit.goal, { yaw: NORTH_UP, tilt: TILT });
      this.radius = 0;
    } else if (orbit.panned || (orbit.zoomed && moment.count > 1 && followed < 0)) {
      this.on = false;
    }
    const key = `${moment.followed} ${moment.count} ${moment.picture.epoch}`;
    const glides = key !== this.key || moment.count > FEW;
    this.key = key;
    if (this.on && this.led && !leaps && !glides) orbit.shift(centre.clone().sub(this.centre));
    this.centre.copy(centre);
    if (!this.on) return;
    orbit.goal.target.copy(centre);
    const fits = extent.radius <= this.radius && extent.radius > this.radius / SHRUNK;
    if (!orbit.zoomed && !fits) this.fit(extent.radius);
    if (!this.led || leaps) orbit.jump();
    this.led = true;
  }

  fit(radius) {
    this.radius = SLACK * radius;
    this.view.orbit.fit(this.centre.toArray(), this.radius);
  }

  setOn(on) {
    this.on = on;
    if (on && this.view.extent) this.fit(this.view.extent.radius);
  }
}
