// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
export const plotDelay = {
  name: 'delay', title: 'One-way delay and loss', unit: 'ms', good: 'Good: low and flat. Touch stays calm where it is not.',
  lines: [
    { says: 'median', colour: 'hand-0', at: ({ numbers }) => numbers.delay_ms?.median },
    { says: '95 of 100 below', colour: 'hand-2', at: ({ numbers }) => numbers.delay_ms?.p95 },
    { says: 'lost', colour: 'force', right: '%', at: ({ numbers }) => percent(numbers.lost_share) },
  ],
};

function percent(x) { return Number.isFinite(x) ? 100 * x : null; }
