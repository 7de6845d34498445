// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The modules of the page that need no browser:  node page_modules.mjs tools/viewer/page
import assert from 'node:assert/strict';
import test from 'node:test';
import { picture } from './made_picture.mjs';
import { take } from './page_copy.mjs';

const { decodePicture, HAND_FLAGS } = await take('picture.js');
const { Samples } = await take('samples.js');
const { COMMANDS } = await take('commands.js');
const { Recorder, base64 } = await take('recorder.js');
const { Replay } = await take('replay.js');
const { filledFrame } = await take('saving.js');
const { Moment } = await take('moment.js');
const { Steering } = await take('steering.js');
const { hull } = await take('hull.js');
const { plotDelay } = await take('plot_delay.js');
const { plotError } = await take('plot_error.js');
const { plotForce } = await take('plot_force.js');
const { plotEnergy } = await take('plot_energy.js');
const { digits, foreign, roundUp } = await take('words.js');

test('A body is where its picture has it, and between two of them half way', () => {
  const at = (time, z) => decodePicture(picture({ time, bodies: [{ position: [0, 0, z] }, { position: [1, 0, z], turn: [0, 0, 32767, 0] }] }));
  const [, second] = at(0, 2).bodies;
  assert.deepEqual([second.position, second.turn], [[1, 0, 2], [0, 0, 1, 0]]);
  const moment = new Moment();
  moment.set(at(0, 2), at(1, 4), 0.5);
  assert.deepEqual(moment.bodies[0].position, [0, 0, 3]);
});

test('A tool belongs to the hand of its number, and moves as it does', () => {
  const at = (time, x) => decodePicture(picture({
    time, hands: [{ index: 0 }, { index: 4 }], tools: [{ hand: 4, torque: [0, 3, 4], handle: [x, 0, 0], probes: [[x, 1, 0], [x, 2, 0]] }],
  }));
  const [bare, held] = at(1, 2).hands;
  assert.equal(bare.tool, undefined);
  assert.deepEqual([held.tool.handle, held.tool.probes, held.tool.newtonMetres], [[2, 0, 0], [[2, 1, 0], [2, 2, 0]], 5]);
});

test('A picture gives each field back', () => {
  const decoded = decodePicture(picture({
    time: 12.5, number: 9, entities: [{ slot: 3, x: 2 }, { slot: 8, x: 4, error: 0.5 }], hands: [{ index: 1, flags: 128, patch: 5, force: [3, 0, 4] }], contacts: 2,
  }));
  assert.deepEqual([decoded.time, decoded.number, decoded.epoch, decoded.entities], [12.5, 9, 7, 2]);
  assert.deepEqual([decoded.slot(1), decoded.side(1), decoded.cause(1), decoded.cell(1), decoded.group(1), decoded.rate(1), decoded.jump(1)],
    [8, 1, 2, 27, 513, 2.5, 12]);
  assert.deepEqual([decoded.doubles[decoded.placeAt(1)], decoded.floats[decoded.errorAt(1)], decoded.shorts[decoded.turnAt(1)]], [4, 0.5, 32767]);
  assert.deepEqual([decoded.indexOf(8), decoded.indexOf(4)], [1, -1]);
  const [hand] = decoded.hands;
  assert.deepEqual([hand.index, hand.patch, hand.newtons, hand.trueForce, hand.energy, hand.loan, hand.twin], [1, 5, 5, 5, 6, 7, null]);
  assert.equal(decoded.contacts.length, 2);
});

test('A picture whose length does not follow from its counts is refused', () => {
  const whole = picture({ entities: [{ slot: 1 }], hands: [{}], contacts: 1 });
  for (let length = 0; length < whole.byteLength; ++length) assert.throws(() => decodePicture(whole.slice(0, length)));
  const longer = new Uint8Array(whole.byteLength + 4);
  longer.set(new Uint8Array(whole));
  assert.throws(() => decodePicture(longer.buffer), /its counts give/);
  const counted = whole.slice(0);
  new DataView(counted).setUint16(16, 65535, true);
  assert.throws(() => decodePicture(counted), /its counts give/);
});

