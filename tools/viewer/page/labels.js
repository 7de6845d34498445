// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Text at a place of a picture, as elements over the canvas.
import { Vector3 } from './libraries.js';
import { element } from './words.js';

const POINTED = 60; // [pixels]

export class Labels {
  constructor(host) {
    this.host = host;
    this.pool = [];
    this.used = 0;
    this.place = new Vector3();
    this.pointer = null; // [pixels], of the mouse on the picture
    this.taken = []; // [left, top, right, bottom] of what no text may cover
    this.fixed = [];
  }

  // `fixed`: what lies over the picture.
  begin(fixed = this.fixed) {
    this.used = 0;
    this.fixed = fixed;
    this.taken = [...fixed];
  }

  // Width of a text of 12 pixels, approximately.
  widthOf(text) { return 6.7 * text.length + 4; }

  take(left, top, right, bottom) { this.taken.push([left, top, right, bottom]); }

  // Takes a rectangle within the picture if nothing else has it.
  claim(left, top, width, height) {
    const right = left + width;
    const bottom = top + height;
    if (left < 2 || top < 2 || right > this.host.clientWidth - 2 || bottom > this.host.clientHeight - 2) return false;
    if (this.taken.some(([l, t, r, b]) => left < r && right > l && top < b && bottom > t)) return false;
    this.take(left, top, right, bottom);
    return true;
  }

  // Where a place is on the picture [pixels]; null if it is not in front of the camera.
  placed(view, x, y, z) {
    const { rectangle } = view;
    this.place.set(x, y, z).project(view.orbit.camera);
    if (Math.abs(this.place.z) > 1) return null;
    return [rectangle.x + ((this.place.x + 1) / 2) * rectangle.width, this.host.clientHeight - rectangle.y - ((this.place.y + 1) / 2) * rectangle.height];
  }

  // A text at a place of the picture [pixels].
  write(left, top, text, className) {
    const label = this.pool[this.used] ?? this.grow();
    ++this.used;
    if (label.textContent !== text) label.textContent = text;
    if (label.className !== className) label.className = className;
    label.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px) translateX(var(--shift))`;
    label.hidden = false;
  }

  // `lift` and `aside` [pixels]: distance above the place and beside it. Returns where the place is.
  put(view, x, y, z, text, className, lift = 0, aside = 0) {
    const at = this.placed(view, x, y, z);
    if (!at || Math.abs(this.place.x) > 1 || Math.abs(this.place.y) > 1) return null;
    this.write(at[0] + aside, at[1] - lift, text, className);
    return at;
  }

  // The nearest of some places to the pointer, or -1 if all are farther than 60 pixels.
  pointed(view, places) {
    if (!this.pointer) return -1;
    const { rectangle } = view;
    let best = -1;
    let least = POINTED;
    places.forEach((place, i) => {
      this.place.fromArray(place).project(view.orbit.camera);
      const left = rectangle.x + ((this.place.x + 1) / 2) * rectangle.width;
      const top = this.host.clientHeight - rectangle.y - ((this.place.y + 1) / 2) * rectangle.height;
      const apart = Math.hypot(left - this.pointer[0], top - this.pointer[1]);
      if (apart < least) [least, best] = [apart, i];
    });
    return best;
  }

  end() { for (let i = this.used; i < this.pool.length; ++i) this.pool[i].hidden = true; }

  grow() {
    const label = element('span', '');
    this.host.append(label);
    this.pool.push(label);
    return label;
  }
}
