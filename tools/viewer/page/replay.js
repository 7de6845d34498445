// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The world from a saved file: a list of [ms, "text" or "picture", payload], played without a
// server.
import { decodePicture } from './picture.js';

export class Replay {
  constructor(items, hear) {
    this.items = items.filter((item) => item[1] === 'text' || item[1] === 'picture');
    this.hear = hear;
    this.pictures = this.items.flatMap(([, type], i) => (type === 'picture' ? [i] : []));
    this.begin = this.pictures.length ? this.picture(this.pictures[0]).time : 0;
    this.length = this.pictures.length ? this.items[this.pictures.at(-1)][0] / 1000 : 0;
    this.at = 0; // seconds since the first picture
    this.times = 1;
    this.last = null;
    this.octets = 0;
    this.bad = 0;
  }

  start() {
    this.hear.state('live', '');
    this.go(0);
    this.report('playing');
  }

  picture(item) {
    const text = atob(this.items[item][2]);
    return decodePicture(Uint8Array.from(text, (letter) => letter.charCodeAt(0)).buffer);
  }

  // Number of items up to an instant.
  countUntil(seconds) {
    let low = 0;
    let high = this.items.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.items[middle][0] <= 1000 * seconds + 1e-6) low = middle + 1; else high = middle;
    }
    return low;
  }

  // Delivers the state at an instant: the last text of each type, and the picture.
  go(seconds) {
    this.at = Math.min(Math.max(seconds, 0), this.length);
    const until = this.countUntil(this.at);
    const texts = new Map();
    for (const [, type, payload] of this.items.slice(0, until)) if (type === 'text') texts.set(payload.type, payload);
    for (const text of texts.values()) if (text.type !== 'note') this.hear.text(text);
    this.done = until;
    this.show(until);
  }

  show(until) {
    for (let i = until - 1; i >= 0; --i) {
      if (this.items[i][1] !== 'picture') continue;
      try {
        this.hear.picture(this.picture(i));
      } catch (error) {
        ++this.bad;
        this.hear.bad(error.message);
      }
      return;
    }
  }

  // `now` [ms] of any clock that does not stop.
  advance(now) {
    const passed = this.last === null ? 0 : Math.min(now - this.last, 1000);
    this.last = now;
    if (!this.times || this.ended) return;
    this.at = Math.min(this.at + (passed / 1000) * this.times, this.length);
    const until = this.countUntil(this.at);
    const fresh = this.items.slice(this.done, until);
    for (const [, type, payload] of fresh) if (type === 'text') this.hear.text(payload);
    if (fresh.some((item) => item[1] === 'picture')) this.show(until);
    this.done = until;
    if (this.at >= this.length) this.report('end');
  }

  report(state) {
    this.ended = state === 'end';
    this.hear.text({ type: 'play', state, speed: this.times, time: this.begin + this.at });
  }

  tell(name, value) {
    const act = {
      seek: () => { this.go(value - this.begin); this.report(this.times ? 'playing' : 'paused'); },
      speed: () => {
        if (value && this.at >= this.length) this.go(0);
        this.times = value;
        this.report(value ? 'playing' : 'paused');
      },
      live: () => { this.go(this.length); this.report('end'); },
      step: () => { this.times = 0; this.step(value); this.report('paused'); },
    }[name];
    act?.();
  }

  // Moves by one second, or with 2 by one picture, back or forward.
  step(value) {
    if (Math.abs(value) === 1) return this.go(this.at + value);
    const shown = this.pictures.filter((i) => i < this.countUntil(this.at)).length - 1;
    const next = Math.min(Math.max(shown + Math.sign(value), 0), this.pictures.length - 1);
    return this.go(this.items[this.pictures[next]][0] / 1000);
  }

  get span() { return [this.begin, this.begin + this.length]; }
}
