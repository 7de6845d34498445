// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A round length in the middle of the picture, and where north is.
import { roundDown, roundMetres } from './words.js';

const LONGEST_BAR = 130; // [pixels]

export class ScaleBar {
  constructor(host) {
    this.host = host;
    this.bar = host.querySelector('i');
    this.words = host.querySelector('span');
    this.north = host.querySelector('b');
    this.length = 0; // [m]
  }

  draw(view, shown) {
    if (this.host.hidden === shown) this.host.hidden = !shown;
    if (!shown) return;
    const { now } = view.orbit;
    const pixels = view.pixels(1, now.target.toArray());
    this.length = roundDown(Math.min(LONGEST_BAR, 0.34 * view.rectangle.width) / pixels);
    this.width = this.length * pixels;
    this.bar.style.width = `${this.width.toFixed(1)}px`;
    const words = roundMetres(this.length);
    if (this.words.textContent !== words) this.words.textContent = words;
    this.north.style.transform = `rotate(${(now.yaw + Math.PI / 2).toFixed(3)}rad)`;
  }
}
