// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The mouse moves a hand in the plane that contains the hand and faces the camera. Wheel, shift, a
// second finger and keys move it in depth.
import { Vector3 } from './libraries.js';
import { HAND_FLAGS } from './picture.js';
import { byId } from './words.js';

const MOVES = { a: [-1, 0, 0], d: [1, 0, 0], w: [0, 1, 0], s: [0, -1, 0], q: [0, 0, 1], e: [0, 0, -1] };

export class PointerHand {
  constructor(stage, tell, say) {
    Object.assign(this, { stage, tell, say });
    this.index = null;
    this.held = false;
    this.by = null; // while it is held: kind of the pointer that was pressed, or pad
    this.grabs = false;
    this.wanted = new Vector3();
    this.keys = new Set();
    this.button = byId('hand');
    this.text = byId('hand-text');
    this.button.addEventListener('click', () => this.askOrGive());
    addEventListener('blur', () => this.release());
    document.addEventListener('visibilitychange', () => { if (document.hidden) this.release(); });
    setInterval(() => this.send(), 16);
  }

  askOrGive() {
    if (!byId('push').hidden && !this.stale && this.button.hidden) {
      this.say('Nothing here has a hand.');
    } else if (byId('push').hidden || this.button.hidden) {
      this.say('This page can only watch: open the address that the program printed, with its word.');
    } else if (this.index === null) {
      this.tell('askHand');
      this.say('Requested a hand.');
    } else {
      this.release();
      this.tell('giveHand');
      this.say('Released the hand.');
    }
  }

  // `stale`: this tab has the word of an earlier program.
  showStale(stale) {
    this.stale = stale;
    this.offer(0);
    this.text.textContent = stale ? 'The program was started anew, with a new word. To take a hand, open the address that it printed.' : '';
  }

  // The number of hands of the world.
  offer(hands) {
    this.button.hidden = this.stale || hands === 0;
    this.button.parentElement.hidden = this.button.hidden && !this.stale;
  }

  answer({ index, text }) {
    this.index = Number.isInteger(index) ? index : null;
    this.held = false;
    this.by = null;
    this.button.textContent = this.index === null ? 'Take a hand' : 'Release it';
    const how = matchMedia('(pointer: coarse)').matches ? 'One finger moves it, a second one moves it in depth. Lifting the first releases it.'
      : 'Move the mouse; wheel or shift for depth; the button holds the touched object. Leaving the picture releases the hand.';
    this.text.textContent = this.index === null ? (text ?? '') : how;
    if (text) this.say(text);
    if (this.index !== null && this.stage.large !== 'touch') this.stage.swap();
  }

  hand(moment) { return moment.hands.find((hand) => hand.index === this.index); }
  get camera() { return this.stage.view('touch').orbit; }

  // Metres per pixel at the hand.
  get metresPerPixel() {
    const { camera } = this.camera;
    const depth = this.wanted.clone().sub(camera.position).length();
    return (2 * depth * Math.tan((camera.fov * Math.PI) / 360)) / Math.max(1, this.stage.canvas.clientHeight);
  }

  // Distance of a place in front of the hand, towards the camera [pixels].
  depthTo(place) {
    const forward = this.camera.camera.getWorldDirection(new Vector3());
    return -new Vector3().fromArray(place).sub(this.wanted).dot(forward) / this.metresPerPixel;
  }

  grip(moment) {
    if (this.held) return true;
    const hand = moment && this.hand(moment);
    if (!hand) return false;
    this.wanted.fromArray(hand.position);
    this.held = true;
    return true;
  }

  // Moves the hand to the pointer at a place of the large picture [pixels].
  move(moment, x, y) {
    if (this.index === null || this.stage.large !== 'touch' || !this.grip(moment)) return;
    const { camera } = this.camera;
    const { width, height } = this.stage.view('touch').rectangle;
    const forward = camera.getWorldDirection(new Vector3());
    const ray = new Vector3((2 * x) / width - 1, 1 - (2 * y) / height, 0.5).unproject(camera).sub(camera.position).normalize();
    const along = this.wanted.clone().sub(camera.position).dot(forward) / ray.dot(forward);
    this.wanted.copy(camera.position).addScaledVector(ray, along);
  }

  // Moves the hand towards the camera by some pixels.
  deepen(moment, pixels) {
    if (this.index === null || !this.grip(moment)) return;
    const step = this.metresPerPixel * pixels;
    this.wanted.addScaledVector(this.camera.camera.getWorldDirection(new Vector3()), -step);
  }

  key(key, down) {
    if (this.index === null || !MOVES[key]) return false;
    if (down) this.keys.add(key); else this.keys.delete(key);
    return true;
  }

  release() {
    this.keys.clear();
    if (!this.held) return;
    this.held = false;
    this.by = null;
    this.grabs = false;
    this.tell('pointer', this.index, this.wanted.toArray(), false, false);
  }

  // Called 60 times a second, independent of the drawing rate, because a hand without samples is
  // released.
  send() {
    if (this.index !== null && this.held) this.tell('pointer', this.index, this.wanted.toArray(), true, this.grabs);
  }

  // Called once in each picture.
  advance(moment, seconds) {
    if (this.index === null) return;
    if (this.keys.size && this.grip(moment)) this.moveByKeys(seconds);
    const hand = this.hand(moment);
    const stopped = !!hand && (hand.flags & HAND_FLAGS.stopped) !== 0;
    if (stopped && !this.stopped) this.say('All forces are stopped, by the software stop.', 'warning');
    this.stopped = stopped;
    if (hand && hand.flags & HAND_FLAGS.forceCut && !this.told) this.say('The force was cut; it returns when readings are normal.', 'warning');
    this.told = !!hand && (hand.flags & HAND_FLAGS.forceCut) !== 0;
  }

  moveByKeys(seconds) {
    for (const key of this.keys) this.shift(MOVES[key], 160 * Math.min(seconds, 0.1));
  }

  // Moves the hand right, up and away, each by a share of some pixels.
  shift(shares, pixels) {
    const step = this.metresPerPixel * pixels;
    const matrix = this.camera.camera.matrixWorld;
    shares.forEach((share, k) => {
      this.wanted.addScaledVector(new Vector3().setFromMatrixColumn(matrix, k), (k === 2 ? -share : share) * step);
    });
  }
}