test('A picture of another version is refused', () => {
  const other = picture({});
  new DataView(other).setUint32(0, 0x31564b52, true);
  assert.throws(() => decodePicture(other), /version/);
});

test('A hand with impossible numbers counts as without force', () => {
  const [hand] = decodePicture(picture({ hands: [{ force: [NaN, Infinity, 1], position: [NaN, 0, 0] }] })).hands;
  assert.deepEqual([hand.force, hand.newtons, hand.position], [[0, 0, 1], 1, [0, 0, 0]]);
});

test('Between two pictures an entity is found by its slot, and shown is predicted plus error', () => {
  const moment = new Moment();
  const a = decodePicture(picture({ entities: [{ slot: 1, x: 10 }, { slot: 2, x: 20 }] }));
  const b = decodePicture(picture({ time: 1, entities: [{ slot: 2, x: 30, error: 2 }, { slot: 5, x: 50 }] }));
  moment.set(a, b, 0.5);
  assert.deepEqual([moment.predicted[0], moment.shown[0], moment.predicted[3]], [25, 26, 50]);
  assert.deepEqual([...moment.turns.subarray(0, 4)], [1, 0, 0, 0]);
});

test('A quaternion turns the short way between two pictures', () => {
  const moment = new Moment();
  const a = decodePicture(picture({ entities: [{ slot: 1, turn: [32767, 0, 0, 0] }] }));
  const b = decodePicture(picture({ entities: [{ slot: 1, turn: [-32767, 0, 0, 0] }] }));
  moment.set(a, b, 0.5);
  assert.equal(Math.abs(moment.turns[0]), 1);
});

test('A gap between samples stays a gap', () => {
  const samples = new Samples();
  for (const time of [0, 0.5, 1, 5, 5.5]) samples.take(time, [time], false);
  assert.deepEqual(samples.columns(0, 10, 1, 1), [[0, 0.5, 1, 3, 5, 5.5], [0, 0.5, 1, null, 5, 5.5]]);
  samples.take(5.8, [6], true);
  assert.deepEqual(samples.columns(5.2, 10, 1, 1)[1], [5.5, null, 6]);
});

test('Samples of somebody who goes back stand in their place', () => {
  const samples = new Samples();
  for (const time of [3, 1, 2, 2, 4]) samples.take(time, [10 * time], false);
  assert.deepEqual(samples.columns(0, 10, 1, 2), [[1, 2, 3, 4], [10, 20, 30, 40]]);
});

test('Samples are bounded', () => {
  const samples = new Samples();
  for (let i = 0; i < 9000; ++i) samples.take(i, [i], false);
  assert.equal(samples.rows.length, 6000);
  assert.equal(samples.rows.at(-1).time, 8999);
});

test('Commands have the octets of the protocol', () => {
  const hex = (buffer) => Buffer.from(buffer).toString('hex');
  assert.equal(hex(COMMANDS.drawn(0x01020304)), '0104030201');
  assert.equal(hex(COMMANDS.seek(1)), '02000000000000f03f');
  assert.equal(hex(COMMANDS.speed(1)), '030000803f');
  assert.equal(hex(COMMANDS.live()), '04');
  assert.equal(hex(COMMANDS.step(-2)), '05fe');
  assert.equal(hex(COMMANDS.pointer(1, [1, 0, 0], true, false)), '0601000000803f000000000000000001');
  assert.equal(hex(COMMANDS.pointer(1, [1, 0, 0], true, true)), '0601000000803f000000000000000002');
  assert.equal(hex(COMMANDS.network({ delay: 1, jitter: 0, loss: 1, outage: true })), '070000803f000000000000803f01');
  assert.deepEqual([hex(COMMANDS.askHand()), hex(COMMANDS.giveHand()), hex(COMMANDS.follow(258))], ['08', '09', '0a0201']);
  assert.equal(hex(COMMANDS.goAlone()), '0b');
});

