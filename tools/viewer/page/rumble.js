// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shows what a hand feels by the motors of a gamepad or of a phone. Each command lasts at most 100 ms,
// so that nothing runs on when the page stalls.

export const FULL_FORCE = 5; // [N] at which the strong motor is at its full
export const FULL_SLIP = 0.2; // [m/s] at which the weak motor is
const COMMAND_MS = 100; // [ms], duration of one command
const ONSET = 0.8; // both motors, as a contact begins
const ONSET_LENGTH = 60; // [ms]
const ONSETS_APART = 150; // [ms]; a contact that flickers is no drum
const FAINTEST = 0.01; // a weaker magnitude is none
const SHORTEST_PULSE = 10; // [ms] of a phone

const share = (x, full) => (x > 0 ? Math.min(1, x / full) : 0); // of NaN: 0

// Magnitudes of the two motors, 0 to 1. @param begins whether the contact has just begun
export function magnitudes({ newtons, touches, slip }, begins) {
  const least = begins ? ONSET : 0;
  return { strongMagnitude: Math.max(least, share(newtons, FULL_FORCE)), weakMagnitude: Math.max(least, touches ? share(slip, FULL_SLIP) : 0) };
}

// Length of a phone's pulse in each 100 ms.
export function pulse({ newtons, touches }, begins) {
  const duty = touches ? share(newtons, FULL_FORCE) : 0;
  const least = begins ? ONSET_LENGTH : duty > FAINTEST ? SHORTEST_PULSE : 0;
  return Math.max(least, Math.round(COMMAND_MS * duty));
}

export function canRumble(pad) {
  const actuator = pad?.vibrationActuator;
  return typeof actuator?.playEffect === 'function' && (actuator.effects?.includes('dual-rumble') ?? true);
}

// A call that a browser may refuse at once or later.
function attempt(call) {
  try {
    call()?.catch?.(() => {});
  } catch { /* this browser has no such motor */ }
}

// Sends commands to one kind of motor: at the begin of a contact at once, else each `period`.
// `start` returns whether the motor runs.
export class Motor {
  constructor(kind) {
    this.kind = kind;
    this.onset = 0; // of the last contact whose begin was shown
  }

  // @param of the pad or browser that has the motor @param feeling of Feeling, or null: it stops
  play(of, feeling, now) {
    if (!of || !feeling) return this.stop();
    const begins = feeling.onset !== this.onset && !(now - this.began < ONSETS_APART);
    if (!begins && now - this.at < this.kind.period) return undefined;
    if (begins) this.began = now;
    [this.onset, this.at] = [feeling.onset, now];
    if (!this.kind.start(of, feeling, now - this.began < ONSET_LENGTH)) return this.still();
    return (this.of = of);
  }

  still() {
    if (this.of) attempt(() => this.kind.stop(this.of));
    this.of = null;
  }

  stop() {
    this.still();
    this.began = this.at = undefined;
  }
}

export const RUMBLE = {
  period: 50, // [ms]
  start(pad, feeling, begins) {
    const wanted = magnitudes(feeling, begins);
    const runs = canRumble(pad) && Math.max(...Object.values(wanted)) >= FAINTEST;
    if (runs) attempt(() => pad.vibrationActuator.playEffect('dual-rumble', { startDelay: 0, duration: COMMAND_MS, ...wanted }));
    return runs;
  },
  stop: (pad) => pad.vibrationActuator.reset?.(),
};

export const VIBRATION = {
  period: COMMAND_MS,
  start(browser, feeling, begins) {
    const length = pulse(feeling, begins);
    if (length > 0) attempt(() => browser.vibrate(length));
    return length > 0;
  },
  stop: (browser) => browser.vibrate(0),
};
