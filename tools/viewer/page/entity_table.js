// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities with rate, cause of the last update, jump, cell and group. Rows are sorted every 2 s,
// but not under the pointer.
import { CAUSES, NONE } from './picture.js';
import { digits, element, foreign } from './words.js';

const ROWS = 40;
const PERIOD = 2000; // [ms]
const COLUMNS = [
  { says: 'entity', key: (moment, i) => moment.name(moment.picture.slot(i)), text: (x) => foreign(x, 24), words: true },
  { says: 'Hz', key: ({ picture }, i) => picture.rate(i), text: (x) => digits(x, 2) },
  { says: 'cause', key: ({ picture }, i) => CAUSES[picture.cause(i)] ?? '?', text: (x) => x, words: true },
  { says: 'jump', unit: 'mm', key: ({ picture }, i) => picture.jump(i), text: (x) => (x === NONE ? '>65 m' : digits(x)) },
  { says: 'cell', key: ({ picture }, i) => picture.cell(i), text: (x) => (x === NONE ? '–' : String(x)) },
  { says: 'group', key: ({ picture }, i) => picture.group(i), text: (x) => (x ? `${x >> 8}.${x & 255}` : '–') },
];

export class EntityTable {
  constructor(host, follow) {
    this.order = [];
    this.sorted = -Infinity;
    this.by = 3;
    this.down = true;
    this.heads = COLUMNS.map((column, k) => {
      const head = element('button', '', column.says);
      head.dataset.term = column.says;
      if (column.unit) head.append(element('small', '', ` ${column.unit}`));
      head.addEventListener('click', () => this.sortBy(k));
      return head;
    });
    this.body = element('tbody');
    this.slots = []; // of the rows
    this.rows = Array.from({ length: ROWS }, (_, k) => {
      const row = element('tr', '', '', ...COLUMNS.map((column) => element('td', column.words ? 'words' : '')));
      row.tabIndex = 0;
      row.hidden = true;
      row.addEventListener('click', () => follow(this.slots[k]));
      row.addEventListener('keydown', (event) => { if (event.key === 'Enter') follow(this.slots[k]); });
      return row;
    });
    this.body.append(...this.rows);
    this.body.addEventListener('pointerenter', () => { this.held = true; });
    this.body.addEventListener('pointerleave', () => { this.held = false; });
    const heads = this.heads.map((head, k) => element('th', COLUMNS[k].words ? 'words' : '', '', head));
    host.append(element('table', '', '', element('thead', '', '', element('tr', '', '', ...heads)), this.body));
    this.mark();
  }

  sortBy(k) {
    this.down = this.by === k ? !this.down : !COLUMNS[k].words;
    this.by = k;
    this.sorted = -Infinity;
    this.mark();
  }

  mark() {
    this.heads.forEach((head, k) => {
      head.parentElement.setAttribute('aria-sort', k !== this.by ? 'none' : this.down ? 'descending' : 'ascending');
    });
  }

  draw(moment, now) {
    const { picture } = moment;
    if (!this.held && now - this.sorted > PERIOD) {
      this.sorted = now;
      const { key } = COLUMNS[this.by];
      const list = Array.from({ length: moment.count }, (_, i) => [key(moment, i), picture.slot(i)]);
      const sign = this.down ? -1 : 1;
      list.sort(([a], [b]) => sign * (a < b ? -1 : a > b ? 1 : 0));
      this.order = list.slice(0, ROWS).map(([, slot]) => slot);
    }
    this.rows.forEach((row, k) => {
      const i = k < this.order.length ? picture.indexOf(this.order[k]) : -1;
      if (row.hidden !== (i < 0)) row.hidden = i < 0;
      if (i < 0) return;
      this.slots[k] = this.order[k];
      const name = this.slots[k] === moment.followed ? 'followed' : '';
      if (row.className !== name) row.className = name;
      COLUMNS.forEach((column, c) => {
        const text = column.text(column.key(moment, i));
        if (row.cells[c].textContent !== text) row.cells[c].textContent = text;
      });
    });
  }
}
