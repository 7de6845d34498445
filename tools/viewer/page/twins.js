// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The hidden twin that plots show: the twin of the user's hand, else the first.
import { HAND_FLAGS } from './picture.js';

export function twinsOf({ twin }) { return twin ?? []; }

export function shownTwin({ hands, numbers }) {
  const twins = twinsOf(numbers);
  const own = hands.find(({ flags }) => flags & HAND_FLAGS.yours);
  return twins.find(({ hand }) => hand === own?.index) ?? twins[0];
}
