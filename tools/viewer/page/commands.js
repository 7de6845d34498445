// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Messages from the page to the server: one octet of kind, then little-endian fields.

const WRITE = {
  u8: [1, (view, at, x) => view.setUint8(at, x)],
  i8: [1, (view, at, x) => view.setInt8(at, x)],
  u16: [2, (view, at, x) => view.setUint16(at, x, true)],
  u32: [4, (view, at, x) => view.setUint32(at, x, true)],
  f32: [4, (view, at, x) => view.setFloat32(at, x, true)],
  f64: [8, (view, at, x) => view.setFloat64(at, x, true)],
};

function command(kind, ...fields) {
  const view = new DataView(new ArrayBuffer(1 + fields.reduce((sum, [type]) => sum + WRITE[type][0], 0)));
  view.setUint8(0, kind);
  let at = 1;
  for (const [type, value] of fields) {
    WRITE[type][1](view, at, value);
    at += WRITE[type][0];
  }
  return view.buffer;
}

export const COMMANDS = {
  drawn: (number) => command(1, ['u32', number]),
  seek: (time) => command(2, ['f64', time]),
  speed: (times) => command(3, ['f32', times]),
  live: () => command(4),
  step: (step) => command(5, ['i8', step]),
  pointer: (hand, [x, y, z], held, grabs) => command(6, ['u16', hand], ['f32', x], ['f32', y], ['f32', z], ['u8', held ? (grabs ? 2 : 1) : 0]),
  network: ({ delay, jitter, loss, outage }) =>
    command(7, ['f32', delay], ['f32', jitter], ['f32', loss], ['u8', outage ? 1 : 0]),
  askHand: () => command(8),
  giveHand: () => command(9),
  follow: (slot) => command(10, ['u16', slot]),
  goAlone: () => command(11),
  whole: () => command(12),
};
