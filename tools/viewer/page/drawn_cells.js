// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cells of interest. The cells that the followed entity receives are highlighted. Without cells: a
// plain grid for orientation.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial } from './libraries.js';
import { colour } from './colours.js';
import { NONE } from './picture.js';
import { roundUp } from './words.js';

export const drawnCells = {
  name: 'cells', view: 'world', says: 'cell, lit where received', mark: 'cell',
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
    const { cells, size, shape } = moment.cells;
    const reach = roundUp((this.view.extent?.radius ?? 1) * 1.2);
    const { anchor, anchored } = this.view.orbit;
    const key = `${moment.cellsNumber} ${moment.followed} ${cells.length ? '' : reach} ${anchored} ${moment.exercise}`;
    if (key === this.key) return;
    this.key = key;
    const z = this.floor(moment);
    const corners = cornersOf(shape, size || 0.04 * reach);
    const around = ({ x, y }) => corners.map(([dx, dy]) => [x + dx, y + dy]);
    const sides = cells.flatMap((cell) => around(cell).flatMap((corner, i, all) => [corner, all[(i + 1) % all.length]]));
    const lines = cells.length ? sides : moment.exercise && moment.geodesy ? [] : plainGrid(reach, this.view.extent?.centre ?? [0, 0, 0]);
    const heard = moment.followed === NONE ? [] : cells.filter((cell) => cell.heard_by.includes(moment.followed));
    const faces = heard.flatMap((cell) => {
      const all = around(cell);
      return all.slice(2).flatMap((corner, i) => [all[0], all[i + 1], corner]);
    });
    const points = (list) => new Float32BufferAttribute(list.flatMap(([x, y]) => [x - anchor.x, y - anchor.y, z - anchor.z]), 3);
    for (const part of [this.lines, this.lit]) part.position.copy(anchor);
    this.lines.geometry.setAttribute('position', points(lines));
    this.lit.geometry.setAttribute('position', points(faces));
  }

  // Height slightly below the lowest twentieth of the entities.
  floor({ shown, count }) {
    const heights = Array.from({ length: count }, (_, i) => shown[3 * i + 2]).filter(Number.isFinite).sort((a, b) => a - b);
    return (heights[Math.floor(heights.length / 20)] ?? 0) - 0.002 * (this.view.extent?.radius ?? 1);
  }
}

// Corners around the centre: a square with this side; a hexagon with this distance from centre to
// corner, with corners to the north and south; a mark for cells without one shape.
function cornersOf(shape, size) {
  const ring = (count, radius, first) => Array.from({ length: count }, (_, i) => {
    const angle = first + (2 * Math.PI * i) / count;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
  if (shape === 'hexagon') return ring(6, size, Math.PI / 6);
  if (shape === 'point') return ring(4, size / 2, 0);
  return ring(4, size * Math.SQRT1_2, Math.PI / 4);
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
