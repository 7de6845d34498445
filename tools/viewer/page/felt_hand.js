// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What people hold and feel: a gamepad that is a hand, its rumble, and the vibration of a phone.
import { Feeling } from './feeling.js';
import { PadHand } from './pad_hand.js';
import { Motor, RUMBLE, VIBRATION } from './rumble.js';
import { byId } from './words.js';

export class FeltHand {
  // `page` has hand, stage, log, moment, newer and timeLine.
  constructor(page) {
    this.page = page;
    this.pads = new PadHand(page);
    this.feeling = new Feeling(page);
    this.rumble = new Motor(RUMBLE);
    this.vibration = new Motor(VIBRATION);
    this.vibrates = byId('vibrate');
    byId('vibrates').hidden = typeof navigator.vibrate !== 'function' || !(navigator.maxTouchPoints > 0);
    addEventListener('blur', () => this.stop());
    document.addEventListener('visibilitychange', () => { if (document.hidden) this.stop(); });
  }

  stop() {
    this.rumble.stop();
    this.vibration.stop();
  }

  // Called once in each picture.
  advance(now, seconds) {
    const { hand, moment } = this.page;
    const pad = this.pads.advance(moment, seconds);
    const feeling = this.feeling.at(now);
    this.rumble.play(pad, feeling, now);
    const byFinger = hand.by === 'touch' && !byId('vibrates').hidden && this.vibrates.checked;
    this.vibration.play(byFinger ? navigator : null, feeling, now);
  }
}
