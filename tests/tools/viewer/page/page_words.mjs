// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the page says of a picture, and what it shows of a recording and of sizes:  node page_words.mjs tools/viewer/page
import assert from 'node:assert/strict';
import test from 'node:test';
import { picture } from './made_picture.mjs';
import { take } from './page_copy.mjs';

const { decodePicture, HAND_FLAGS } = await take('picture.js');
const { DRAWN } = await take('drawn_list.js');
const { PLOTS } = await take('plot_list.js');
const { Filled } = await take('filled.js');
const { Moment } = await take('moment.js');
const { drawsSomething } = await take('picture_key.js');
const { nearestSurface } = await take('nearest_surface.js');
const { plotEnergy } = await take('plot_energy.js');
const { sentence } = await take('sentence.js');
const { sizeOf } = await take('bodies.js');
const { TERMS } = await take('terms.js');
const { touchExtent } = await take('extents.js');
const { BufferGeometry, Float32BufferAttribute, Group, Mesh } = await take('libraries.js');

const cube = { name: 'cube number 1', shape: 'box', size: [0.04, 0.04, 0.04], position: [0, 0, 0.02], quaternion: [1, 0, 0, 0], body: 0 };
const floor = { name: 'floor', shape: 'box', size: [2, 2, 0.1], position: [0, 0, -0.05], quaternion: [1, 0, 0, 0] };

function momentOf(parts, touch = {}) {
  const moment = new Moment();
  const one = decodePicture(picture(parts));
  moment.touch = { ...moment.touch, ...touch };
  moment.set(one, one, 1);
  return moment;
}

test('A recording holds the last picture with somebody in it, what is live does not', () => {
  const filled = new Filled();
  const [empty, full] = [decodePicture(picture({})), decodePicture(picture({ entities: [{ slot: 1 }] }))];
  assert.equal(filled.take(empty, true), empty);
  assert.equal(filled.holds, false, 'nobody was there yet');
  assert.equal(filled.take(full, true), full);
  assert.equal(filled.take(empty, true), full);
  assert.equal(filled.holds, true);
  assert.equal(filled.take(empty, false), empty);
  assert.equal(filled.holds, false);
  assert.equal(filled.take(decodePicture(picture({ hands: [{ index: 0 }] })), true).hands.length, 1, 'a hand is somebody');
});

test('A sentence says what is seen', () => {
  const moment = momentOf({ entities: [{ slot: 1 }, { slot: 2 }], hands: [{ index: 0 }, { index: 1 }] }, { solids: [floor] });
  moment.hello = { kind: 'demo' };
  assert.match(sentence(moment, 'touch', null), /^Two hands, each in a program of its own, touch the solids here and each other over a simulated network\./);
  moment.hello = { kind: 'peer' };
  assert.match(sentence(moment, 'touch', null), /^Two hands of this program/);
  assert.match(sentence(moment, 'world', null), /^Two entities, as a receiver shows them/);
  assert.equal(sentence(moment, 'world', 3.04), 'Nobody sends at this instant; you see the moment at 0:03.0.');
  assert.match(sentence(momentOf({ entities: [{ slot: 1 }] }), 'touch', null), /^One object that can be felt, /);
  assert.equal(sentence(new Moment(), 'world', null), '');
});

test('The page shows owners only if several peers can own bodies', () => {
  const moment = momentOf({ hands: [{ index: 0, slot: 0 }, { index: 1, slot: 1 }] }, { solids: [{ ...floor, body: 0 }] });
  moment.hello = { kind: 'demo' };
  moment.owners = [{ owner: '1:2' }];
  moment.roster = new Map([[0, { peer: '1:1' }], [1, { peer: '1:1' }]]);
  assert.equal(moment.handOfPeer('1:2'), undefined, 'a peer without a hand here');
  assert.equal(moment.ownersDiffer, true);
  moment.roster.set(1, { peer: '1:2' });
  assert.equal(moment.handOfPeer('1:2').index, 1);
  assert.match(sentence(moment, 'touch', null), /A body has the colour of the hand whose program simulates it\.$/);
  moment.roster = new Map([[0, { peer: '1:2' }]]);
  assert.equal(moment.ownersDiffer, false, 'one peer owns all');
  moment.owners = [];
  moment.roster.set(1, { peer: '1:1' });
  assert.equal(moment.ownersDiffer, false, 'owners are fixed');
  assert.doesNotMatch(sentence(moment, 'touch', null), /colour/);
});

test('A sentence warns of a long delay between the hands of two peers', () => {
  const moment = momentOf({ hands: [{ index: 0, slot: 0 }, { index: 1, slot: 1 }] }, { solids: [{ ...floor, body: 0 }] });
  const warns = (peers, median) => {
    moment.roster = new Map(peers.map((peer, slot) => [slot, { peer }]));
    moment.numbers = { peers: { delay_ms: median && { median } } };
    return /above 50\u00a0ms/.test(sentence(moment, 'touch', null));
  };
  moment.hello = { kind: 'demo' };
  moment.owners = [{ owner: '1:2' }];
  assert.equal(warns(['1:1', '1:2'], 60), true);
  assert.equal(warns(['1:1', '1:2'], 53), false, '50 ms, rounded up');
  assert.equal(warns(['1:1', '1:2']), false, 'the delay is unknown');
  assert.equal(warns(['1:1', '1:1'], 60), false, 'both hands have one peer');
});

