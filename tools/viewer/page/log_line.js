// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The last action, in one line; a press shows the last twenty.
import { element, foreign } from './words.js';

const LINES = 20;

export class LogLine {
  constructor() {
    this.button = document.getElementById('log');
    this.line = document.getElementById('log-line');
    this.list = document.getElementById('log-list');
    this.button.addEventListener('click', () => this.toggle());
  }

  say(text, level = 'info') {
    const words = foreign(text, 240);
    this.line.textContent = words;
    this.line.className = level === 'warning' ? 'warning' : '';
    const when = new Date().toTimeString().slice(0, 8);
    this.list.prepend(element('li', this.line.className, `${when}  ${words}`));
    while (this.list.children.length > LINES) this.list.lastChild.remove();
  }

  toggle() {
    this.list.hidden = !this.list.hidden;
    this.button.setAttribute('aria-expanded', String(!this.list.hidden));
  }
}
