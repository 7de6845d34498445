// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets of a picture as the program sends it; docs/viewer_protocol.md has the layout.
export function picture({ time = 0, number = 1, entities = [], hands = [], contacts = 0, tools = [], bodies = [], flags = 1 }) {
  const view = new DataView(new ArrayBuffer(32 + 64 * entities.length + 72 * hands.length + 40 * contacts + 124 * tools.length + 20 * bodies.length));
  view.setUint32(0, 0x33564b52, true);
  view.setUint32(4, number, true);
  view.setFloat64(8, time, true);
  [entities.length, hands.length, contacts, flags].forEach((x, i) => view.setUint16(16 + 2 * i, x, true));
  view.setUint32(24, 7, true);
  view.setUint16(28, tools.length, true);
  view.setUint16(30, bodies.length, true);
  entities.forEach(({ slot, x = 0, y = 0, z = 0, error = 0, turn = [32767, 0, 0, 0], speed = 0, age = 0 }, i) => {
    const at = 32 + 64 * i;
    view.setUint16(at, slot, true);
    view.setUint8(at + 2, 1);
    view.setUint8(at + 3, 2);
    view.setUint16(at + 4, 27, true);
    view.setUint16(at + 6, 513, true);
    [x, y, z].forEach((place, k) => view.setFloat64(at + 8 + 8 * k, place, true));
    turn.forEach((q, k) => view.setInt16(at + 32 + 2 * k, q, true));
    view.setFloat32(at + 40, error, true);
    view.setUint16(at + 52, 250, true);
    view.setUint16(at + 54, 12, true);
    view.setFloat32(at + 56, speed, true);
    view.setFloat32(at + 60, age, true);
  });
  hands.forEach(({ index = 0, flags: of = 0, slot = 0, patch = 0, force = [0, 0, 0], position = [0, 0, 0] }, i) => {
    const at = 32 + 64 * entities.length + 72 * i;
    view.setUint16(at, index, true);
    view.setUint16(at + 2, of, true);
    view.setUint16(at + 4, slot, true);
    view.setUint16(at + 6, patch, true);
    position.forEach((x, k) => view.setFloat32(at + 8 + 4 * k, x, true));
    force.forEach((x, k) => view.setFloat32(at + 32 + 4 * k, x, true));
    [5, 6, 7, 8].forEach((x, k) => view.setFloat32(at + 56 + 4 * k, x, true));
  });
  tools.forEach(({ hand, torque = [0, 0, 0], handle = [0, 0, 0], probes }, i) => {
    const at = 32 + 64 * entities.length + 72 * hands.length + 40 * contacts + 124 * i;
    view.setUint16(at, hand, true);
    view.setUint16(at + 2, probes.length, true);
    [handle, torque, ...probes].forEach((v, j) => v.forEach((x, k) => view.setFloat32(at + 4 + 12 * j + 4 * k, x, true)));
  });
  bodies.forEach(({ position, turn = [32767, 0, 0, 0] }, i) => {
    const at = 32 + 64 * entities.length + 72 * hands.length + 40 * contacts + 124 * tools.length + 20 * i;
    position.forEach((x, k) => view.setFloat32(at + 4 * k, x, true));
    turn.forEach((q, k) => view.setInt16(at + 12 + 2 * k, q, true));
  });
  return view.buffer;
}
