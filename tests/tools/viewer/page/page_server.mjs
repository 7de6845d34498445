// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a page holds on to its server, with a browser that is stepped by hand:  node page_server.mjs tools/viewer/page
import assert from 'node:assert/strict';
import test from 'node:test';
import { take } from './page_copy.mjs';

const { Server } = await take('server.js');

test('A refused page shows why, and comes back when it is seen', (context) => {
  const sockets = [], waits = [], states = [], seen = [];
  globalThis.location = { protocol: 'https:', host: 'page.lan:8642' };
  globalThis.document = { hidden: false, addEventListener: (name, call) => seen.push(call) };
  globalThis.WebSocket = class { constructor(url) { sockets.push(this); this.url = url; } };
  context.mock.method(globalThis, 'setTimeout', (call, wait) => { waits.push(wait); later = call; });
  let later;
  const server = new Server('1f2e', { state: (state, text) => states.push([state, text]), text() {} });
  const say = (message) => sockets.at(-1).onmessage({ data: JSON.stringify(message) });
  assert.equal(sockets[0].url, 'wss://page.lan:8642/stream?word=1f2e');
  for (let i = 0; i < 5; ++i) {
    say({ type: 'bye', text: 'this exercise has a key' });
    sockets.at(-1).onclose();
    assert.deepEqual(states.at(-1), ['lost', 'this exercise has a key']);
    later();
  }
  assert.deepEqual(waits, [500, 1000, 2000, 4000, 4000], 'a refusal is no reason to hurry');
  document.hidden = true;
  sockets.at(-1).onclose();
  later();
  assert.equal(sockets.length, 6, 'a hidden tab draws nothing');
  document.hidden = false;
  seen.pop()();
  assert.equal(sockets.length, 7);
  say({ type: 'hello' });
  assert.deepEqual(states.at(-1), ['live', '']);
  assert.deepEqual([server.bye, server.wait], ['', 500]);
});
