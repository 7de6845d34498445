// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Pictures as differences:  node page_stream.mjs tools/viewer/page
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { take } from './page_copy.mjs';

const { PictureStream } = await take('picture_stream.js');
const { Server } = await take('server.js');

// Messages and the whole pictures that they mean, made by the program (PictureDifference.KeepsTheSampleOfThePage).
const lines = readFileSync(new URL('./stream_sample.txt', import.meta.url), 'utf8').trim().split('\n');
const octets = (hex) => Uint8Array.from(hex.match(/../g), (pair) => parseInt(pair, 16)).buffer;
const messages = lines.filter((_, i) => i % 2 === 0).map(octets);
const wholes = lines.filter((_, i) => i % 2 === 1);
const hexOf = (buffer) => Buffer.from(buffer).toString('hex');
const WHOLE = 16;
const isWhole = (message) => (new DataView(message).getUint16(22, true) & WHOLE) !== 0;

test('Differences give the whole pictures of the program, octet by octet', () => {
  const stream = new PictureStream();
  messages.forEach((message, i) => assert.equal(hexOf(stream.take(message).buffer), wholes[i], `picture ${i}`));
  assert.deepEqual(messages.map(isWhole).filter(Boolean).length, 2);
});

test('A picture does not change when later ones come', () => {
  const stream = new PictureStream();
  const first = stream.take(messages[0]);
  for (const message of messages.slice(1)) stream.take(message);
  assert.equal(hexOf(first.buffer), wholes[0]);
});

test('A page without a base waits for a whole picture', () => {
  const stream = new PictureStream();
  assert.equal(stream.take(messages[1]), null);
  assert.equal(stream.take(messages[9]), null);
  assert.equal(hexOf(stream.take(messages[10]).buffer), wholes[10]);
  assert.equal(hexOf(stream.take(messages[11]).buffer), wholes[11]);
});

test('A cut message is refused at every length, and the base is lost until a whole picture', () => {
  for (let length = 0; length < messages[1].byteLength; ++length) {
    const stream = new PictureStream();
    stream.take(messages[0]);
    assert.throws(() => stream.take(messages[1].slice(0, length)));
    if (length < 36) continue;
    assert.equal(stream.take(messages[2]), null);
    assert.equal(hexOf(stream.take(messages[10]).buffer), wholes[10]);
  }
});

test('Another version, quantum, count or slot is refused', () => {
  const broken = (message, change) => {
    const stream = new PictureStream();
    stream.take(messages[0]);
    const copy = message.slice(0);
    change(new DataView(copy));
    return () => stream.take(copy);
  };
  assert.throws(broken(messages[1], (view) => view.setUint32(0, 0x33564b52, true)), /version/);
  assert.throws(broken(messages[1], (view) => view.setUint8(34, 10)), /quantum/);
  assert.throws(broken(messages[1], (view) => view.setUint16(16, 3, true)), /its head has 3/);
  assert.throws(broken(messages[0], (view) => view.setUint16(32, 3, true)), /behind its last record/);
  assert.throws(broken(messages[0], (view) => view.setUint16(32, 99, true)));
  const first = 36 + 72 + 2 * 20;
  assert.throws(broken(messages[0], (view) => { for (let k = 0; k < 8; ++k) view.setUint8(first + k, 0xff); }), /too long/);
  assert.throws(broken(messages[0], (view) => [0xff, 0xff, 0xff, 0x7f].forEach((x, k) => view.setUint8(first + k, x))), /slot/);
});

test('A page that cannot read a picture acknowledges it and asks for a whole one', () => {
  const sent = [], pictures = [];
  globalThis.location = { protocol: 'http:', host: 'page:1' };
  globalThis.document = { hidden: false };
  globalThis.WebSocket = class {
    static OPEN = 1;
    constructor() { this.readyState = 1; }
    send(buffer) { sent.push(new Uint8Array(buffer)[0]); }
  };
  const server = new Server('', { state() {}, text() {}, bad() {}, picture: ({ time }) => pictures.push(time) });
  const hear = (data) => server.socket.onmessage({ data });
  hear(messages[0]);
  hear(messages[1].slice(0, 50));
  assert.deepEqual([sent, server.bad], [[1, 12], 1]);
  hear(messages[2]);
  assert.deepEqual([sent, server.bad], [[1, 12, 1], 1], 'one request is enough');
  hear(messages[10]);
  assert.deepEqual(pictures, [100, 100.3125]);
});
