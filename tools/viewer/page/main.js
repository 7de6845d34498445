// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Assembles the page: a source of pictures, the stage, plots, table, time line, and controls.
import { EntityCard } from './entity_card.js';
import { EntityTable } from './entity_table.js';
import { FeltHand } from './felt_hand.js';
import { Filled } from './filled.js';
import { listenForKeys } from './key_list.js';
import { LogLine } from './log_line.js';
import { Moment } from './moment.js';
import { NetworkPanel } from './network_panel.js';
import { NONE, PICTURE_FLAGS } from './picture.js';
import { PictureKey, listMarks } from './picture_key.js';
import { Plots } from './plots.js';
import { PointerHand } from './pointer_hand.js';
import { Recorder } from './recorder.js';
import { Replay } from './replay.js';
import { RestPanel } from './rest_panel.js';
import { download, savePage } from './saving.js';
import { Server } from './server.js';
import { Stage } from './stage.js';
import { Status } from './status.js';
import { Steering } from './steering.js';
import { Terms } from './terms.js';
import { TimeLine } from './time_line.js';
import { Tour } from './tour.js';
import { byId, digits, foreign } from './words.js';

const VERSION = 4;
const SLOW = 250; // [ms] between two updates of table and numbers
const wishes = new URLSearchParams(location.hash.slice(1)); // word, theme, main, fine, tour

