// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Delay and loss between the program's own peers, if it has any; else at the page's listener.
export const plotDelay = {
  name: 'delay', title: 'One-way delay and loss', unit: 'ms', good: 'Low and flat is good; touch stays stable at any delay.',
  lines: [
    { says: 'median at the peers', colour: 'hand-0', at: ({ numbers }) => numbers.peers?.delay_ms?.median },
    { says: '95 % below', colour: 'hand-2', at: ({ numbers }) => numbers.peers?.delay_ms?.p95 },
    { says: 'lost', colour: 'force', right: '%', at: ({ numbers }) => percent(numbers.peers?.lost_share) },
    { brief: true, says: 'median at this listener', colour: 'hand-0', at: heard((numbers) => numbers.delay_ms?.median) },
    { brief: true, says: '95 % below', colour: 'hand-2', at: heard((numbers) => numbers.delay_ms?.p95) },
    { brief: true, says: 'lost', colour: 'force', right: '%', at: heard((numbers) => percent(numbers.lost_share)) },
  ],
};

function heard(what) { return ({ numbers }) => (numbers.peers ? null : what(numbers)); }
function percent(x) { return Number.isFinite(x) ? 100 * x : null; }
