// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The state of the followed entity of an exercise, in words.
import { degrees, headingOf } from './geodesy.js';
import { CAUSES, NONE } from './picture.js';
import { digits, element, foreign, speedText } from './words.js';

// Term of each row, and its text of the moment, the entity's row of the roster and its index.
const ROWS_OF_CARD = [
  ['type', (moment, row) => [row?.type || row?.kind, row?.type_numbers]],
  ['side', (moment, row) => [row?.side]],
  ['place', (moment, row, i) => placeText(moment.geodeticOf(placeAt(moment, i)))],
  ['speed', ({ picture }, row, i) => [speedText(picture.speed(i)), `${digits(3.6 * picture.speed(i))} km/h`]],
  ['heading', (moment, row, i) => [`${headingOf(moment.turns.subarray(4 * i, 4 * i + 4), moment.frameAt(placeAt(moment, i))).toFixed(0).padStart(3, '0')}°`]],
  ['last update', ({ picture }, row, i) => [`${digits(Math.max(0, picture.age(i)), 2)} s ago`, CAUSES[picture.cause(i)]]],
  ['Hz', ({ picture }, row, i) => [`${digits(picture.rate(i), 2)} a second`]],
  ['owner', (moment, row) => [row?.peer && `${row.peer} (site : application)`, row?.host]],
];
const NEEDS_ENTITY = ['place', 'speed', 'heading', 'last update', 'Hz'];

function placeAt({ shown }, i) { return [...shown.subarray(3 * i, 3 * i + 3)]; }

function placeText(at) { return at ? [`${degrees(at.lat, 5, 'NS')}, ${degrees(at.lon, 5, 'EW')}`, `height ${at.height.toFixed(0)} m`] : ['–']; }

export class EntityCard {
  constructor(host, close) {
    this.host = host;
    this.title = host.querySelector('h2');
    this.id = host.querySelector('small');
    this.cells = ROWS_OF_CARD.map(([term]) => {
      const head = element('dt', '', term === 'Hz' ? 'rate' : term);
      head.dataset.term = term;
      head.tabIndex = 0;
      const [words, more] = [element('span'), element('small')];
      host.querySelector('dl').append(head, element('dd', '', '', words, more));
      return [words, more];
    });
    host.querySelector('button').addEventListener('click', close);
  }

  draw(moment, large) {
    const { followed } = moment;
    const shown = followed !== NONE && moment.exercise && large === 'world' && !!moment.picture;
    if (this.host.hidden === shown) this.host.hidden = !shown;
    if (!shown) return;
    const row = moment.roster.get(followed);
    const i = moment.picture.indexOf(followed);
    put(this.title, foreign(moment.name(followed), 24));
    put(this.id, i < 0 ? 'not received at this instant' : foreign(row?.id ?? '', 24));
    ROWS_OF_CARD.forEach(([term, textOf], k) => {
      const texts = i < 0 && NEEDS_ENTITY.includes(term) ? ['–'] : textOf(moment, row, i);
      this.cells[k].forEach((cell, n) => put(cell, foreign(texts[n] ?? '', 80)));
    });
  }
}

function put(cell, text) { if (cell.textContent !== text) cell.textContent = text; }
