// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The followed entity in words: the state of an entity of an exercise, and the owner of a body.
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
const ROWS_OF_BODY = [
  ['owner', ({ hello }, { owner, ours }) => [owner ? `${owner} (site : application)` : 'none is known', ours && hello.kind === 'peer' ? 'this program' : '']],
  ['version', (moment, { version }) => [version]],
  ['hand-overs', (moment, { changes, cause }) => [String(changes), cause]],
];
const NEEDS_ENTITY = ['place', 'speed', 'heading', 'last update', 'Hz'];

function placeAt({ shown }, i) { return [...shown.subarray(3 * i, 3 * i + 3)]; }

function placeText(at) { return at ? [`${degrees(at.lat, 5, 'NS')}, ${degrees(at.lon, 5, 'EW')}`, `height ${at.height.toFixed(0)} m`] : ['–']; }

export class EntityCard {
  constructor(host, close) {
    this.host = host;
    this.title = host.querySelector('h2');
    this.id = host.querySelector('small');
    this.cells = ROWS_OF_CARD.map((row) => this.addRow(row));
    this.bodyCells = ROWS_OF_BODY.map((row) => this.addRow(row));
    host.querySelector('button').addEventListener('click', close);
  }

  addRow([term]) {
    const head = element('dt', '', term === 'Hz' ? 'rate' : term);
    head.dataset.term = term;
    head.tabIndex = 0;
    const cells = [element('span'), element('small')];
    const all = element('dd', '', '', ...cells);
    this.host.querySelector('dl').append(head, all);
    return { cells, show(shown) { head.hidden = all.hidden = !shown; } };
  }

  draw(moment, large) {
    const { followed } = moment;
    const row = moment.roster.get(followed);
    const owner = moment.ownerOf(row);
    const shown = followed !== NONE && !!moment.picture && (!!owner || (moment.exercise && large === 'world'));
    if (this.host.hidden === shown) this.host.hidden = !shown;
    if (!shown) return;
    const i = moment.picture.indexOf(followed);
    put(this.title, foreign(moment.name(followed), 24));
    put(this.id, i < 0 ? 'not received at this instant' : foreign(row?.id ?? '', 24));
    for (const line of this.cells) line.show(!owner);
    for (const line of this.bodyCells) line.show(!!owner);
    if (owner) ROWS_OF_BODY.forEach(([, textOf], k) => putAll(this.bodyCells[k], textOf(moment, owner)));
    else ROWS_OF_CARD.forEach(([term, textOf], k) => putAll(this.cells[k], i < 0 && NEEDS_ENTITY.includes(term) ? ['–'] : textOf(moment, row, i)));
  }
}

function putAll({ cells }, texts) { cells.forEach((cell, n) => put(cell, foreign(texts[n] || '', 80))); }

function put(cell, text) { if (cell.textContent !== text) cell.textContent = text; }
