// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The rows of plot_list.js next to the picture: a minute each, with a line at the shown instant.
import { uPlot } from './libraries.js';
import { cssColour } from './colours.js';
import { PLOTS } from './plot_list.js';
import { Samples } from './samples.js';
import { digits, element } from './words.js';

const WINDOW = 60; // [s]
const HEIGHT = 92;

export class Plots {
  constructor(host) {
    this.lines = PLOTS.flatMap((row) => row.lines);
    this.samples = new Samples();
    this.turn = 0;
    this.time = 0;
    let first = 1;
    this.panes = PLOTS.map((row) => {
      const pane = new Pane(host, row, first, this);
      first += row.lines.length;
      return pane;
    });
    new ResizeObserver(() => { for (const pane of this.panes) pane.resize(); }).observe(host);
  }

  take(moment, afterGap) {
    const values = this.lines.map((line) => {
      const x = line.at(moment);
      return Number.isFinite(x) ? x : null;
    });
    this.samples.take(moment.picture.time, values, afterGap);
  }

  clear() { this.samples.clear(); }
  paint() { for (const pane of this.panes) pane.make(); }

  // Draws one pane in each call, so that pictures are not delayed. `gap` [s]: rows with a larger
  // distance are not joined.
  draw(time, gap) {
    this.time = time;
    const last = this.samples.rows.at(-1)?.time ?? time;
    const end = time <= last && time >= last - WINDOW ? last : time;
    if (this.turn === 0) this.columns = this.samples.columns(end - WINDOW, end, this.lines.length, gap);
    if (this.columns) this.panes[this.turn].show(this.columns, end);
    this.turn = (this.turn + 1) % this.panes.length;
  }
}

class Pane {
  constructor(host, row, first, plots) {
    Object.assign(this, { row, first, plots });
    this.host = element('div', 'plot');
    this.keys = element('span', 'lines');
    this.section = element('section', 'pane', '', element('h2', '', `${row.title} `, element('small', '', `[${row.unit}]`)),
      this.host, element('p', 'good', row.good, this.keys));
    this.section.hidden = true; // hidden until there are values
    host.append(this.section);
    this.make();
  }

  // Makes the plot again with the colours of the theme.
  make() {
    this.plot?.destroy();
    const axis = {
      stroke: cssColour('dim'), grid: { stroke: cssColour('line'), width: 1 }, ticks: { show: false }, font: '11px system-ui, sans-serif',
    };
    const side = { ...axis, size: 38, gap: 4, space: 28, values: (plot, list) => list.map((x) => (x === null ? '' : shortNumber(x))) };
    if (this.row.log) side.splits = decadeSplits;
    const right = this.row.lines.some((line) => line.right);
    const scales = { x: { time: false, range: () => [(this.end ?? 0) - WINDOW, this.end ?? 0] }, y: this.row.log ? { distr: 3, range: decades } : { range } };
    if (right) scales.right = { range };
    this.plot = new uPlot({
      width: Math.max(120, this.host.clientWidth), height: HEIGHT, padding: [6, right ? 0 : 10, 0, 0], legend: { show: false }, scales,
      cursor: { points: { size: 6 }, drag: { x: false, y: false }, sync: { key: 'time' } },
      axes: [
        { ...axis, size: 20, gap: 3, splits: (plot) => [60, 40, 20, 0].map((x) => plot.scales.x.max - x), values: () => ['60 s', '40', '20', '0'] },
        side, ...(right ? [{ ...side, scale: 'right', side: 1, grid: { show: false } }] : []),
      ],
      series: [{}, ...this.row.lines.map((line) => ({
        stroke: cssColour(line.colour), width: line.dash ? 1.25 : 1.75, points: { show: false },
        ...(line.dash ? { dash: [5, 4] } : {}), ...(line.right ? { scale: 'right' } : {}),
      }))],
      hooks: { draw: [(plot) => this.mark(plot)], setCursor: [() => this.tell()] },
    }, this.data ?? [[], ...this.row.lines.map(() => [])], this.host);
  }

  resize() { this.plot.setSize({ width: Math.max(120, this.host.clientWidth), height: HEIGHT }); }

  show(columns, end) {
    this.end = end;
    this.data = [columns[0], ...columns.slice(this.first, this.first + this.row.lines.length)];
    const known = this.data.slice(1).some((column) => column.some((x) => x !== null));
    if (known && this.section.hidden) {
      this.section.hidden = false;
      this.resize();
    }
    if (this.section.hidden) return;
    this.plot.setData(this.data);
    this.tell();
  }

  // Marks the shown instant, if it is not the newest.
  mark(plot) {
    if (!this.end || this.end - this.plots.time < 0.3) return;
    const x = plot.valToPos(this.plots.time, 'x', true);
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = cssColour('text');
    ctx.lineWidth = devicePixelRatio;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }

  // Shows the values under the cursor, else at the shown instant. Omits lines without any values,
  // and brief lines without a value there.
  tell() {
    if (!this.data) return;
    const { idx } = this.plot.cursor;
    const times = this.data[0];
    let at = idx ?? times.length - 1;
    if (idx === null || idx === undefined) while (at > 0 && times[at] > this.plots.time + 0.001) --at;
    const known = this.row.lines.flatMap((line, i) => {
      const column = this.data[i + 1];
      return (line.brief ? [column[at] ?? null] : column).some((x) => x !== null) ? [[line, column[at]]] : [];
    });
    this.keys.replaceChildren(...known.map(([line, x]) => {
      const key = element('span', `${line.dash ? 'dash ' : ''}c-${line.colour}`, `${line.says} `, element('b', '', digits(x)));
      if (line.right) key.append(` ${line.right}`);
      return key;
    }));
  }
}

function shortNumber(x) { return Math.abs(x) >= 1e4 ? `${Math.round(x / 1e3)}k` : String(Number(x.toPrecision(3))); }

// Powers of ten, at most four of them.
function decadeSplits(plot, axis, low, high) {
  const from = Math.round(Math.log10(low));
  const count = Math.round(Math.log10(high)) - from;
  const step = Math.max(1, Math.ceil(count / 3));
  return Array.from({ length: Math.floor(count / step) + 1 }, (_, i) => 10 ** (from + i * step));
}

// Zero is always within the range.
function range(plot, low, high) {
  const top = Math.max(high ?? 0, 0);
  const bottom = Math.min(low ?? 0, 0);
  const room = 0.12 * (top - bottom) || 1;
  return [bottom < 0 ? bottom - room : 0, top + room];
}

function decades(plot, low, high) {
  if (!(low > 0)) return [1, 1000];
  return [10 ** Math.floor(Math.log10(low)), 10 ** Math.ceil(Math.log10(Math.max(high, low * 1.01)))];
}
