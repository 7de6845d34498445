// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data of the plots: rows by time, also if the user moves back and forth in time. A gap is kept as
// a gap.

const MOST_ROWS = 6000;

export class Samples {
  constructor() { this.rows = []; }

  // Index of the first row that is not before a time.
  indexOf(time) {
    let low = 0;
    let high = this.rows.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.rows[middle].time < time) low = middle + 1; else high = middle;
    }
    return low;
  }

  // `afterGap`: there is no data between this row and the previous one.
  take(time, values, afterGap) {
    const { rows } = this;
    const at = this.indexOf(time);
    if (at < rows.length && rows[at].time === time) return;
    rows.splice(at, 0, { time, values, afterGap });
    if (rows.length <= MOST_ROWS) return;
    if (at > rows.length / 2) rows.shift(); else rows.pop();
  }

  clear() { this.rows = []; }

  // Columns from one time to another: first the times, then `count` values. A row of nulls
  // separates rows whose distance is larger than `longest` seconds.
  columns(from, to, count, longest) {
    const columns = Array.from({ length: count + 1 }, () => []);
    let last = null;
    for (let i = this.indexOf(from); i < this.rows.length && this.rows[i].time <= to; ++i) {
      const { time, values, afterGap } = this.rows[i];
      if (last !== null && (afterGap || time - last > longest)) {
        columns[0].push((last + time) / 2);
        for (let k = 1; k <= count; ++k) columns[k].push(null);
      }
      columns[0].push(time);
      for (let k = 0; k < count; ++k) columns[k + 1].push(values[k] ?? null);
      last = time;
    }
    return columns;
  }
}
