// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole pictures, as the page keeps and saves them: little endian, fixed sizes, read in place
// without a copy.

export const MAGIC = 0x33564b52; // "RKV3"
export const HEAD = 32;
export const ENTITY = 64;
const HAND = 72;
const CONTACT = 40;
const TOOL = 124;
const BODY = 20;

export const PICTURE_FLAGS = { live: 1, paused: 2, end: 4, gap: 8 };
export const HAND_FLAGS = {
  contact: 1, softened: 2, limited: 4, forceCut: 8, pointer: 16, free: 32, yours: 64, trueKnown: 128, twin: 256, stopped: 512,
};
export const CAUSES = ['', 'first', 'threshold', 'heartbeat', 'event'];
export const NONE = 0xffff;

// Of hands, contacts, tools and bodies, by the counts in the head.
export function octetsBesideEntities(view) {
  const count = (at) => view.getUint16(at, true);
  return HAND * count(18) + CONTACT * count(20) + TOOL * count(28) + BODY * count(30);
}

// Throws if the length does not match the counts.
export function decodePicture(buffer) {
  if (buffer.byteLength < HEAD) throw new Error('a picture of less than 32 octets');
  const view = new DataView(buffer);
  if (view.getUint32(0, true) !== MAGIC) throw new Error('a picture of another version');
  const entities = view.getUint16(16, true);
  const hands = view.getUint16(18, true);
  const contacts = view.getUint16(20, true);
  const tools = view.getUint16(28, true);
  const bodies = view.getUint16(30, true);
  const length = HEAD + ENTITY * entities + octetsBesideEntities(view);
  if (buffer.byteLength !== length) throw new Error(`a picture of ${buffer.byteLength} octets, its counts give ${length}`);
  return new Picture(buffer, view, entities, hands, contacts, tools, bodies);
}

class Picture {
  constructor(buffer, view, entities, hands, contacts, tools, bodies) {
    this.buffer = buffer;
    this.entities = entities;
    this.number = view.getUint32(4, true);
    this.time = view.getFloat64(8, true);
    this.flags = view.getUint16(22, true);
    this.epoch = view.getUint32(24, true);
    // Views of the buffer: each field of an entity is aligned to its size.
    this.octets = new Uint8Array(buffer);
    this.words = new Uint16Array(buffer);
    this.shorts = new Int16Array(buffer);
    this.floats = new Float32Array(buffer);
    const firstHand = HEAD + ENTITY * entities;
    this.doubles = new Float64Array(buffer, 0, firstHand >> 3);
    this.hands = Array.from({ length: hands }, (_, i) => this.hand(view, firstHand + HAND * i));
    const firstContact = firstHand + HAND * hands;
    this.contacts = Array.from({ length: contacts }, (_, i) => this.contact(view, firstContact + CONTACT * i));
    const firstTool = firstContact + CONTACT * contacts;
    for (let i = 0; i < tools; ++i) this.putTool(view, firstTool + TOOL * i);
    const firstBody = firstTool + TOOL * tools;
    this.bodies = Array.from({ length: bodies }, (_, i) => this.body(view, firstBody + BODY * i));
  }

  // Bodies of the scene, in the order of their numbers; the order of `turn` is w x y z.
  body(view, at) {
    return {
      position: [0, 4, 8].map((k) => number(view.getFloat32(at + k, true))),
      turn: [12, 14, 16, 18].map((k) => view.getInt16(at + k, true) / 32767),
    };
  }

  // The tool of a hand whose device has rotation.
  putTool(view, at) {
    const hand = this.hands.find(({ index }) => index === view.getUint16(at, true));
    if (!hand) return;
    const vector = (offset) => [0, 4, 8].map((k) => number(view.getFloat32(at + offset + k, true)));
    const count = Math.min(view.getUint16(at + 2, true), 8);
    const torque = vector(16);
    hand.tool = { handle: vector(4), torque, newtonMetres: Math.hypot(...torque), probes: Array.from({ length: count }, (_, i) => vector(28 + 12 * i)) };
  }

  hand(view, at) {
    const flags = view.getUint16(at + 2, true);
    const vector = (offset) => [0, 4, 8].map((k) => number(view.getFloat32(at + offset + k, true)));
    const scalar = (offset) => number(view.getFloat32(at + offset, true));
    const force = vector(32);
    return {
      index: view.getUint16(at, true), flags, slot: view.getUint16(at + 4, true), patch: view.getUint16(at + 6, true), position: vector(8),
      surface: vector(20), force, newtons: Math.hypot(...force), normal: vector(44),
      trueForce: flags & HAND_FLAGS.trueKnown ? scalar(56) : null, energy: scalar(60), loan: scalar(64),
      twin: flags & HAND_FLAGS.twin ? scalar(68) : null,
    };
  }

  contact(view, at) {
    const point = [4, 12, 20].map((k) => number(view.getFloat64(at + k, true)));
    const force = [28, 32, 36].map((k) => number(view.getFloat32(at + k, true)));
    return {
      felt: view.getUint16(at, true), feeling: view.getUint16(at + 2, true), point, force,
      newtons: Math.hypot(...force),
    };
  }

  slot(i) { return this.words[(HEAD + ENTITY * i) >> 1]; }
  side(i) { return this.octets[HEAD + ENTITY * i + 2] & 3; }
  cause(i) { return this.octets[HEAD + ENTITY * i + 3]; }
  cell(i) { return this.words[((HEAD + ENTITY * i) >> 1) + 2]; }
  group(i) { return this.words[((HEAD + ENTITY * i) >> 1) + 3]; }
  // Index of the first of three doubles: the predicted position.
  placeAt(i) { return (HEAD >> 3) + (ENTITY >> 3) * i + 1; }
  // Index of the first of three floats: shown minus predicted.
  errorAt(i) { return (HEAD >> 2) + (ENTITY >> 2) * i + 10; }
  // Index of the first of four shorts: w x y z.
  turnAt(i) { return (HEAD >> 1) + (ENTITY >> 1) * i + 16; }
  rate(i) { return this.words[((HEAD + ENTITY * i) >> 1) + 26] / 100; }
  jump(i) { return this.words[((HEAD + ENTITY * i) >> 1) + 27]; }
  // Of the prediction [m/s].
  speed(i) { return number(this.floats[((HEAD + ENTITY * i) >> 2) + 14]); }
  // Of the last update [s].
  age(i) { return number(this.floats[((HEAD + ENTITY * i) >> 2) + 15]); }

  // Index of the entity in a slot, or -1.
  indexOf(slot) {
    if (slot === NONE) return -1;
    if (!this.indices) {
      this.indices = new Map();
      for (let i = 0; i < this.entities; ++i) this.indices.set(this.slot(i), i);
    }
    return this.indices.get(slot) ?? -1;
  }
}

function number(x) { return Number.isFinite(x) ? x : 0; }
