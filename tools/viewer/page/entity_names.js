// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names beside the entities of an exercise, with their speeds where there is room for both. What
// has no room at all is named under the pointer.
import { NONE } from './picture.js';
import { foreign, speedText } from './words.js';

const MOST_NAMES = 60;
const MOST_ROOM = 1200; // symbols that no name covers
const CROWD = 300; // of so many, fewer are named
const NAMES_OF_CROWD = 24;
const TALL = 16; // [pixels], of a line

export class EntityNames {
  constructor(view, labels) {
    Object.assign(this, { view, labels });
    this.sides = new Map(); // slot -> where its name was last
  }

  // `sizeAt(i, x, y, z)`: radius as drawn [m].
  draw(moment, rows, sizeAt) {
    if (this.view.rectangle.width <= 300) return;
    const symbols = this.symbols(moment, sizeAt);
    for (const { left, top, half } of symbols) {
      const room = Math.min(half, 9 + 0.4 * half); // long ones are slender
      this.labels.take(left - room, top - room, left + room, top + room);
    }
    for (const symbol of symbols.slice(0, symbols.length > CROWD ? NAMES_OF_CROWD : MOST_NAMES)) this.name(moment, rows[symbol.i], symbol);
  }

  // In the picture, the followed one first.
  symbols({ count, shown, picture, followed }, sizeAt) {
    const all = [];
    const { width, height } = this.view.rectangle;
    for (let i = 0; i < count && all.length < MOST_ROOM; ++i) {
      const [x, y, z] = shown.subarray(3 * i, 3 * i + 3);
      const at = this.labels.placed(this.view, x, y, z);
      if (!at || at[0] < 0 || at[1] < 0 || at[0] > width || at[1] > height) continue;
      all.push({ i, left: at[0], top: at[1], half: Math.min(80, this.view.pixels(sizeAt(i, x, y, z), [x, y, z])) });
    }
    const first = followed === NONE ? -1 : all.findIndex(({ i }) => picture.slot(i) === followed);
    if (first > 0) all.unshift(...all.splice(first, 1));
    return all;
  }

  name(moment, row, { i, left, top, half }) {
    const slot = moment.picture.slot(i);
    const name = foreign(moment.name(slot), 24);
    for (const text of [`${name}\u2002${speedText(moment.picture.speed(i))}`, name]) {
      const width = this.labels.widthOf(text);
      const ways = [[left - width / 2, top - half - TALL - 3], [left - width / 2, top + half + 3], [left + half + 5, top - TALL / 2], [left - half - 5 - width, top - TALL / 2]];
      const last = this.sides.get(slot) ?? 0;
      for (const k of [last, ...[0, 1, 2, 3].filter((other) => other !== last)]) {
        if (!this.labels.claim(...ways[k], width, TALL)) continue;
        this.sides.set(slot, k);
        this.labels.write(ways[k][0] + width / 2, ways[k][1], text, slot === moment.followed ? 'entity chosen' : 'entity');
        return;
      }
    }
  }
}