// A canvas that is touched: what a hand and a camera were told.
function touched(hasHand) {
  const listeners = new Map();
  const told = [];
  const note = (name) => (...values) => told.push([name, ...values.filter((x) => typeof x === 'number')]);
  const canvas = { addEventListener: (type, act) => listeners.set(type, act), setPointerCapture() {} };
  const orbit = { zoom: note('zoom'), pan: note('pan'), turn: note('turn') };
  const hand = { index: hasHand ? 0 : null, move: note('move'), deepen: note('deepen'), release: note('release') };
  new Steering({ stage: { canvas, large: 'touch', pointed() {}, view: () => ({ orbit }) }, hand, moment: {}, fit() {}, follow() {} });
  const finger = (id) => {
    let last = [0, 0];
    const send = (type, [x, y]) => {
      listeners.get(type)({ pointerId: id, pointerType: 'touch', button: type === 'pointermove' ? -1 : 0, buttons: 1, clientX: x, clientY: y,
        offsetX: x, offsetY: y, movementX: x - last[0], movementY: y - last[1] });
      last = [x, y];
    };
    return { down: (...at) => send('pointerdown', at), to: (...at) => send('pointermove', at),
      up: () => { send('pointerup', last); send('pointerleave', last); } };
  };
  const mouse = (type, buttons) => listeners.get(type)({ pointerId: 9, pointerType: 'mouse', button: 0, buttons, clientX: 0, clientY: 0,
    offsetX: 0, offsetY: 0, movementX: 0, movementY: 0 });
  return { finger, mouse, hand, told: () => told.splice(0) };
}

test('One finger moves a hand in its plane, a second one in depth, and the camera stands', () => {
  const { finger, told } = touched(true);
  const [one, two] = [finger(1), finger(2)];
  one.down(10, 20);
  one.to(15, 25);
  assert.deepEqual(told(), [['move', 10, 20], ['move', 15, 25]]);
  two.down(200, 100);
  two.to(230, 90);
  one.to(18, 26);
  two.to(230, 130);
  assert.deepEqual(told(), [['deepen', -10], ['move', 18, 26], ['deepen', 40]]);
  two.up();
  one.to(20, 26);
  assert.deepEqual(told(), [['move', 20, 26]], 'the hand is held on');
  two.down(50, 50);
  one.up();
  two.to(90, 90);
  two.up();
  assert.deepEqual(told(), [['release']], 'the finger that is left moves nothing');
});

test('The button of a mouse that is a hand holds what the hand touches, a finger does not', () => {
  const { finger, mouse, hand } = touched(true);
  mouse('pointermove', 0);
  assert.ok(!hand.grabs);
  mouse('pointerdown', 1);
  assert.ok(hand.grabs);
  mouse('pointerup', 0);
  assert.ok(!hand.grabs);
  finger(1).down(1, 1);
  assert.ok(!hand.grabs);
});

test('A mouse turns the picture while a gamepad moves the hand', () => {
  const { mouse, hand, told } = touched(true);
  hand.by = 'pad';
  for (const [type, buttons] of [['pointerdown', 1], ['pointermove', 1], ['pointerleave', 0]]) mouse(type, buttons);
  assert.deepEqual(told(), [['turn', 0, 0]]);
});

test('Without a hand two fingers move the camera alone', () => {
  const { finger, told } = touched(false);
  const [one, two] = [finger(1), finger(2)];
  one.down(0, 0);
  two.down(100, 0);
  two.to(200, 0);
  assert.deepEqual(told(), [['zoom', 0.5], ['pan', 50, 0]]);
});

