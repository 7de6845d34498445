// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
export const plotError = {
  name: 'error', title: 'Shown against true', unit: 'mm', good: 'Good: the mean below the threshold; the worst near it.',
  lines: [
    { says: 'mean', colour: 'hand-0', at: ({ numbers }) => millimetres(numbers.error?.mean_m) },
    { says: 'worst', colour: 'hand-1', at: ({ numbers }) => millimetres(numbers.error?.worst_m) },
    { says: 'threshold', colour: 'dim', dash: true, at: ({ numbers }) => millimetres(numbers.error?.threshold_m) },
  ],
};

function millimetres(x) { return Number.isFinite(x) ? 1000 * x : null; }
