// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A gamepad as the user's hand: the first pad that is used holds it until the hand is released.
import { Vector3 } from './libraries.js';
import { connectedPads, padName, readPad } from './gamepad.js';
import { canRumble } from './rumble.js';
import { byId } from './words.js';

const FASTEST = 240; // [pixels/s] of the hand at a full stick
const LEASH = 60; // [pixels] from the hand to where the stick wants it, so that turning back acts soon

export class PadHand {
  // `page` has hand, stage and log.
  constructor(page) {
    this.page = page;
    this.known = new Map(); // index -> name, and the buttons at the last look
    this.holder = null; // index of the pad that moves the hand
    this.text = byId('pad');
  }

  get hand() { return this.page.hand; }

  // Called once in each picture. Returns the pad that moves the hand, or null.
  advance(moment, seconds) {
    const pads = connectedPads();
    this.compare(pads);
    if (this.hand.by !== 'pad') this.holder = null;
    if (document.hasFocus()) for (const pad of pads) this.lead(pad, moment, Math.min(seconds, 0.1));
    const holder = pads.find(({ index }) => index === this.holder) ?? null;
    this.write(pads, holder);
    return this.hand.held ? holder : null;
  }

  // States which pads came and went. A hand whose pad went is released.
  compare(pads) {
    const names = new Map(pads.map((pad) => [pad.index, padName(pad)]));
    for (const [index, { name }] of this.known) {
      if (names.get(index) === name) continue;
      this.known.delete(index);
      const held = index === this.holder && this.hand.held;
      if (held) this.hand.release();
      this.page.log.say(`“${name}” is disconnected${held ? `; hand ${this.hand.index + 1} is released` : ''}.`, 'warning');
    }
    for (const [index, name] of names) {
      if (this.known.has(index)) continue;
      this.known.set(index, { name, first: false, second: false, grabs: false });
      this.page.log.say(`“${name}” is connected.`);
    }
  }

  lead(pad, moment, seconds) {
    if (pad.mapping !== 'standard' || (this.holder ?? pad.index) !== pad.index) return;
    const { hand } = this;
    const before = this.known.get(pad.index);
    const { motion, moves, first, second } = readPad(pad);
    const [pressed, gives] = [first && !before.first, second && !before.second];
    Object.assign(before, { first, second, grabs: first && (before.grabs || (pressed && hand.index !== null)) });
    if (hand.index === null ? pressed : gives) hand.askOrGive();
    else if (hand.index !== null) this.move(pad, moment, motion, moves || pressed, before.grabs, seconds);
  }

  move({ index }, moment, motion, used, grabs, seconds) {
    const { hand } = this;
    if (used && this.page.stage.large === 'touch' && hand.grip(moment)) {
      hand.by = 'pad';
      this.holder = index;
    }
    if (this.holder !== index || !hand.held) return;
    hand.grabs = grabs;
    hand.shift(motion, FASTEST * seconds);
    const at = new Vector3().fromArray((hand.hand(moment) ?? { position: hand.wanted.toArray() }).position);
    hand.wanted.sub(at).clampLength(0, LEASH * hand.metresPerPixel).add(at);
  }

  write(pads, holder) {
    const pad = holder ?? pads.find(({ mapping }) => mapping === 'standard') ?? pads[0];
    this.text.hidden = !pad || this.hand.button.hidden;
    this.hand.text.hidden = !!holder; // it is about the mouse
    const text = pad ? this.words(pad, pad === holder) : '';
    if (this.text.textContent !== text) this.text.textContent = text;
  }

  words(pad, holds) {
    const name = `“${padName(pad)}”`;
    if (pad.mapping !== 'standard') return `${name}: this browser does not know its layout, so it moves no hand here.`;
    if (this.hand.index === null) return `${name}: its button A (or ✕) takes a hand.`;
    const moves = holds ? `${name} moves hand ${this.hand.index + 1}; the mouse turns the picture.` : `${name}: a stick moves hand ${this.hand.index + 1}.`;
    const rumbles = canRumble(pad) ? 'Its rumble has no direction and no newtons.' : 'It has no rumble in this browser.';
    return `${moves} Right stick or triggers: depth. A (✕) holds what it touches, B (○) releases the hand. ${rumbles}`;
  }
}
