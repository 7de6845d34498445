// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The convex hull of points of a picture, counter-clockwise; with less than three points, the
// points themselves.
export function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const half = (list) => {
    const out = [];
    for (const [x, y] of list) {
      const turnsRight = ([ax, ay], [bx, by]) => (bx - ax) * (y - ay) - (by - ay) * (x - ax) <= 0;
      while (out.length > 1 && turnsRight(out.at(-2), out.at(-1))) out.pop();
      out.push([x, y]);
    }
    return out.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}
