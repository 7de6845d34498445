// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the user's hand feels, from the last two received pictures: force, contact, and how fast it
// slips.
import { minus, nearestSurface, rotated } from './nearest_surface.js';
import { HAND_FLAGS } from './picture.js';

const OLDEST = 300; // [ms] since the last picture; an older force is not shown
const LONGEST = 0.5; // [s] between two pictures that give a speed

function placeOfSlot(picture, slot) {
  const i = picture.indexOf(slot);
  if (i < 0) return null;
  return [0, 1, 2].map((k) => picture.doubles[picture.placeAt(i) + k] + picture.floats[picture.errorAt(i) + k]);
}

// How far what a hand touches has moved between two pictures, at the contact point [m].
function carried(older, newer, { slot, surface }, touch) {
  const contact = newer.contacts.filter(({ feeling }) => feeling === slot).sort((a, b) => b.newtons - a.newtons)[0];
  if (contact) {
    const places = [older, newer].map((picture) => picture.hands.find((hand) => hand.slot === contact.felt)?.position ?? placeOfSlot(picture, contact.felt));
    return places.every(Boolean) ? minus(places[1], places[0]) : [0, 0, 0];
  }
  const world = { touch, bodies: newer.bodies, handRadius: () => 0 };
  const body = nearestSurface(world, { position: surface }, [])?.solid.body;
  const [from, to] = [older.bodies[body], newer.bodies[body]];
  if (!from || !to) return [0, 0, 0];
  const before = rotated(from.turn, rotated(to.turn, minus(surface, to.position), true), false);
  return minus(surface, before.map((x, k) => x + from.position[k]));
}

// Speed of the contact point along the surface, relative to what it touches [m/s].
export function slipSpeed(older, newer, index, touch) {
  const [before, now] = [older, newer].map((picture) => picture?.hands.find((hand) => hand.index === index));
  const seconds = newer.time - (older?.time ?? Infinity);
  if (!before || !now || !(before.flags & now.flags & HAND_FLAGS.contact) || !(seconds > 0 && seconds < LONGEST)) return 0;
  const moved = minus(minus(now.surface, before.surface), carried(older, newer, now, touch));
  const along = moved.reduce((sum, x, k) => sum + x * now.normal[k], 0);
  return Math.hypot(...moved.map((x, k) => x - along * now.normal[k])) / seconds;
}

export class Feeling {
  // `page` has hand, moment, newer and timeLine.
  constructor(page) {
    this.page = page;
    this.contacts = 0; // that began; while pictures are old, a contact neither ends nor begins
    this.touched = false;
  }

  // { newtons, slip, touches, onset }, or null while nothing is felt: no hand is held, the picture
  // stands, or it is old. `onset` counts the contacts that began.
  at(now) {
    const { hand, moment, newer, timeLine } = this.page;
    if (!hand.held) this.touched = false;
    const felt = hand.held && timeLine.state === 'live' && now - newer.came < OLDEST ? newer.picture.hands.find(({ index }) => index === hand.index) : null;
    if (!felt) this.last = null;
    else if (this.picture !== newer.picture || !this.last) this.last = this.next(felt, moment.touch);
    this.picture = newer.picture;
    return this.last;
  }

  next({ index, flags, newtons }, touch) {
    const touches = (flags & HAND_FLAGS.contact) !== 0;
    if (touches && !this.touched) this.contacts += 1;
    this.touched = touches;
    return { newtons, touches, onset: this.contacts, slip: this.last ? slipSpeed(this.picture, this.page.newer.picture, index, touch) : 0 };
  }
}
