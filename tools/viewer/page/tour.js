// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A tour of five steps through a demo. It goes on by itself when a step is done, and does not come
// back once it was left.
import { shownTwin } from './twins.js';
import { byId } from './words.js';

const KEPT = 'reckon-tour';
const PRESSED = 0.5; // [N]
const SHAKEN = 1; // [N] between a hand and its twin
const PAUSE = 1500; // [ms] for which a step that is done stays

// `at`: what is outlined. `done(page)`: null if only `Next` goes on.
const STEPS = [
  { title: 'Take a hand', at: 'hand', done: ({ hand }) => hand.index !== null,
    text: 'Press “Take a hand”. Your mouse is then one of the two hands; on a touch screen your finger is.' },
  { title: 'Press something', at: null, done: ({ moment, hand }) => (hand.hand(moment)?.newtons ?? 0) > PRESSED,
    text: 'Move your ball against the other one, or the stone. The wheel moves it in depth, and the number at the thin line is the distance to the nearest surface. The arrow is the force that you would feel.' },
  { title: 'Make the network slow', at: 'delay', done: ({ network }) => Number(network.inputs.delay.value) >= 150,
    text: 'Set the delay to 150 ms: as if the other hand were on another continent. Press it again: the force stays calm.' },
  { title: 'See the twin shake', at: 'plot-force', done: shaken,
    text: 'The pink line is the same hand without Reckon’s energy gate. While the two hands press each other at this delay, it swings; the hand itself does not.' },
  { title: 'Read the energy', at: 'plot-energy', done: null,
    text: 'This plot says why. The pink line falls: without the gate the contact makes energy out of nothing. The hands stay above their dashed loan. “?” lists all keys and marks.' },
];

function shaken({ moment }) {
  const hand = moment.hands.find(({ index }) => index === shownTwin(moment)?.hand);
  return !!hand && hand.twin !== null && Math.abs(hand.twin - hand.newtons) > SHAKEN;
}

function recall() {
  try { return localStorage.getItem(KEPT); } catch { return null; }
}

function remember() {
  try { localStorage.setItem(KEPT, 'left'); } catch { /* a browser without storage shows it again */ }
}

export class Tour {
  // `page` has moment, hand and network.
  constructor(page, wanted) {
    this.page = page;
    this.step = null;
    this.left = wanted === 'off' || (wanted !== 'on' && recall() !== null);
    this.host = byId('tour');
    byId('tour-next').addEventListener('click', () => this.next());
    byId('tour-leave').addEventListener('click', () => this.leave());
    byId('tour-again').addEventListener('click', () => this.begin());
    addEventListener('resize', () => { if (this.step !== null) this.point(); });
  }

  // Whether there is a demo with a hand to take.
  get possible() { return !byId('push').hidden && !byId('network').hidden && !byId('twins').hidden; }

  begin() {
    byId('keys').close();
    if (this.possible) this.show(0);
  }

  // Called some times a second.
  look(now) {
    byId('tour-again').hidden = !this.possible;
    if (this.step === null) {
      if (!this.left && this.possible) this.show(0);
      return;
    }
    const { done } = STEPS[this.step];
    if (this.doneAt === null && done?.(this.page)) {
      this.doneAt = now;
      this.host.classList.add('done');
    }
    if (this.doneAt !== null && now - this.doneAt > PAUSE) this.next();
  }

  next() {
    if (this.step === STEPS.length - 1) this.leave();
    else this.show(this.step + 1);
  }

  // Ends the tour for good; false if there is none.
  leave() {
    if (this.step === null) return false;
    this.step = null;
    this.left = true;
    this.host.hidden = true;
    this.outline(null);
    remember();
    return true;
  }

  show(step) {
    const { title, text } = STEPS[step];
    this.step = step;
    this.doneAt = null;
    this.host.hidden = false;
    this.host.classList.remove('done');
    this.host.querySelector('small').textContent = `Step ${step + 1} of ${STEPS.length}`;
    this.host.querySelector('h2').textContent = title;
    this.host.querySelector('p').textContent = text;
    const last = step === STEPS.length - 1;
    byId('tour-next').textContent = last ? 'Done' : 'Next';
    byId('tour-leave').hidden = last;
    this.point();
  }

  // Outlines what the step is about, and scrolls to it where the page is narrow.
  point() {
    const { at } = STEPS[this.step];
    this.outline(at && byId(at));
  }

  outline(at) {
    document.querySelector('.toured')?.classList.remove('toured');
    at?.classList.add('toured');
    at?.scrollIntoView?.({ block: 'nearest' });
  }
}
