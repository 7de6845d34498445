// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keeps the last minute of messages to this page, for a saved file. If pictures are large, some are
// omitted to keep a budget.

const KEPT_SECONDS = 60;
const BUDGET = 14e6; // octets of pictures; this value and the kept types of text are the same as in saved_run
const STATE = ['hello', 'origin', 'roster', 'touch', 'cells', 'groups', 'bodies'];

export class Recorder {
  constructor(budget = BUDGET) {
    this.budget = budget;
    this.clear();
  }

  clear() {
    this.items = []; // [time, 'text' or 'picture', payload]
    this.before = new Map(); // last text of each type that is older than the items
    this.last = -Infinity;
    this.lastNumbers = -Infinity;
    this.spacing = 0;
  }

  text(message) {
    if (message.type === 'numbers') {
      if (this.last - this.lastNumbers < 1) return;
      this.lastNumbers = this.last;
    } else if (!STATE.includes(message.type)) return;
    if (this.last === -Infinity) this.before.set(message.type, message);
    else this.items.push([this.last, 'text', message]);
  }

  picture(picture) {
    this.spacing = (picture.buffer.byteLength * KEPT_SECONDS) / this.budget;
    if (picture.time <= this.last || picture.time - this.last < this.spacing) return;
    this.last = picture.time;
    this.items.push([picture.time, 'picture', picture.buffer]);
    while (this.items.length && this.items[0][0] < picture.time - KEPT_SECONDS) {
      const [, type, payload] = this.items.shift();
      if (type === 'text') this.before.set(payload.type, payload);
    }
  }

  // The items of a saved file; text comes before its picture.
  saved() {
    const first = this.items.find((item) => item[1] === 'picture')?.[0] ?? 0;
    const head = STATE.filter((type) => this.before.has(type)).map((type) => [0, 'text', this.before.get(type)]);
    const rest = this.items.map(([time, type, payload]) => [Math.max(0, Math.round((time - first) * 1e6) / 1e3), type,
      type === 'picture' ? base64(new Uint8Array(payload)) : payload]);
    return [...head, ...rest].map(([ms, type, payload]) => [ms, type,
      payload.type === 'hello' ? { ...payload, kind: 'saved', may_push: false } : payload]);
  }
}

export function base64(octets) {
  const pieces = [];
  for (let i = 0; i < octets.length; i += 0x6000) pieces.push(String.fromCharCode(...octets.subarray(i, i + 0x6000)));
  return btoa(pieces.join(''));
}
