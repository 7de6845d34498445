// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
import { twinsOf } from './twins.js';

// Twins exchange energy, so only their sum has to stay above zero. Beside it the sum of their hands
// is shown, not each hand.
export const plotEnergy = {
  name: 'energy', title: 'Energy at the port', unit: 'mJ', good: 'Good above the dashed line; below it a contact makes energy.',
  lines: [
    { brief: true, says: 'energy', colour: 'hand-0', at: ofHand(0, 'energy') },
    { brief: true, says: 'energy', colour: 'hand-1', at: ofHand(1, 'energy') },
    { brief: true, says: 'loan', colour: 'hand-0', dash: true, at: ofHand(0, 'loan', -1) },
    { brief: true, says: 'loan', colour: 'hand-1', dash: true, at: ofHand(1, 'loan', -1) },
    { brief: true, says: 'hands together', colour: 'hand-0', at: together('energy') },
    { brief: true, says: 'their loans', colour: 'hand-0', dash: true, at: together('loan', -1) },
    { brief: true, twin: true, says: 'without the gate, together', colour: 'twin', at: ({ numbers }) => millijoules(sum(twinsOf(numbers), 'energy')) },
  ],
};

function ofHand(i, what, sign = 1) {
  return ({ hands, numbers }) => (twinsOf(numbers).length ? null : millijoules(hands[i]?.[what], sign));
}

// Of the hands that have a twin.
function together(what, sign = 1) {
  return ({ hands, numbers }) => {
    const twins = twinsOf(numbers);
    return millijoules(sum(hands.filter(({ index }) => twins.some(({ hand }) => hand === index)), what), sign);
  };
}

function sum(rows, what) { return rows.length ? rows.reduce((total, row) => total + row[what], 0) : null; }
function millijoules(x, sign = 1) { return Number.isFinite(x) ? 1000 * sign * x : null; }