class Page {
  constructor() {
    const tell = (name, ...values) => this.source.tell(name, ...values);
    const say = (text, level) => this.log.say(text, level);
    this.moment = new Moment();
    this.log = new LogLine();
    this.stage = new Stage(byId('stage'), wishes.has('fine'));
    this.key = new PictureKey(byId('key'), this.stage, say);
    this.recorder = new Recorder();
    this.plots = new Plots(byId('plots'));
    this.table = new EntityTable(byId('table'), (slot) => this.follow(slot));
    this.card = new EntityCard(byId('card'), () => { if (this.moment.followed !== NONE) this.follow(this.moment.followed); });
    this.timeLine = new TimeLine(tell, say);
    this.hand = new PointerHand(this.stage, tell, say);
    this.felt = new FeltHand(this);
    this.network = new NetworkPanel(tell, say);
    this.rest = new RestPanel(tell, say);
    this.steering = new Steering(this);
    this.status = new Status(this);
    this.terms = new Terms();
    this.tour = new Tour(this, wishes.get('tour'));
    listMarks(byId('mark-list'));
    byId('twin').addEventListener('change', () => this.showTwins(byId('twin').checked));
    this.filled = new Filled();
    this.forget();
    this.theme = wishes.get('theme');
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.paint());
    this.paint();
    this.listen();
    this.seen = { frames: 0, pictures: 0, work: 0, longest: 0 };
    this.open();
  }

  // Discards the state of an earlier connection.
  forget() {
    this.older = null;
    this.newer = null;
    this.slow = 0;
    this.least = Infinity;
    this.filled.clear();
    this.moment.reset();
    this.rest.show(false);
    this.stage.auto.forget();
    this.recorder.clear();
    this.plots.clear();
  }

  open() {
    const hear = {
      text: (message) => this.text(message), picture: (picture) => this.picture(picture),
      state: (state, text) => this.connection(state, text), bad: (text) => this.log.say(`Refused: ${text}`, 'warning'),
    };
    const saved = byId('saved');
    if (saved) {
      document.body.classList.add('saved');
      this.source = new Replay(JSON.parse(saved.textContent), hear);
      this.source.start();
      this.timeLine.setSpan(this.source.span);
    } else {
      this.source = new Server(wishes.get('word'), hear);
    }
    requestAnimationFrame((now) => this.tick(now));
  }

  connection(state, text) {
    this.state = state;
    document.body.dataset.state = state;
    if (state === 'lost') {
      this.hand.answer({ index: null });
      this.log.say(text, 'warning');
    }
    this.stage.restless = true;
  }

  text(message) {
    this.recorder.text(message);
    const { moment } = this;
    const take = {
      hello: () => this.hello(message),
      roster: () => {
        moment.roster = new Map((message.entities ?? []).map((row) => [row.slot, row]));
        ++moment.rosterNumber;
        moment.judge();
        this.choose();
      },
      origin: () => {
        moment.hello = { ...moment.hello, origin: message.origin };
        moment.setOrigin(message.origin);
      },
      cells: () => {
        moment.cells = { size: message.size || 0, shape: message.shape, cells: message.cells ?? [] };
        ++moment.cellsNumber;
      },
      groups: () => { moment.groups = { groups: message.groups ?? [], beacons: message.beacons ?? [] }; },
      touch: () => {
        moment.touch = { solids: message.solids ?? [], regions: message.regions ?? [], hands: message.hands ?? [] };
        ++moment.touchNumber;
        this.hand.offer(moment.touch.hands.length);
        moment.judge();
        this.choose();
      },
      numbers: () => {
        moment.numbers = message;
        byId('twins').hidden = !message.twin;
        this.network.follow(message.network);
        if (message.span && this.source instanceof Server) this.timeLine.setSpan(message.span);
      },
      bodies: () => {
        moment.owners = message.owners ?? [];
        this.rest.show(message.rests === true);
      },
      note: () => this.log.say(message.text, message.level),
      play: () => this.timeLine.play(message),
      bye: () => this.log.say(message.text, 'warning'),
      hand: () => this.hand.answer(message),
    }[message.type];
    take?.();
    this.stage.restless = true;
  }

  hello(message) {
    if (message.version !== VERSION) {
      this.log.say(`The program has version ${message.version} of the stream, this page ${VERSION}: reload the page.`, 'warning');
    }
    if (this.source instanceof Server) {
      this.forget();
      this.recorder.text(message);
    }
    this.moment.hello = message;
    this.moment.setOrigin(message.origin);
    this.chosen = false;
    this.timeLine.hello(message);
    byId('source').textContent = foreign(String(message.source ?? '').replace(/^.*\/(?=[^/]+\.[a-z]\w*$)/, ''), 60);
    byId('source').title = foreign(`${message.program}: ${message.source}`, 200);
    // A program that was started anew has a new word.
    const stale = !!wishes.get('word') && !message.may_push && ['demo', 'peer'].includes(message.kind);
    byId('push').hidden = !message.may_push && !stale;
    byId('network').hidden = message.kind !== 'demo' || stale;
    this.hand.showStale(stale);
    this.network.show(message.network);
    if (this.moment.followed !== NONE) this.source.tell('follow', this.moment.followed);
  }

  // What can be felt opens with the touch view large, unless the user has already chosen a view.
  choose() {
    const { roster, felt } = this.moment;
    if (this.chosen) return;
    this.chosen = felt || roster.size > 0;
    this.stage.show(wishes.get('main') ?? (felt ? 'touch' : 'world'));
  }

  picture(picture) {
    ++this.seen.pictures;
    const now = performance.now();
    const jumped = !this.newer || picture.time < this.newer.picture.time || picture.epoch !== this.newer.picture.epoch
      || (picture.flags & (PICTURE_FLAGS.gap | PICTURE_FLAGS.paused)) !== 0;
    this.older = jumped ? null : this.newer;
    const drawn = this.filled.take(picture, this.timeLine.whole);
    this.newer = { picture, drawn, came: now, credited: false };
    this.recorder.picture(picture);
    if (picture.flags & PICTURE_FLAGS.live) this.least = Math.min(this.least, now / 1000 - picture.time);
    this.moment.set(drawn, drawn, 1);
    this.plots.take(this.moment, (picture.flags & PICTURE_FLAGS.gap) !== 0);
    this.fresh = true;
  }

  // The shown moment is one picture behind, so that there is always a next picture to interpolate
  // to.
  tick(now) {
    requestAnimationFrame((next) => this.tick(next));
    const begin = performance.now();
    const seconds = Math.min(0.2, (now - (this.last ?? now)) / 1000);
    this.last = now;
    this.source.advance(begin);
    if (this.newer) this.show(begin, seconds);
    if (begin - this.slow > SLOW) {
      this.slow = begin;
      this.look(begin);
    }
    const spent = performance.now() - begin;
    this.seen.work += spent;
    this.seen.longest = Math.max(this.seen.longest, spent);
  }

  show(begin, seconds) {
    const { older, newer, moment } = this;
    if (!newer.credited) {
      newer.credited = true;
      this.source.tell('drawn', newer.picture.number);
    }
    const apart = older ? Math.min(250, Math.max(newer.came - older.came, 10)) : 1;
    const share = older ? Math.min(1, (begin - newer.came) / apart) : 1;
    const changed = this.fresh || share !== this.share;
    if (changed) moment.set(older?.drawn ?? newer.drawn, newer.drawn, share);
    this.fresh = false;
    this.share = share;
    this.timeLine.advance(newer.picture.time);
    this.hand.advance(moment, seconds);
    this.felt.advance(begin, seconds);
    if (this.stage.draw(moment, seconds, changed)) ++this.seen.frames;
    const gap = 1.2 * Math.max(1, this.timeLine.speed);
    if (begin - (this.plotted ?? 0) > 60) {
      this.plotted = begin;
      this.plots.draw(newer.picture.time, gap, this.timeLine.whole ? this.timeLine.span : null);
    }
  }

  look(now) {
    if (this.newer) this.table.draw(this.moment, now);
    this.card.draw(this.moment, this.stage.large);
    this.timeLine.paintClock();
    this.key.look();
    this.status.look(now);
    this.tour.look(now);
    this.publish();
  }

  follow(slot) {
    const { moment } = this;
    moment.followed = moment.followed === slot ? NONE : slot;
    this.source.tell('follow', moment.followed);
    this.fresh = true;
    const orbit = this.stage.view('world').orbit;
    if (moment.exercise) this.stage.restless = true;
    else if (moment.followed === NONE) this.stage.fit('world');
    else if (this.stage.view('world').extent) {
      orbit.goal.distance = Math.min(orbit.goal.distance, 1.6 * this.stage.view('world').extent.radius);
      orbit.touched = true;
    }
    this.log.say(moment.followed === NONE ? 'Follows no entity.' : `Follows ${moment.name(slot)}${moment.cells.cells.length ? '; its received cells are highlighted' : ''}.`);
  }

  // Switches the camera that keeps an exercise in the picture.
  lead(on) {
    if (!this.moment.exercise) return;
    this.stage.auto.setOn(on);
    this.stage.restless = true;
    this.fresh = true;
  }

  toggleLead() {
    this.lead(!this.stage.auto.on);
    this.log.say(this.stage.auto.on ? 'The camera keeps all in the picture.' : 'The camera stays where you move it.');
  }

  swap() {
    if (byId('inset').hidden) return;
    this.hand.release();
    this.stage.swap();
    this.log.say(`Large: ${this.stage.large}.`);
  }

  fit() {
    this.stage.fit(this.stage.large);
    this.log.say('The picture is fitted.');
  }

  turn(dx, dy) {
    this.stage.view(this.stage.large).orbit.turn(dx, dy);
    this.stage.restless = true;
  }

  zoom(factor) {
    this.stage.view(this.stage.large).orbit.zoom(factor);
    this.stage.restless = true;
  }

  toggle(...names) {
    for (const name of names) {
      const shown = this.stage.toggle(name);
      this.log.say(`${shown ? 'Shown' : 'Hidden'}: ${name}.`);
    }
    this.key.paint();
  }

  showTwins(shown) {
    this.plots.showsTwins = shown;
    this.log.say(shown ? 'Plots show what happens without the energy gate.' : 'Plots show the hands alone.');
  }

  outage() { if (!byId('network').hidden && !byId('push').hidden) this.network.toggleOutage(); }

  escape() {
    if (this.tour.leave()) this.log.say('Left the tour; it begins again from the list behind ?.');
    else if (this.hand.index !== null) this.hand.askOrGive();
    else if (this.moment.followed !== NONE) this.follow(this.moment.followed);
  }

  showKeys() { byId('keys').showModal(); }

  swapTheme() {
    this.theme = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
    this.paint();
    this.log.say(`Colours: ${this.theme}.`);
  }

  paint() {
    const dark = matchMedia('(prefers-color-scheme: dark)').matches;
    document.documentElement.dataset.theme = this.theme ?? (dark ? 'dark' : 'light');
    this.stage.paint();
    this.plots.paint();
  }

  savePicture() {
    this.stage.restless = true;
    if (this.newer) this.stage.draw(this.moment, 0, true); // the canvas must be read in the task in which it was drawn
    this.stage.canvas.toBlob((blob) => {
      download('reckon.png', blob);
      this.log.say('Saved the picture as reckon.png.');
    });
  }

  async saveMinute() {
    try {
      const text = await this.minute();
      download('reckon.html', new Blob([text], { type: 'text/html' }));
      const thin = this.recorder.spacing > 0.04 ? ` Pictures are ${digits(this.recorder.spacing)} s apart, because of the number of entities.` : '';
      this.log.say(`Saved the last minute as reckon.html, ${digits(text.length / 1e6)} MB.${thin}`);
    } catch (error) {
      this.log.say(`Not saved: ${error.message}`, 'warning');
    }
  }

  minute() { return savePage(this.recorder.saved()); }

  listen() {
    listenForKeys(this);
    byId('theme').addEventListener('click', () => this.swapTheme());
    byId('save-picture').addEventListener('click', () => this.savePicture());
    byId('save-minute').addEventListener('click', () => this.saveMinute());
    byId('help').addEventListener('click', () => this.showKeys());
    byId('lead').addEventListener('click', () => this.toggleLead());
    byId('inset').addEventListener('click', () => this.swap());
  }

  // Position of a hand in the large picture [pixels].
  placeOf(index) {
    const hand = this.moment.hands.find((one) => one.index === index);
    return hand ? this.stage.placeOf('touch', hand.position) : null;
  }

  // Values for tests.
  publish() {
    const { seen, moment } = this;
    window.reckon = {
      ...seen, state: this.state, play: this.timeLine.state, time: this.newer?.picture.time ?? null, age: this.status.age, bad: this.source.bad,
      entities: moment.count, hands: moment.hands, contacts: moment.contacts.length, large: this.stage.large, target: this.stage.view('world').orbit.goal.target.toArray(), kind: moment.hello.kind,
      numbers: moment.numbers, yours: this.hand.index, tour: this.tour.step, window: this.plots.window, minute: () => this.minute(), placeOf: (index) => this.placeOf(index), owners: moment.owners.map(({ owner }) => moment.handOfPeer(owner)?.index), bodies: moment.bodies, pointerAt: (place) => [...this.stage.placeOf('touch', place), this.hand.depthTo(place)],
      boxes: () => [...moment.roster.keys()].map((slot) => this.stage.boxOf(moment, slot)).filter(Boolean), auto: this.stage.auto.on, scale: this.stage.scaleBar.length,
      shares: this.share >= 1, depthTo: (index) => this.hand.depthTo(moment.hands.find((one) => one.index === index).position),
    };
  }
}

window.reckon = { frames: 0, state: 'connecting' };
new Page();