test('An entity is the body of its ID, whoever owns it', () => {
  const moment = new Moment();
  moment.owners = [{ owner: '1:1' }, { owner: '1:2' }];
  assert.equal(moment.ownerOf({ id: '65534:1:2' }).owner, '1:2');
  for (const id of ['65534:1:3', '65534:1:0', '1:1:2', '65534:12:1']) assert.equal(moment.ownerOf({ id }), undefined, id);
  assert.equal(moment.ownerOf(undefined), undefined);
  moment.reset();
  assert.equal(moment.ownerOf({ id: '65534:1:2' }), undefined);
});

test('Each mark and each plot has its words', () => {
  for (const { name } of DRAWN) assert.ok(TERMS[name]?.length > 20, name);
  for (const { name, good } of PLOTS) assert.ok(TERMS[name === 'delay' ? 'delay and loss' : name] && good.length < 62, name);
});

test('The legend has a mark only of what is drawn', () => {
  const group = new Group();
  assert.equal(drawsSomething(group), false);
  const mesh = new Mesh(new BufferGeometry());
  group.add(mesh);
  assert.equal(drawsSomething(group), false, 'without corners');
  mesh.geometry.setAttribute('position', new Float32BufferAttribute(new Float32Array(9), 3));
  assert.equal(drawsSomething(group), true);
  mesh.geometry.setDrawRange(0, 0);
  assert.equal(drawsSomething(group), false, 'of no face');
  mesh.geometry.setDrawRange(0, 3);
  mesh.visible = false;
  assert.equal(drawsSomething(group), false, 'hidden');
});

test('A body has the size of its solid, and what has no known size is small in a small scene', () => {
  const moment = momentOf({ entities: [{ slot: 1 }] }, { solids: [floor, cube] });
  const view = { extent: { radius: 0.5 } };
  const near = (x, y) => assert.ok(Math.abs(x - y) < 1e-6, `${x} is not ${y}`);
  near(sizeOf(moment, view, { marking: 'cube number' }), 0.02 * Math.sqrt(3));
  near(sizeOf(moment, view, { marking: 'cube number', radius: 0.3 }), 0.3);
  near(sizeOf(moment, view, { marking: 'floor' }), 0.02);
  near(sizeOf(moment, view, { marking: '' }), 0.02);
  near(sizeOf(moment, { extent: { radius: 5000 } }, undefined), 1);
});

test('What moves is fitted into the picture, not the floor below it', () => {
  const moment = momentOf({ hands: [{ index: 0, position: [0.1, 0, 0.1] }], bodies: [{ position: [0, 0, 0.02] }] }, { solids: [floor, cube] });
  assert.ok(touchExtent(moment).radius < 0.15);
  moment.touch.solids = [floor];
  assert.ok(touchExtent(moment).radius > 1);
});

test('The nearest surface is found on balls, boxes, spheres, planes and meshes', () => {
  const hand = { index: 0, slot: 9, position: [0, 0, 0.1] };
  const nearest = (solids, balls = [], bodies = []) => {
    const moment = momentOf({ bodies }, { solids });
    const { point, distance } = nearestSurface(moment, hand, balls) ?? {};
    return point && [...point, distance].map((x) => Number(x.toFixed(4)));
  };
  assert.equal(nearest([]), undefined);
  assert.deepEqual(nearest([floor]), [0, 0, 0, 0.09], 'the radius of a hand is 10 mm');
  assert.deepEqual(nearest([floor, cube], [], [{ position: [0, 0, 0.04] }]), [0, 0, 0.06, 0.03], 'a body is where it is now');
  const turned = { ...floor, shape: 'plane', position: [0.05, 0, 0], quaternion: [Math.SQRT1_2, 0, Math.SQRT1_2, 0] };
  assert.deepEqual(nearest([turned]), [0.05, 0, 0.1, 0.04], 'a wall');
  assert.deepEqual(nearest([{ ...cube, shape: 'sphere', radius: 0.02, position: [0, 0, 0], body: undefined }]), [0, 0, 0.02, 0.07]);
  assert.deepEqual(nearest([{ ...cube, shape: 'mesh', vertices: [0, 0, 1, 0, 0, 0.2], position: [0, 0, 0], body: undefined }]), [0, 0, 0.2, 0.09]);
  const ball = { slot: 3, position: [0.1, 0, 0.1], radius: 0.03 };
  assert.deepEqual(nearest([floor], [ball, { slot: 9, position: hand.position, radius: 0.01 }]), [0.07, 0, 0.1, 0.06], 'not the hand itself');
});

test('Energies of all twins are beside those of all their hands, and of each hand where there are none', () => {
  const { hands } = decodePicture(picture({ hands: [{ index: 0, flags: HAND_FLAGS.twin }, { index: 1, flags: HAND_FLAGS.twin }, { index: 2 }] }));
  const shown = (numbers) => Object.fromEntries(plotEnergy.lines.map(({ says, colour, at }) => [`${says} ${colour}`, at({ hands, numbers })]).filter(([, x]) => x !== null));
  const twins = shown({ twin: [{ hand: 0, energy: 1 }, { hand: 1, energy: -3 }] });
  assert.deepEqual(twins, { 'hands together hand-0': 12000, 'their loans hand-0': -14000, 'without the gate, together twin': -2000 });
  assert.deepEqual(shown({}), { 'energy hand-0': 6000, 'energy hand-1': 6000, 'loan hand-0': -7000, 'loan hand-1': -7000 });
});
