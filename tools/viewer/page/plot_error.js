// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
export const plotError = {
  name: 'error', title: 'Shown against true', unit: 'mm',
  good: 'The mean error should stay below the dashed threshold.',
  lines: [
    { says: 'mean', colour: 'hand-0', at: ofAll('mean_m') },
    { says: 'worst', colour: 'hand-1', at: ofAll('worst_m') },
    { says: 'followed', colour: 'hand-2', at: ({ picture, followed, numbers }) => jumpOf(picture, numbers.error?.followed_m ? followed : -1) },
    { brief: true, says: 'its threshold', colour: 'dim', dash: true, at: ({ numbers }) => millimetres(numbers.error?.followed_m) },
    { brief: true, says: 'threshold', colour: 'dim', dash: true, at: threshold(0) },
    { brief: true, says: 'threshold', colour: 'dim', dash: true, at: threshold(1) },
    { brief: true, says: 'threshold', colour: 'dim', dash: true, at: threshold(2) },
  ],
};

// While one entity is followed, mean and thresholds of all are not shown.
function ofAll(name) { return ({ numbers }) => (numbers.error?.followed_m ? null : millimetres(numbers.error?.[name])); }
function threshold(i) { return ({ numbers }) => (numbers.error?.followed_m ? null : millimetres(numbers.error?.thresholds_m?.[i])); }
function millimetres(x) { return Number.isFinite(x) ? 1000 * x : null; }

// Distance by which its last update moved it; unknown beyond 65 m.
function jumpOf(picture, slot) {
  const i = picture.indexOf(slot);
  const jump = i < 0 ? null : picture.jump(i);
  return jump === 65535 ? null : jump;
}
