// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The page far from the scene's origin, by what its modules give to a graphics card:  node page_far.mjs tools/viewer/page
import assert from 'node:assert/strict';
import test from 'node:test';
import { picture } from './made_picture.mjs';
import { take } from './page_copy.mjs';

globalThis.matchMedia = () => ({ matches: true }); // reduced motion: the camera is where it should be at once
globalThis.document = {};
globalThis.getComputedStyle = () => ({ getPropertyValue: () => '#808080' });

const { Group } = await take('libraries.js');
const { decodePicture } = await take('picture.js');
const { DRAWN } = await take('drawn_list.js');
const { Moment } = await take('moment.js');
const { OrbitCamera } = await take('orbit_camera.js');

const AWAY = [-4461000, 2757000, -2740000]; // [m], 5,900 km
const ORIGIN = [0, 0, 0];
const MILLIMETRE = 0.001;

// The corners of a thing seen from the camera, in single precision as a card has them.
function onCard(group, camera) {
  group.updateMatrixWorld(true);
  const corners = [];
  group.traverse((part) => {
    if (!part.geometry?.attributes.position || !part.visible) return;
    const m = new Float32Array(camera.matrixWorldInverse.clone().multiply(part.matrixWorld).elements);
    const { array } = part.geometry.attributes.position;
    assert.ok(array instanceof Float32Array);
    const { born } = part.geometry.attributes; // of trails: pieces that are not written yet are not seen
    const end = Math.min(array.length / 3, part.geometry.drawRange.count);
    for (let v = 0; v < end; ++v) {
      if (born && born.array[v] < 0) continue;
      const [x, y, z] = array.subarray(3 * v, 3 * v + 3);
      const terms = (k) => [m[k] * x, m[4 + k] * y, m[8 + k] * z, m[12 + k]].map(Math.fround);
      corners.push([0, 1, 2].map((k) => terms(k).reduce((sum, term) => Math.fround(sum + term))));
    }
  });
  return corners;
}

// The world of two walkers at a place, with all that is drawn of it. The camera follows the first one.
class World {
  constructor(place) {
    this.place = place;
    this.moment = new Moment();
    this.orbit = new OrbitCamera(-1.1, 0.68);
    this.orbit.goal.distance = 20;
    this.view = { orbit: this.orbit, rectangle: { width: 800, height: 600 }, extent: { centre: place, radius: 20 }, scale: 2, pixels: () => 10 };
    this.words = [];
    const labels = { widthOf: () => 0, take: () => {}, put: (view, x, y, z, text) => this.words.push([text, x - place[0], y - place[1], z - place[2]]) };
    this.things = DRAWN.filter(({ name, view }) => (view === 'world' && name !== 'ground') || name === 'floor').map((row) => {
      const group = new Group();
      const thing = row.make(group, this.view, labels);
      thing.paint();
      return { name: row.name, group, thing };
    });
    const { moment } = this;
    moment.followed = 1;
    moment.groups = {
      groups: [{ tier: 'near', group: 0, slots: [1, 2] }, { tier: 'contact', group: 1, slots: [1, 2] }],
      beacons: [{ name: 'lift', x: place[0] + 3, y: place[1] - 5, heard: 1 }],
    };
  }

  // The world at a time, by the way of the first walker to the east [m]; `cells` round both, or a plain grid.
  draw(time, way, cells, target = null) {
    const [x, y, z] = this.place;
    const { moment } = this;
    const one = decodePicture(picture({ time, entities: [{ slot: 1, x: x + way, y, z: z + 0.3, error: 0.4 }, { slot: 2, x: x + 7.123, y: y + 4.567, z }] }));
    moment.set(one, one, 1);
    moment.contacts = [{ felt: 1, feeling: 2, point: [x + 7.123, y, z], force: [0, 0, 2], newtons: 2 }];
    moment.cells = cells ? { size: 10, shape: 'square', cells: [{ x: x + 5, y: y + 5, cell: 1, heard_by: [1] }] } : { size: 0, cells: [] };
    this.orbit.goal.target.fromArray(target ?? moment.shown);
    this.orbit.advance(1, 800, 600);
    this.words.length = 0;
    for (const { thing } of this.things) thing.update(moment);
    return new Map(this.things.map(({ name, group }) => [name, onCard(group, this.orbit.camera)]));
  }
}

