// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The rows of plot_list.js next to the picture: a minute each, with a line at the shown instant.
import { uPlot } from './libraries.js';
import { cssColour } from './colours.js';
import { PLOTS } from './plot_list.js';
import { Samples } from './samples.js';
import { digits, element } from './words.js';

const WINDOW = 60; // [s]
const HEIGHTS = [62, 92, 140]; // [pixels] least, of a page in one column, most
const WORDS = 74; // [pixels] of a pane, without its plot
const THIRDS = [1, 2 / 3, 1 / 3, 0];

export class Plots {
  constructor(host) {
    this.lines = PLOTS.flatMap((row) => row.lines);
    this.samples = new Samples();
    this.turn = 0;
    this.time = 0;
    this.window = WINDOW;
    this.showsTwins = true;
    let first = 1;
    this.panes = PLOTS.map((row) => {
      const pane = new Pane(host, row, first, this);
      first += row.lines.length;
      return pane;
    });
    this.host = host;
    new ResizeObserver(() => this.resize()).observe(host);
  }

  take(moment, afterGap) {
    const values = this.lines.map((line) => {
      const x = line.at(moment);
      return Number.isFinite(x) ? x : null;
    });
    this.samples.take(moment.picture.time, values, afterGap);
  }

  clear() { this.samples.clear(); }

  // Height of a plot, so that all of them are in sight.
  get height() {
    const [least, usual, most] = HEIGHTS;
    if (matchMedia('(max-width: 1000px)').matches) return usual;
    const shown = this.panes?.filter(({ section }) => !section.hidden).length || 1;
    return Math.max(least, Math.min(most, Math.floor(this.host.clientHeight / shown) - WORDS));
  }

  resize() { for (const pane of this.panes) pane.resize(); }
  paint() { for (const pane of this.panes) pane.make(); }

  // Draws one pane in each call, so that pictures are not delayed. `gap` [s]: rows with a larger
  // distance are not joined.
  // `span`: of a recording; one that is shorter than the window has axes of its length.
  draw(time, gap, span) {
    this.time = time;
    const short = span && span[1] - span[0] < WINDOW;
    this.window = short ? Math.max(1, span[1] - span[0]) : WINDOW;
    const last = this.samples.rows.at(-1)?.time ?? time;
    const end = short ? span[1] : time <= last && time >= last - WINDOW ? last : time;
    if (this.turn === 0) this.columns = this.samples.columns(end - this.window, end, this.lines.length, gap);
    if (this.columns) this.panes[this.turn].show(this.columns, end);
    this.turn = (this.turn + 1) % this.panes.length;
  }
}

class Pane {
  constructor(host, row, first, plots) {
    Object.assign(this, { row, first, plots });
    this.host = element('div', 'plot');
    this.keys = element('p', 'lines');
    const head = element('h2', '', `${row.title} `, element('small', '', `[${row.unit}]`));
    head.dataset.term = row.name === 'delay' ? 'delay and loss' : row.name;
    head.tabIndex = 0;
    this.keyOf = row.lines.map((line) => lineKey(line));
    this.keys.append(...this.keyOf);
    this.section = element('section', 'pane', '', head, this.host, element('p', 'good', row.good), this.keys);
    this.section.id = `plot-${row.name}`;
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
    const scales = { x: { time: false, range: () => [(this.end ?? 0) - this.plots.window, this.end ?? 0] }, y: this.row.log ? { distr: 3, range: decades } : { range } };
    if (right) scales.right = { range };
    this.plot = new uPlot({
      width: Math.max(120, this.host.clientWidth), height: this.height, padding: [6, right ? 0 : 10, 0, 0], legend: { show: false }, scales,
      cursor: { points: { size: 6 }, drag: { x: false, y: false }, sync: { key: 'time' } },
      axes: [
        { ...axis, size: 20, gap: 3, splits: (plot) => THIRDS.map((x) => plot.scales.x.max - x * this.plots.window),
          values: () => THIRDS.map((x) => `${Number((x * this.plots.window).toPrecision(2))}${x === 1 ? ' s' : ''}`) },
        side, ...(right ? [{ ...side, scale: 'right', side: 1, grid: { show: false } }] : []),
      ],
      series: [{}, ...this.row.lines.map((line) => ({
        stroke: cssColour(line.colour), width: line.dash ? 1.25 : 1.75, points: { show: false },
        ...(line.dash ? { dash: [5, 4] } : {}), ...(line.right ? { scale: 'right' } : {}),
      }))],
      hooks: { draw: [(plot) => this.mark(plot)], setCursor: [() => this.tell()] },
    }, this.data ?? [[], ...this.row.lines.map(() => [])], this.host);
  }

  get height() { return this.plots.panes ? this.plots.height : HEIGHTS[1]; }

  resize() {
    const size = { width: Math.max(120, this.host.clientWidth), height: this.height };
    if (this.plot.width !== size.width || this.plot.height !== size.height) this.plot.setSize(size);
  }

  show(columns, end) {
    this.end = end;
    const hides = ({ twin }) => twin && !this.plots.showsTwins;
    this.data = [columns[0], ...this.row.lines.map((line, i) => (hides(line) ? columns[0].map(() => null) : columns[this.first + i]))];
    const known = this.data.slice(1).some((column) => column.some((x) => x !== null));
    if (known && this.section.hidden) {
      this.section.hidden = false;
      this.plots.resize();
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
    this.row.lines.forEach((line, i) => {
      const [, x] = known.find(([one]) => one === line) ?? [];
      const key = this.keyOf[i];
      if (key.hidden !== (x === undefined)) key.hidden = x === undefined;
      const text = digits(x);
      if (key.value.textContent !== text) key.value.textContent = text;
    });
  }
}

// Words, colour and value of a line.
function lineKey(line) {
  const value = element('b');
  const key = element('span', `${line.dash ? 'dash ' : ''}c-${line.colour}`, `${line.says} `, value, line.right ? ` ${line.right}` : '');
  return Object.assign(key, { value, hidden: true });
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
