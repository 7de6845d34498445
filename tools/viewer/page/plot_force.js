// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
import { shownTwin } from './twins.js';

export const plotForce = {
  name: 'force', title: 'Force on the hand', unit: 'N', good: 'Felt should lie on true, and be flat while a hand rests.',
  // Drawn in this order: the felt force is above the force of the twin.
  lines: [
    { twin: true, says: 'without the gate', colour: 'twin', at: twinForce },
    { says: 'felt', colour: 'hand-0', at: ({ hands }) => hands[0]?.newtons },
    { says: 'felt', colour: 'hand-1', at: ({ hands }) => hands[1]?.newtons },
    { says: 'true', colour: 'hand-0', dash: true, at: ({ hands }) => hands[0]?.trueForce },
    { says: 'true', colour: 'hand-1', dash: true, at: ({ hands }) => hands[1]?.trueForce },
  ],
};

function twinForce(moment) {
  const twin = shownTwin(moment);
  return moment.hands.find(({ index }) => index === twin?.hand)?.twin;
}
