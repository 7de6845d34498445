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
  }

  begin() { this.used = 0; }

  // `lift` and `aside` [pixels]: distance above the place and beside it.
  put(view, x, y, z, text, className, lift = 0, aside = 0) {
    const { camera } = view.orbit;
    const { rectangle } = view;
    this.place.set(x, y, z).project(camera);
    if (Math.abs(this.place.z) > 1 || Math.abs(this.place.x) > 1 || Math.abs(this.place.y) > 1) return;
    const label = this.pool[this.used] ?? this.grow();
    ++this.used;
    if (label.textContent !== text) label.textContent = text;
    if (label.className !== className) label.className = className;
    const left = rectangle.x + ((this.place.x + 1) / 2) * rectangle.width + aside;
    const top = this.host.clientHeight - rectangle.y - ((this.place.y + 1) / 2) * rectangle.height - lift;
    label.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px) translateX(var(--shift))`;
    label.hidden = false;
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
