// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Pictures of a connection, each sent as a difference from the one before; docs/viewer_protocol.md
// has the layout. Entities move on by their last velocity until the server corrects them.
import { decodePicture, ENTITY, HEAD, MAGIC, octetsBesideEntities } from './picture.js';

const STREAM_MAGIC = 0x34564b52; // "RKV4"
const STREAM_HEAD = HEAD + 4;
const WHOLE_PICTURE = 16; // flag of a picture that begins with no entity
const VELOCITY = 0.5; // quanta a second of a velocity unit
const SLOTS = 0xffff;
const PART = { left: 1, update: 2, place: 4, rate: 8 };
const ROOM = 1024; // slots that are added at once

export class PictureStream {
  constructor() {
    this.quantum = 0; // [m]; 0: the next picture has to be whole
    this.slots = []; // of the entities, rising
    this.columns = {};
    this.grow(0);
  }

  // The whole picture for a message; null if it depends on one that is lost. Throws if it is broken.
  take(buffer) {
    const view = new DataView(buffer);
    if (buffer.byteLength < STREAM_HEAD) throw new Error(`a picture of less than ${STREAM_HEAD} octets`);
    if (view.getUint32(0, true) !== STREAM_MAGIC) throw new Error('a picture of another version');
    const isWhole = (view.getUint16(22, true) & WHOLE_PICTURE) !== 0;
    if (!isWhole && !this.quantum) return null;
    const { quantum } = this;
    this.quantum = 0; // in case that it is broken
    if (!isWhole && quantum !== 2 ** -view.getUint8(STREAM_HEAD - 2)) throw new Error('a picture of another quantum');
    const first = STREAM_HEAD + octetsBesideEntities(view);
    if (buffer.byteLength < first) throw new Error(`a picture of ${buffer.byteLength} octets, its counts give ${first}`);
    this.begin(view, isWhole);
    this.read(new Reader(view, first), view.getUint16(STREAM_HEAD - 4, true));
    if (this.slots.length !== view.getUint16(16, true)) throw new Error(`a picture of ${this.slots.length} entities, its head has ${view.getUint16(16, true)}`);
    const picture = this.whole(buffer, first);
    this.quantum = 2 ** -view.getUint8(STREAM_HEAD - 2);
    return decodePicture(picture);
  }

  grow(slot) {
    if (this.room > slot) return;
    this.room = Math.min(SLOTS, slot + ROOM);
    const column = (name, Type, width) => {
      const longer = new Type(width * this.room);
      if (this.columns[name]) longer.set(this.columns[name]);
      this.columns[name] = longer;
    };
    for (const name of ['place', 'velocity', 'error']) column(name, Float64Array, 3);
    column('turn', Int16Array, 4);
    column('updated', Float64Array, 1); // [ms]
    for (const name of ['cell', 'group', 'rate', 'jump']) column(name, Uint16Array, 1);
    for (const name of ['side', 'cause', 'shown']) column(name, Uint8Array, 1);
  }

  forget(slot) {
    for (const column of Object.values(this.columns)) {
      const width = column.length / this.room;
      column.fill(0, width * slot, width * (slot + 1));
    }
  }

  begin(view, isWhole) {
    const time = view.getFloat64(8, true);
    if (isWhole) {
      for (const column of Object.values(this.columns)) column.fill(0);
      this.slots = [];
    }
    this.unit = 2 ** -view.getUint8(STREAM_HEAD - 2);
    const step = VELOCITY * this.unit * (isWhole ? 0 : time - this.time);
    this.time = time;
    const { place, velocity } = this.columns;
    for (const slot of this.slots) {
      for (let k = 3 * slot; k < 3 * slot + 3; ++k) place[k] += step * velocity[k];
    }
  }

  read(reader, count) {
    let next = 0;
    let changed = false;
    for (let i = 0; i < count; ++i) {
      const number = reader.varint();
      const slot = next + Math.floor(number / 2);
      if (slot >= SLOTS) throw new Error('a picture with a slot out of range');
      next = slot + 1;
      this.grow(slot);
      const codes = reader.u8();
      const parts = number % 2 ? reader.u8() : 0;
      const was = this.columns.shown[slot];
      if (parts & PART.left) this.forget(slot);
      else this.readEntity(reader, slot, codes, parts);
      changed ||= was !== this.columns.shown[slot];
    }
    if (!reader.ended) throw new Error('a picture with octets behind its last record');
    if (changed) this.slots = Array.from(this.columns.shown.keys()).filter((slot) => this.columns.shown[slot]);
  }