test('The plot of errors shows all against at most three thresholds, or the followed one against its own', () => {
  const at = (error, followed = 65535) => {
    const moment = { picture: decodePicture(picture({ entities: [{ slot: 3 }] })), followed, numbers: { error } };
    return plotError.lines.map((line) => line.at(moment)).map((x) => (Number.isFinite(x) ? x : null));
  };
  const all = { mean_m: 0.25, worst_m: 2, thresholds_m: [0.0005, 1] };
  assert.deepEqual(at(all), [250, 2000, null, null, 0.5, 1000, null]);
  assert.deepEqual(at({ ...all, followed_m: 1 }, 3), [null, null, 12, 1000, null, null, null]);
  assert.deepEqual(at({ mean_m: 0.25 }), [250, null, null, null, null, null, null]);
  assert.deepEqual(at(undefined), Array(7).fill(null));
});

test('The plot of delay shows the peers where a program has some, and never both', () => {
  const at = (numbers) => plotDelay.lines.map((line) => line.at({ numbers })).map((x) => (Number.isFinite(x) ? x : null));
  const heard = { delay_ms: { median: 1, p95: 2 }, lost_share: 0 };
  assert.deepEqual(at(heard), [null, null, null, 1, 2, 0]);
  assert.deepEqual(at({ ...heard, peers: { delay_ms: { median: 100, p95: 130 }, lost_share: 0.2 } }), [100, 130, 20, null, null, null]);
  assert.deepEqual(at({ ...heard, peers: {} }), Array(6).fill(null), 'an outage');
});

test('A hull goes round its points', () => {
  assert.deepEqual(hull([[0, 0], [2, 0], [1, 1], [2, 2], [0, 2], [1, 0]]), [[0, 0], [2, 0], [2, 2], [0, 2]]);
  assert.deepEqual(hull([[3, 1], [1, 1]]), [[1, 1], [3, 1]]);
  assert.deepEqual(hull([]), []);
});

function saved(times) {
  const recorder = new Recorder();
  recorder.text({ type: 'hello', kind: 'demo', may_push: true });
  recorder.text({ type: 'hand', index: 0 });
  for (const time of times) recorder.picture(decodePicture(picture({ time, number: Math.round(time), entities: [{ slot: 1, x: time }] })));
  return recorder.saved();
}

test('A saved minute begins with what is known and may not push', () => {
  const items = saved([100, 101, 102]);
  assert.deepEqual(items.map(([ms, type]) => [ms, type]), [[0, 'text'], [0, 'picture'], [1000, 'picture'], [2000, 'picture']]);
  assert.deepEqual([items[0][2].kind, items[0][2].may_push], ['saved', false]);
});

test('A recorder keeps a minute, and what was known before it', () => {
  const items = saved(Array.from({ length: 200 }, (_, i) => i));
  assert.equal(items.filter(([, type]) => type === 'picture').length, 61);
  assert.equal(items[0][2].type, 'hello');
});

test('A recorder thins pictures that are too large', () => {
  const recorder = new Recorder(60 * 100 * 10); // 10 of 100 octets a second
  for (let i = 0; i < 3000; ++i) recorder.picture(decodePicture(picture({ time: i / 50, entities: [{ slot: 1 }, { slot: 2 }] })));
  const octets = recorder.items.reduce((sum, [, , buffer]) => sum + buffer.byteLength, 0);
  assert.ok(octets <= 60 * 100 * 10 * 1.05 && octets > 60 * 100 * 10 * 0.8, `${octets}`);
});

test('A recorder takes nothing twice from somebody who looks back', () => {
  assert.equal(saved([1, 2, 3, 1.5, 2.5, 3, 4]).filter(([, type]) => type === 'picture').length, 4);
});

function replay(times) {
  const heard = [];
  const one = new Replay(saved(times), {
    text: (text) => heard.push(text.type === 'play' ? text.state : text.type), picture: ({ time }) => heard.push(time), state() {}, bad: (text) => heard.push(text),
  });
  one.start();
  one.advance(0);
  const since = () => heard.splice(0);
  return { one, since };
}

