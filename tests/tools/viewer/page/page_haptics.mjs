// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Gamepads, rumble and vibration without a browser:  node page_haptics.mjs tools/viewer/page
import assert from 'node:assert/strict';
import test from 'node:test';
import { take } from './page_copy.mjs';

const { connectedPads, readPad, shaped, STICK } = await take('gamepad.js');
const { Feeling, slipSpeed } = await take('feeling.js');
const { FULL_FORCE, FULL_SLIP, magnitudes, Motor, pulse, RUMBLE, VIBRATION } = await take('rumble.js');

const CONTACT = 1;
const near = (x, y) => assert.ok(Math.abs(x - y) < 1e-9, `${x} is not ${y}`);

function padOf({ axes = [0, 0, 0, 0], near: left = 0, away = 0, first = false, second = false } = {}) {
  const buttons = Array.from({ length: 17 }, () => ({ pressed: false, value: 0 }));
  [buttons[0].pressed, buttons[1].pressed, buttons[6].value, buttons[7].value] = [first, second, left, away];
  return { axes, buttons };
}

function browserWith(parts) {
  Object.defineProperty(globalThis, 'navigator', { value: parts, configurable: true });
}

test('A stick rests in its dead zone, is fine near it, and full at its end', () => {
  assert.deepEqual(shaped(STICK.dead, 0), [0, 0]);
  assert.deepEqual(shaped(0.1, -0.1), [0, 0], 'the dead zone is round');
  near(shaped(1, 0)[0], 1);
  const half = shaped(0, -(1 + STICK.dead) / 2)[1];
  near(half, -(0.5 ** STICK.curve));
  const [x, y] = shaped(0.6, 0.8);
  near(x / y, 0.75);
  near(Math.hypot(...shaped(1, 1)), 1, 'a corner is no faster');
});

test('A stick of impossible numbers rests, as a missing one does', () => {
  for (const x of [NaN, Infinity, undefined, null, 'left']) assert.deepEqual(shaped(x, x), [0, 0]);
  near(shaped(7, 0)[0], 1);
  assert.deepEqual(readPad({ axes: [], buttons: [] }).motion, [0, 0, 0]);
  assert.deepEqual(readPad({}), { motion: [0, 0, 0], moves: false, first: false, second: false });
});

test('Sticks and triggers move a hand right, up and away', () => {
  const motion = (parts) => readPad(padOf(parts)).motion;
  assert.deepEqual(motion({ axes: [1, 0, 0, 0] }), [1, 0, 0]);
  assert.deepEqual(motion({ axes: [0, -1, 0, 0] }), [0, 1, 0]);
  assert.deepEqual(motion({ axes: [0, 0, 1, -1] }), [0, 0, 1], 'the right stick up is away, its sides are free');
  assert.deepEqual(motion({ near: 1 }), [0, 0, -1]);
  assert.deepEqual(motion({ away: 1, axes: [0, 0, 0, -1] }), [0, 0, 1], 'both are no faster');
  const { moves, first, second } = readPad(padOf({ axes: [0.1, 0, 0, 0], first: true }));
  assert.deepEqual([moves, first, second], [false, true, false]);
});

test('The list of gamepads may have gaps, be forbidden, or be absent', () => {
  browserWith({ getGamepads: () => [null, { index: 1 }, undefined, { index: 3, connected: false }] });
  assert.deepEqual(connectedPads(), [{ index: 1 }]);
  browserWith({ getGamepads: () => { throw new Error('forbidden'); } });
  assert.deepEqual(connectedPads(), []);
  browserWith({});
  assert.deepEqual(connectedPads(), []);
});

test('Motors follow force and slip up to their full, and a new contact is a pulse', () => {
  const at = (newtons, slip, touches = true, begins = false) => Object.values(magnitudes({ newtons, slip, touches }, begins));
  assert.deepEqual(at(0, 0), [0, 0]);
  assert.deepEqual(at(FULL_FORCE / 2, FULL_SLIP / 4), [0.5, 0.25]);
  assert.deepEqual(at(100, 100), [1, 1]);
  assert.deepEqual(at(FULL_FORCE / 2, FULL_SLIP, false), [0.5, 0], 'a force without a contact has no slip');
  assert.deepEqual(at(NaN, NaN), [0, 0]);
  assert.deepEqual(at(0, 0, true, true), [0.8, 0.8]);
  assert.deepEqual([0, 0.1, FULL_FORCE / 2, 100, NaN].map((newtons) => pulse({ newtons, touches: true }, false)), [0, 10, 50, 100, 0]);
  assert.deepEqual([pulse({ newtons: 1, touches: false }, false), pulse({ newtons: 0, touches: true }, true)], [0, 60]);
});

// Motors that record what they get: a magnitude, or `still`.
function motors(answer = () => Promise.resolve('complete')) {
  const got = [];
  const playEffect = (type, { duration, strongMagnitude }) => { got.push(strongMagnitude); assert.equal(duration, 100); return answer(); };
  return { pad: { vibrationActuator: { playEffect, reset: () => { got.push('still'); } } }, got };
}

test('Rumble is renewed before it ends, and stopped once', () => {
  const rumble = new Motor(RUMBLE);
  const { pad, got } = motors();
  const feeling = { newtons: 2.5, slip: 0, touches: true, onset: 1 };
  for (let now = 0; now <= 200; now += 10) rumble.play(pad, feeling, now);
  assert.deepEqual(got, [0.8, 0.8, 0.5, 0.5, 0.5]);
  for (let i = 0; i < 3; ++i) rumble.play(pad, null, 210);
  rumble.play(pad, { ...feeling, newtons: 0 }, 220);
  assert.deepEqual(got.slice(5), ['still'], 'and none where nothing is felt');
  rumble.play(pad, { ...feeling, onset: 2 }, 225);
  assert.equal(got.length, 7, 'a contact does not wait');
});

