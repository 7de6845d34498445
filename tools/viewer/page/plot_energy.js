// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
export const plotEnergy = {
  name: 'energy', title: 'Energy at the port', unit: 'mJ', good: 'Good: never below zero by more than the dashed loans of contacts and regions, which are repaid.',
  lines: [
    { says: 'energy', colour: 'hand-0', at: ({ hands }) => millijoules(hands[0]?.energy) },
    { says: 'energy', colour: 'hand-1', at: ({ hands }) => millijoules(hands[1]?.energy) },
    { says: 'loan', colour: 'hand-0', dash: true, at: ({ hands }) => millijoules(hands[0]?.loan) },
    { says: 'loan', colour: 'hand-1', dash: true, at: ({ hands }) => millijoules(hands[1]?.loan) },
    { says: 'without the gate', colour: 'twin', at: ({ numbers }) => millijoules(together(numbers.twin)) },
  ],
};

// Energy that one twin adds to another comes out there. The sum over all twins is never below zero
// if the coupling is passive.
function together(twins) { return twins?.reduce((sum, { energy }) => sum + energy, 0); }
function millijoules(x) { return Number.isFinite(x) ? 1000 * x : null; }