test('A saved minute plays by the clock, in its speed, to its end, and again', () => {
  const { one, since } = replay([100, 101, 102]);
  assert.deepEqual(since(), ['hello', 100, 'playing']);
  one.advance(500);
  assert.deepEqual(since(), []);
  one.advance(1000);
  assert.deepEqual(since(), [101]);
  one.tell('speed', 2);
  one.advance(1500);
  assert.deepEqual(since(), ['playing', 102, 'end']);
  one.tell('speed', 1);
  assert.deepEqual(since(), ['hello', 100, 'playing']);
});

test('A saved minute goes to any instant and steps by seconds and by pictures', () => {
  const { one, since } = replay([100, 101, 102, 103]);
  since();
  one.tell('speed', 0);
  one.tell('seek', 102.4);
  assert.deepEqual(since(), ['paused', 'hello', 102, 'paused']);
  one.tell('step', -2);
  assert.deepEqual(since(), ['hello', 101, 'paused']);
  one.tell('step', 1);
  assert.deepEqual(since(), ['hello', 102, 'paused']);
  one.tell('step', 2);
  one.tell('step', 2);
  assert.deepEqual(since().filter((x) => typeof x === 'number'), [103, 103]);
  one.advance(9e5);
  assert.deepEqual(since(), []);
  assert.deepEqual(one.span, [100, 103]);
  one.tell('seek', 100);
  since();
  one.tell('live');
  assert.deepEqual(since(), ['hello', 103, 'end']);
});

test('A saved minute without pictures, and one with a damaged picture, say so and do not throw', () => {
  const heard = [];
  const hear = { text() {}, picture() {}, state() {}, bad: (text) => heard.push(text) };
  new Replay([], hear).start();
  const good = saved([1, 2]);
  const one = new Replay([...good, [1500, 'picture', base64(new Uint8Array(9))]], hear);
  one.start();
  one.tell('seek', 2.5);
  assert.equal(heard.length, 1);
});

test('A frame holds what it is to play, whatever is in it', () => {
  const frame = '<script type="application/json" id="saved"></script><script type="module">id="saved"></script>';
  const items = [[0, 'text', { type: 'note', text: '</script><script>alert(1)</script> $& $`' }]];
  const html = filledFrame(frame, items);
  assert.equal(html.split('</script>').length, 3); // its own two
  assert.deepEqual(JSON.parse(/id="saved">(.*?)<\/script>/s.exec(html)[1]), items);
});

test('Of hidden twins your own one is shown, else the first, and the energy of all together', () => {
  const hands = decodePicture(picture({ hands: [{ index: 0, flags: HAND_FLAGS.twin }, { index: 1, flags: HAND_FLAGS.twin }] })).hands;
  hands[1].twin = 3;
  const numbers = { twin: [{ hand: 0, energy: -0.03, resets: 1 }, { hand: 1, energy: 0.01, resets: 1 }] };
  const line = (plot) => plot.lines.find(({ says }) => says.startsWith('without the gate')).at;
  assert.equal(line(plotForce)({ hands, numbers }), 8);
  assert.ok(Math.abs(line(plotEnergy)({ hands, numbers }) + 20) < 1e-9);
  hands[1].flags |= HAND_FLAGS.yours;
  assert.equal(line(plotForce)({ hands, numbers }), 3);
  hands[1].twin = null; // it stands aside
  assert.equal(line(plotForce)({ hands, numbers }), null);
  assert.ok(!Number.isFinite(line(plotForce)({ hands, numbers: {} })));
  assert.equal(line(plotEnergy)({ hands, numbers: {} }), null);
});

test('Words are short, whatever comes', () => {
  assert.deepEqual([digits(2.3149), digits(0.019), digits(1234.5), digits(NaN), digits(undefined), digits(-31.25)], ['2.31', '0.02', '1,235', '–', '–', '-31.3']);
  assert.equal(foreign('x'.repeat(500)).length, 80);
  assert.deepEqual([roundUp(0.03), roundUp(1), roundUp(11), roundUp(50)].map((x) => Number(x.toPrecision(6))), [0.05, 1, 20, 50]);
  assert.ok(HAND_FLAGS.trueKnown === 128);
});