test('Motors that refuse, throw or are absent do no harm', async () => {
  const feeling = { newtons: 1, slip: 0, touches: true, onset: 1 };
  for (const answer of [() => Promise.reject(new Error('no')), () => { throw new Error('no'); }, () => undefined]) new Motor(RUMBLE).play(motors(answer).pad, feeling, 0);
  for (const pad of [null, {}, { vibrationActuator: null }, { vibrationActuator: {} }]) new Motor(RUMBLE).play(pad, feeling, 0);
  const other = motors();
  other.pad.vibrationActuator.effects = ['trigger-rumble'];
  new Motor(RUMBLE).play(other.pad, feeling, 0);
  assert.deepEqual(other.got, [], 'without this effect');
  new Motor(VIBRATION).play({ vibrate: () => { throw new Error('no'); } }, feeling, 0);
  await new Promise((done) => { setTimeout(done); });
});

test('A phone gets one pulse in each 100 ms, and none when it is released', () => {
  const got = [];
  const browser = { vibrate: (length) => { got.push(length); return true; } };
  const vibration = new Motor(VIBRATION);
  for (let now = 0; now < 300; now += 20) vibration.play(browser, { newtons: 1, touches: true, onset: 1 }, now);
  for (const now of [300, 320]) vibration.play(null, null, now);
  assert.deepEqual(got, [60, 20, 20, 0]);
});

function pictureAt(time, x, parts = {}) {
  const hand = { index: 0, slot: 7, flags: CONTACT, surface: [x, 0, 0.02 * time], normal: [0, 0, 1], position: [x, 0, 0], newtons: 1, ...parts.hand };
  return { time, hands: [hand, ...(parts.hands ?? [])], contacts: parts.contacts ?? [], bodies: parts.bodies ?? [], indexOf: () => -1 };
}

test('Slip is the speed along the surface, relative to what is touched', () => {
  const none = { solids: [] };
  near(slipSpeed(pictureAt(1, 0), pictureAt(1.1, 0.01), 0, none), 0.1);
  const other = (x) => ({ hands: [{ index: 1, slot: 9, position: [x, 0, 0] }], contacts: [{ feeling: 7, felt: 9, newtons: 1 }] });
  near(slipSpeed(pictureAt(1, 0, other(0)), pictureAt(1.1, 0.01, other(0.01)), 0, none), 0, 'two hands that move together');
  const cube = { solids: [{ shape: 'box', size: [1, 1, 1], body: 0 }] };
  const turned = (half) => ({ bodies: [{ position: [1, 0, 0], turn: [Math.cos(half), 0, 0, Math.sin(half)] }] });
  near(slipSpeed(pictureAt(1, 0.5, turned(0)), pictureAt(1.1, 0.5, { ...turned(0.05), hand: { surface: [1 - 0.5 * Math.cos(0.1), -0.5 * Math.sin(0.1), 0] } }), 0, cube), 0, 'a body that turns with the hand');
  near(slipSpeed(pictureAt(1, 0.5, turned(0)), pictureAt(1.1, 0.5, turned(0.05)), 0, cube) > 0.3, true);
  for (const [older, newer] of [[null, pictureAt(1, 1)], [pictureAt(1, 0), pictureAt(1, 1)], [pictureAt(1, 0), pictureAt(9, 1)],
    [pictureAt(1, 0, { hand: { flags: 0 } }), pictureAt(1.1, 1)]]) assert.equal(slipSpeed(older, newer, 0, none), 0);
});

test('Nothing is felt in a picture that stands, is old, or has no held hand', () => {
  const page = { hand: { held: true, index: 0 }, moment: { touch: { solids: [] } }, timeLine: { state: 'live' } };
  const feeling = new Feeling(page);
  const show = (picture, now) => { page.newer = { picture, came: now }; return feeling.at(now); };
  assert.equal(show(pictureAt(1, 0, { hand: { flags: 0 } }), 0).onset, 0);
  assert.deepEqual(show(pictureAt(1.1, 0), 100), { newtons: 1, touches: true, onset: 1, slip: 0 });
  const sliding = show(pictureAt(1.2, 0.02), 200);
  near(sliding.slip, 0.2);
  assert.equal(feeling.at(220), sliding, 'the same until the next picture');
  assert.equal(feeling.at(600), null, 'old');
  for (const change of [{ timeLine: { state: 'paused' } }, { hand: { held: false, index: 0 } }, { hand: { held: true, index: 3 } }]) {
    assert.equal(new Feeling({ ...page, ...change }).at(200), null, JSON.stringify(change));
  }
});

test('A contact that lasts through old pictures begins once', () => {
  const page = { hand: { held: true, index: 0 }, moment: { touch: { solids: [] } }, timeLine: { state: 'live' } };
  const [feeling, rumble, { pad, got }] = [new Feeling(page), new Motor(RUMBLE), motors()];
  const show = (picture, came, now) => {
    page.newer = { picture, came };
    rumble.play(pad, feeling.at(now), now);
  };
  show(pictureAt(1, 0), 0, 0);
  show(pictureAt(1, 0), 0, 900);
  show(pictureAt(2, 0), 1000, 1000);
  show(pictureAt(2, 0), 1000, 1900);
  page.hand.held = false;
  show(pictureAt(3, 0), 2000, 2000);
  page.hand.held = true;
  show(pictureAt(3.1, 0), 2100, 2100);
  assert.deepEqual(got, [0.8, 'still', 0.2, 'still', 0.8], 'and again for a hand that is taken anew');
});