  readEntity(reader, slot, codes, parts) {
    const { place, velocity, error, turn, updated, cell, group, rate, jump, side, cause, shown } = this.columns;
    shown[slot] = 1;
    reader.triple(codes & 3, this.unit, place, 3 * slot);
    reader.triple((codes >> 2) & 3, 1, velocity, 3 * slot);
    reader.triple((codes >> 4) & 3, 1, error, 3 * slot);
    const turned = codes >> 6;
    for (let k = 4 * slot; turned && k < 4 * slot + 4; ++k) turn[k] = turned === 1 ? turn[k] + reader.i8() : reader.i16();
    if (parts & PART.update) {
      cause[slot] = reader.u8();
      jump[slot] = reader.varint();
      updated[slot] += reader.zigzag();
    }
    if (parts & PART.place) {
      side[slot] = reader.u8();
      cell[slot] = reader.u16();
      group[slot] = reader.u16();
    }
    if (parts & PART.rate) rate[slot] = reader.varint();
  }

  // The octets of the whole picture; `first`: end of what is not of entities.
  whole(buffer, first) {
    const beside = new Uint8Array(buffer, STREAM_HEAD, first - STREAM_HEAD);
    const octets = new Uint8Array(HEAD + ENTITY * this.slots.length + beside.length);
    octets.set(new Uint8Array(buffer, 0, HEAD));
    octets.set(beside, HEAD + ENTITY * this.slots.length);
    const head = new DataView(octets.buffer);
    head.setUint32(0, MAGIC, true);
    head.setUint16(22, head.getUint16(22, true) & ~WHOLE_PICTURE, true);
    this.writeEntities(octets);
    return octets.buffer;
  }

  writeEntities(octets) {
    const { place, velocity, error, turn, updated, cell, group, rate, jump, side, cause } = this.columns;
    const words = new Uint16Array(octets.buffer);
    const floats = new Float32Array(octets.buffer);
    const doubles = new Float64Array(octets.buffer, 0, (HEAD + ENTITY * this.slots.length) >> 3);
    let at = HEAD;
    for (const slot of this.slots) {
      const [word, float, double] = [at >> 1, at >> 2, at >> 3];
      words[word] = slot;
      octets[at + 2] = side[slot];
      octets[at + 3] = cause[slot];
      words[word + 2] = cell[slot];
      words[word + 3] = group[slot];
      for (let k = 0; k < 3; ++k) doubles[double + 1 + k] = place[3 * slot + k];
      for (let k = 0; k < 4; ++k) words[word + 16 + k] = turn[4 * slot + k];
      for (let k = 0; k < 3; ++k) floats[float + 10 + k] = this.unit * error[3 * slot + k];
      words[word + 26] = rate[slot];
      words[word + 27] = jump[slot];
      const [x, y, z] = [velocity[3 * slot], velocity[3 * slot + 1], velocity[3 * slot + 2]];
      floats[float + 14] = VELOCITY * this.unit * Math.sqrt(x * x + y * y + z * z);
      floats[float + 15] = Math.max(0, this.time - updated[slot] / 1000);
      at += ENTITY;
    }
  }
}

class Reader {
  constructor(view, at) { Object.assign(this, { view, at }); }
  get ended() { return this.at === this.view.byteLength; }
  u8() { return this.view.getUint8(this.at++); }
  i8() { return this.view.getInt8(this.at++); }
  u16() { return this.view.getUint16((this.at += 2) - 2, true); }
  i16() { return this.view.getInt16((this.at += 2) - 2, true); }
  u32() { return this.view.getUint32((this.at += 4) - 4, true); }

  varint() {
    let value = 0;
    for (let scale = 1; scale <= 2 ** 49; scale *= 128) {
      const octet = this.u8();
      value += (octet & 127) * scale;
      if (octet < 128) return value;
    }
    throw new Error('a picture with a number that is too long');
  }

  zigzag() {
    const value = this.varint();
    return value % 2 ? -(value + 1) / 2 : value / 2;
  }

  // Adds three changes to `values` from `at` on, by their code.
  triple(code, scale, values, at) {
    if (!code) return;
    const bits = code === 1 ? 5 : 10;
    const all = code === 1 ? this.u16() : code === 2 ? this.u32() : 0;
    for (let k = 0; k < 3; ++k) values[at + k] += scale * (code === 3 ? this.zigzag() : (all << (32 - bits * (k + 1))) >> (32 - bits));
  }
}
