// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cells of interest, and lit those that the followed entity hears. Without cells: a plain grid, for the eye.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial } from './libraries.js';
import { colour } from './colours.js';
import { NONE } from './picture.js';
import { roundUp } from './words.js';

export const drawnCells = {
  name: 'cells', view: 'world', says: 'cell that the followed one hears', mark: 'cell',
  make(group, view) { return new Cells(group, view); },
};

class Cells {
  constructor(group, view) {
    this.view = view;
    this.line = new LineBasicMaterial({ transparent: true });
    this.fill = new MeshBasicMaterial({ transparent: true, depthWrite: false });
    this.lines = new LineSegments(new BufferGeometry(), this.line);
    this.lit = new Mesh(new BufferGeometry(), this.fill);
    for (const part of [this.lines, this.lit]) part.frustumCulled = false;
    group.add(this.lit, this.lines);
    this.key = '';
  }

  paint() {
    this.line.color = colour('grid');
    this.fill.color = colour('lit');
    this.fill.opacity = Number(getComputedStyle(document.documentElement).getPropertyValue('--lit-opacity'));
  }

  update(moment) {
    const { cells, size } = moment.cells;
    const reach = roundUp((this.view.extent?.radius ?? 1) * 1.2);
    const key = `${moment.cellsNumber} ${moment.followed} ${cells.length ? '' : reach}`;
    if (key === this.key) return;
    this.key = key;
    const z = this.floor(moment);
    const square = ({ x, y }) => [[x, y], [x + size, y], [x + size, y + size], [x, y + size]];
    const sides = cells.flatMap((cell) => {
      const [a, b, c, d] = square(cell);
      return [a, b, b, c, c, d, d, a];
    });
    const lines = cells.length ? sides : plainGrid(reach, this.view.extent?.centre ?? [0, 0, 0]);
    const heard = moment.followed === NONE ? [] : cells.filter((cell) => cell.heard_by.includes(moment.followed));
    const faces = heard.flatMap((cell) => {
      const [a, b, c, d] = square(cell);
      return [a, b, c, a, c, d];
    });
    const points = (list) => new Float32BufferAttribute(list.flatMap(([x, y]) => [x, y, z]), 3);
    this.lines.geometry.setAttribute('position', points(lines));
    this.lit.geometry.setAttribute('position', points(faces));
  }

  // A little below most: height of the lowest twentieth.
  floor({ shown, count }) {
    const heights = Array.from({ length: count }, (_, i) => shown[3 * i + 2]).filter(Number.isFinite).sort((a, b) => a - b);
    return (heights[Math.floor(heights.length / 20)] ?? 0) - 0.002 * (this.view.extent?.radius ?? 1);
  }
}

function plainGrid(reach, [cx, cy]) {
  const step = reach / 5;
  const snap = (x) => Math.round(x / step) * step;
  const lines = [];
  for (let i = -5; i <= 5; ++i) {
    lines.push([snap(cx) + i * step, snap(cy) - reach], [snap(cx) + i * step, snap(cy) + reach]);
    lines.push([snap(cx) - reach, snap(cy) + i * step], [snap(cx) + reach, snap(cy) + i * step]);
  }
  return lines;
}
