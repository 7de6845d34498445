// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The key of the picture: the meaning of each mark; a press hides or shows the thing.
import { DRAWN } from './drawn_list.js';
import { element } from './words.js';

export class PictureKey {
  constructor(host, stage, say) {
    this.stage = stage;
    this.rows = DRAWN.map((row) => {
      if (row.hidden) stage.hidden.add(row.name);
      const button = element('button', row.view, '', element('i', row.mark), element('span', '', row.says));
      button.title = 'hide or show';
      button.addEventListener('click', () => {
        const shown = stage.toggle(row.name);
        say(`${shown ? 'Shown' : 'Hidden'}: ${row.says}.`);
        this.paint();
      });
      return { row, button };
    });
    host.append(...this.rows.map(({ button }) => button));
    this.paint();
  }

  paint() {
    for (const { row, button } of this.rows) button.setAttribute('aria-pressed', String(!this.stage.hidden.has(row.name)));
  }
}
