// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The legend: the marks that are in this picture; a press hides or shows one. All marks are in the
// list behind `?`.
import { DRAWN } from './drawn_list.js';
import { element } from './words.js';
import { TERMS } from './terms.js';

// Whether anything of a group is drawn.
export function drawsSomething(group) {
  let some = false;
  group.traverseVisible(({ geometry }) => {
    const count = Math.min(geometry?.attributes.position?.count ?? 0, geometry?.drawRange.count ?? 0);
    some ||= count > 0;
  });
  return some;
}

export class PictureKey {
  constructor(host, stage, say) {
    this.stage = stage;
    this.rows = stage.things.map(({ row, group }) => {
      if (row.hidden) stage.hidden.add(row.name);
      const button = element('button', row.view, '', element('i', row.mark), element('span', '', row.says));
      button.dataset.term = row.name;
      button.hidden = true;
      button.addEventListener('click', () => {
        const shown = stage.toggle(row.name);
        say(`${shown ? 'Shown' : 'Hidden'}: ${row.says}.`);
        this.paint();
      });
      return { row, group, button };
    });
    this.fold = element('button', 'fold', 'Legend');
    this.fold.addEventListener('click', () => this.setFolded(!this.folded));
    host.append(this.fold, ...this.rows.map(({ button }) => button));
    this.host = host;
    this.setFolded(matchMedia('(max-width: 1000px)').matches);
    this.paint();
  }

  setFolded(folded) {
    this.folded = folded;
    this.host.classList.toggle('folded', folded);
    this.fold.setAttribute('aria-expanded', String(!folded));
  }

  // Called some times a second. A row that the user hid stays, to be shown again.
  look() {
    for (const { row, group, button } of this.rows) {
      if (row.view !== this.stage.large) continue;
      const some = this.stage.hidden.has(row.name) ? !row.hidden : drawsSomething(group);
      if (button.hidden === some) button.hidden = !some;
    }
  }

  paint() {
    for (const { row, button } of this.rows) button.setAttribute('aria-pressed', String(!this.stage.hidden.has(row.name)));
  }
}

// All marks, for the list behind `?`.
export function listMarks(host) {
  host.append(...DRAWN.flatMap((row) => [element('dt', '', '', element('i', row.mark), ` ${row.says}`), element('dd', '', TERMS[row.name])]));
}