function farthestApart(these, those) {
  assert.equal(these.length, those.length);
  return these.reduce((most, one, i) => Math.max(most, Math.hypot(...one.map((x, k) => x - those[i][k]))), 0);
}

test('Between two pictures a walker 5,900 km away moves by a millimetre', () => {
  const at = (time, way) => decodePicture(picture({ time, entities: [{ slot: 1, x: AWAY[0] + way, y: AWAY[1], z: AWAY[2] }] }));
  const moment = new Moment();
  const places = [0, 0.5, 1].map((share) => {
    moment.set(at(0, 0), at(1, MILLIMETRE), share);
    return moment.shown[0] - AWAY[0];
  });
  [0, 0.5, 1].forEach((share, i) => assert.ok(Math.abs(places[i] - share * MILLIMETRE) < 1e-8, `${places}`));
});

test('The body of a walker 5,900 km away moves by a millimetre on the card', () => {
  const world = new World(AWAY);
  world.draw(0, 0, true);
  const body = world.things.find(({ name }) => name === 'entities');
  const before = onCard(body.group, world.orbit.camera);
  const { moment, orbit } = world;
  moment.shown[0] += MILLIMETRE; // and the camera stands
  body.thing.update(moment);
  const moved = onCard(body.group, orbit.camera).slice(0, 12);
  assert.ok(moved.length === 12);
  moved.forEach((corner, i) => assert.ok(Math.abs(Math.hypot(...corner.map((x, k) => x - before[i][k])) - MILLIMETRE) < 0.02 * MILLIMETRE));
});

test('All that is drawn 5,900 km away is what is drawn at the origin, also after the anchor has moved', () => {
  for (const cells of [true, false]) {
    const [near, far] = [new World(ORIGIN), new World(AWAY)];
    for (const world of [near, far]) world.draw(-0.1, 0, cells, ORIGIN); // nobody is followed yet
    for (let step = 0; step <= 80; ++step) {
      const [here, there] = [near, far].map((world) => world.draw(0.1 * step, 12.345 * step, cells));
      for (const [name, corners] of here) {
        const apart = farthestApart(corners, there.get(name));
        assert.ok(apart < MILLIMETRE, `${name} at step ${step}: ${apart} m`);
      }
      assert.deepEqual(far.words.map(([text]) => text), near.words.map(([text]) => text));
      assert.ok(farthestApart(far.words.map(([, ...place]) => place), near.words.map(([, ...place]) => place)) < 1e-6);
    }
    for (const [name, { length }] of near.draw(9, 1000, cells)) assert.ok(length > 0, `${name} is drawn`);
    assert.ok(near.orbit.anchored >= 4 && far.orbit.anchored >= 4, `${near.orbit.anchored}, ${far.orbit.anchored}`);
  }
});

test('When the anchor moves the whole of a trail goes to the card, else its last piece', () => {
  const world = new World(AWAY);
  const trails = world.things.find(({ name }) => name === 'trails').thing;
  const sent = [0, 1, 250, 251].map((way, i) => {
    world.draw(0.1 * i, way, true);
    const { position } = trails.lines.geometry.attributes;
    return position.updateRanges.reduce((sum, { count }) => sum + count, 0) / position.array.length;
  });
  assert.deepEqual(sent.map((share) => share === 1), [true, false, true, false]);
  assert.ok(sent[1] < 0.1);
});

test('Somebody at an impossible place does not take the camera along', async () => {
  const { worldExtent } = await take('extents.js');
  const moment = new Moment();
  const one = decodePicture(picture({ entities: [{ slot: 1, x: 1e300, y: 1e300, z: 1e300 }, { slot: 2, x: AWAY[0], y: AWAY[1], z: AWAY[2] }] }));
  moment.set(one, one, 1);
  assert.deepEqual(worldExtent(moment).centre, AWAY);
});
