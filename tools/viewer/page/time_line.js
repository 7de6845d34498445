// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Pause, back, forward, speed, and the slider over the last minute or the whole capture. The source
// keeps the time; this code sends requests to it.
import { byId, clock, element } from './words.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16];

export class TimeLine {
  // `tell(name, value)` sends a request to the source; `say(text)` logs.
  constructor(tell, say) {
    this.tell = tell;
    this.say = say;
    this.state = 'live';
    this.speed = 1;
    this.span = [0, 0];
    this.time = 0;
    this.whole = false; // a capture or a saved file: nothing is live
    byId('play').addEventListener('click', () => this.playOrPause());
    byId('back').addEventListener('click', () => this.step(-2));
    byId('on').addEventListener('click', () => this.step(2));
    byId('back-second').addEventListener('click', () => this.step(-1));
    byId('on-second').addEventListener('click', () => this.step(1));
    byId('live').addEventListener('click', () => this.live());
    this.slider = byId('slider');
    this.slider.addEventListener('input', () => { this.wanted = Number(this.slider.value); });
    this.slider.addEventListener('change', () => this.say(`Time ${this.words(Number(this.slider.value))}.`));
    for (const one of SPEEDS) byId('speed').append(element('option', '', `${one} ×`));
    byId('speed').selectedIndex = SPEEDS.indexOf(1);
    byId('speed').addEventListener('change', () => this.setSpeed(SPEEDS[byId('speed').selectedIndex]));
  }

  hello({ kind, span }) {
    this.whole = kind === 'capture' || kind === 'saved';
    if (Array.isArray(span)) this.setSpan(span);
    byId('live').hidden = this.whole;
    this.paint();
  }

  setSpan([from, to]) {
    if (Number.isFinite(from) && Number.isFinite(to) && to >= from) this.span = [from, to];
  }

  play(message) {
    this.state = message.state;
    if (message.speed > 0) {
      this.speed = message.speed;
      const nearest = SPEEDS.reduce((best, one) => (Math.abs(one - message.speed) < Math.abs(best - message.speed) ? one : best));
      byId('speed').selectedIndex = SPEEDS.indexOf(nearest);
    }
    this.paint();
  }

  get still() { return this.state === 'paused' || this.state === 'end'; }

  playOrPause() {
    if (this.still) {
      const from = this.state === 'end' ? this.span[0] : this.time; // at the end it begins anew
      this.tell('speed', this.speed || 1);
      this.say(`Plays at ${this.speed || 1} × from ${this.words(from)}.`);
    } else {
      this.tell('speed', 0);
      this.say(`Paused at ${this.words(this.time)}; the exercise continues.`);
    }
  }

  setSpeed(speed) {
    this.speed = speed;
    if (!this.still) this.tell('speed', speed);
    this.say(`Speed ${speed} ×.`);
  }

  faster(by) {
    const at = SPEEDS.indexOf(this.speed) + by;
    if (at >= 0 && at < SPEEDS.length) {
      byId('speed').selectedIndex = at;
      this.setSpeed(SPEEDS[at]);
    }
  }

  step(by) {
    this.tell('step', by);
    const what = Math.abs(by) === 1 ? '1 s' : 'One update';
    this.say(`${what} ${by < 0 ? 'back' : 'on'}.`);
  }

  live() {
    this.tell('live');
    this.say(this.whole ? 'The end.' : 'Live.');
  }

  words(time) {
    if (this.whole) return clock(time - this.span[0]);
    const back = this.span[1] - time;
    return back < 0.15 ? 'now' : `${back.toFixed(1)} s ago`;
  }

  // Called once in each picture: sends one request for the slider's last place, regardless of its
  // speed.
  advance(time) {
    if (this.wanted !== undefined) {
      this.tell('seek', this.wanted);
      this.wanted = undefined;
      return;
    }
    this.time = time;
    this.span[1] = Math.max(this.span[1], this.whole ? this.span[1] : time);
    if (this.slider.matches(':active')) return;
    this.slider.min = this.span[0];
    this.slider.max = this.span[1];
    this.slider.value = time;
  }

  paint() {
    document.body.dataset.play = this.state;
    byId('play').textContent = this.still ? 'Play' : 'Pause';
    byId('live').classList.toggle('on', this.state === 'live');
  }

  paintClock() {
    const length = this.span[1] - this.span[0];
    byId('clock').textContent = this.whole ? `${clock(this.time - this.span[0])} of ${clock(length)}` : this.words(this.time);
  }
}
