// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The words around the picture: numbers at the top, state and age, the sentence above the picture,
// the notice over an empty one, and the tip at the pointer.
import { NONE } from './picture.js';
import { sentence } from './sentence.js';
import { bitRate, byId, digits, foreign, speedText } from './words.js';

const LATE = 1; // [s]: an older picture is not called live
const PLAY_WORDS = { live: 'live', playing: 'playing', paused: 'paused', end: 'at the end' };

function write(id, text) {
  const host = byId(id);
  if (host.textContent !== text) host.textContent = text;
}

export class Status {
  // `page` has moment, newer, state, least, source, stage, steering, timeLine and filled.
  constructor(page) {
    this.page = page;
    this.age = null;
  }

  // Called some times a second.
  look(now) {
    const { moment, newer } = this.page;
    const { numbers } = moment;
    if (newer) write('n-entities', moment.count.toLocaleString('en'));
    write('n-pdu', digits(numbers.pdu_per_s));
    write('n-bits', bitRate(numbers.bit_per_s));
    const ratio = numbers.raw_bit_per_s / numbers.bit_per_s;
    write('n-ratio', Number.isFinite(ratio) ? `${digits(ratio)} ×` : '–');
    this.lookAtState(now);
    this.lookAtNotice();
    this.lookAtFollowed();
    this.lookAtCamera();
    this.tip();
  }

  lookAtState(now) {
    const { newer, state, least, timeLine } = this.page;
    const fresh = newer && state === 'live' && timeLine.state === 'live' && Number.isFinite(least);
    this.age = fresh ? now / 1000 - newer.picture.time - least : null;
    const late = this.age > LATE;
    document.body.classList.toggle('late', late);
    const word = late ? 'late' : PLAY_WORDS[timeLine.state] ?? timeLine.state;
    write('state-word', state === 'live' ? word : state === 'lost' ? 'no server' : 'connecting');
    write('age', fresh ? `${this.age.toFixed(2)} s old` : '');
  }

  lookAtNotice() {
    const { moment, newer, state, source, stage, timeLine, filled } = this.page;
    const first = moment.hello.first_entity;
    const early = timeLine.whole && newer?.picture.time < first - 0.02;
    const held = early ? first - timeLine.span[0] : filled.holds ? moment.time - timeLine.span[0] : null;
    write('says', newer ? sentence(moment, stage.large, held) : '');
    const lost = state === 'lost';
    const nobody = !moment.count && !moment.hands.length && !moment.touch.solids.length && !(timeLine.whole && moment.roster.size);
    const empty = newer ? nobody : state === 'live';
    const notice = byId('notice');
    notice.hidden = !lost && !empty;
    if (notice.hidden) return;
    const bye = lost && source.bye;
    notice.querySelector('h2').textContent = bye ? 'Closed' : lost ? 'No server' : timeLine.whole ? 'No entities' : 'No entity received yet';
    notice.querySelector('p').textContent = bye ? `${foreign(bye, 300)}. The page reconnects by itself.` : lost
      ? 'The program has ended, or the connection is lost. The page reconnects by itself; this is the last picture.'
      : foreign(moment.hello.help || 'Start a peer: reckon peer SCENE, or reckon demo.', 300);
  }

  lookAtFollowed() {
    const { moment } = this.page;
    const { cells } = moment.cells;
    const heard = moment.heardBy(moment.followed).size;
    const name = foreign(moment.name(moment.followed), 30);
    const at = moment.picture?.indexOf(moment.followed) ?? -1;
    const by = cells.find(({ cell }) => at >= 0 && cell === moment.picture.cell(at))?.heard_by.length;
    const all = cells.length > 1 ? `${cells.length} cells; click an entity to see its cells` : '';
    const own = cells.length ? `${name} receives ${heard} of ${cells.length} ${cells.length === 1 ? 'cell' : 'cells'}` : '';
    write('hearing', moment.followed === NONE ? all : `${own}${own && by !== undefined ? `, ${by} receive it` : ''}`);
  }

  lookAtCamera() {
    const { moment, stage } = this.page;
    const lead = byId('lead');
    lead.hidden = !moment.exercise || stage.large !== 'world';
    lead.setAttribute('aria-pressed', String(stage.auto.on));
  }

  tip() {
    const { moment, newer, stage, steering } = this.page;
    const { mouse } = steering;
    const tip = byId('tip');
    const slot = mouse && newer && stage.large === 'world' ? stage.pick(moment, ...mouse) : -1;
    tip.hidden = slot < 0;
    if (slot < 0) return;
    const row = moment.roster.get(slot);
    const speed = moment.exercise ? speedText(moment.picture.speed(moment.picture.indexOf(slot))) : null;
    tip.textContent = [moment.name(slot), row?.id, row?.kind, speed].filter(Boolean).map((text) => foreign(text, 40)).join(' · ');
    tip.style.transform = `translate(${mouse[0] + 14}px, ${mouse[1] + 14}px)`;
  }
}
