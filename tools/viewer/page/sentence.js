// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One sentence that says what the large picture shows.
import { clock } from './words.js';

const COUNTS = ['no', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight', 'nine'];

function many(count, one, several) {
  const words = `${COUNTS[count] ?? count.toLocaleString('en')} ${count === 1 ? one : several}`;
  return words[0].toUpperCase() + words.slice(1);
}

// `held`: time of the picture that stands for an instant without anybody [s since the begin], or null.
export function sentence(moment, large, held) {
  if (held !== null) return `Nobody sends at this instant; you see the moment at ${clock(held)}.`;
  if (!moment.count && !moment.hands.length) return '';
  return large === 'touch' ? touchSentence(moment) : worldSentence(moment);
}

// [ms], greatest delay at which two hands of two programs lift and shake a cube of 50 g.
const LIFTED = 50;
const ROUNDED = 1 / 16; // share by which a measured delay may be rounded up

function ownersSentence({ ownersDiffer, handPeers, numbers }) {
  if (!ownersDiffer) return '';
  const colour = ' A body has the colour of the hand whose program simulates it.';
  const isLong = numbers.peers?.delay_ms?.median > LIFTED * (1 + ROUNDED);
  return handPeers.size > 1 && isLong ? `${colour} The delay is above ${LIFTED}\u00a0ms: two hands may drop what they lift.` : colour;
}

function touchSentence(moment) {
  const { hands, hello, count, touch } = moment;
  if (!hands.length) return `${many(count, 'object that can be felt', 'objects that can be felt')}, as received from the network. An arrow is a force between two of them.`;
  const arrow = 'An arrow is the force that a hand feels.';
  if (hello.kind !== 'demo') return `${many(hands.length, 'hand', 'hands')} of this program, and everything that can be felt near. ${arrow}`;
  const what = touch.solids.some(({ body }) => body !== undefined) ? 'objects that they move' : touch.solids.length ? 'the solids here' : 'each other';
  const others = touch.solids.length && hands.length > 1 ? `${what} and each other` : what;
  const who = hands.length === 1 ? 'One hand touches' : `${many(hands.length, '', 'hands')}, each in a program of its own, touch`;
  return `${who} ${others} over a simulated network. ${arrow}${ownersSentence(moment)}`;
}

function worldSentence({ count }) {
  return `${many(count, 'entity', 'entities')}, as a receiver shows ${count === 1 ? 'it' : 'them'} between two updates. A line is the path of the last 10\u00a0s.`;
}
