// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
export const plotPackets = {
  name: 'packets', title: 'Sent, against a raw stream', unit: 'kbit/s', log: true, good: 'Low: an update goes out only above a threshold.',
  lines: [
    { says: 'sent', colour: 'hand-0', at: ({ numbers }) => kilobits(numbers.bit_per_s) },
    { says: 'raw stream', colour: 'dim', dash: true, at: ({ numbers }) => kilobits(numbers.raw_bit_per_s) },
  ],
};

// A logarithmic scale has no zero.
function kilobits(x) { return x > 0 ? x / 1000 : null; }
