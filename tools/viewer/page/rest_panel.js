// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The button by which the bodies go on without the peers that are missing, while they rest.
import { byId } from './words.js';

export class RestPanel {
  constructor(tell, say) {
    this.host = byId('rest');
    byId('go-alone').addEventListener('click', () => {
      tell('goAlone');
      say('Asked to go on alone.');
    });
  }

  show(rests) { this.host.hidden = !rests; }
}
