// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Places on the earth, the ground and the camera of an exercise:  node page_ground.mjs tools/viewer/page
import assert from 'node:assert/strict';
import test from 'node:test';
import { picture } from './made_picture.mjs';
import { take } from './page_copy.mjs';

globalThis.matchMedia = () => ({ matches: true }); // reduced motion: the camera is where it should be at once
globalThis.document = {};
globalThis.getComputedStyle = () => ({ getPropertyValue: () => '#808080' });

const { Group } = await take('libraries.js');
const { AutoCamera } = await take('auto_camera.js');
const { decodePicture } = await take('picture.js');
const { degrees, Geodesy, headingOf } = await take('geodesy.js');
const { drawnGround } = await take('drawn_ground.js');
const { leastScale, shapeOf, sizeOf } = await take('bodies.js');
const { Moment } = await take('moment.js');
const { OrbitCamera } = await take('orbit_camera.js');
const { worldExtent } = await take('extents.js');

const near = (a, b, most) => assert.ok(Math.abs(a - b) <= most, `${a} is not ${b}`);
const ORIGIN_OF_TEST = { lat: 47.05, lon: 8.31, height: 430 };

// The world of vehicles at places, with a camera of 800 x 600.
class Exercise {
  constructor() {
    this.moment = new Moment();
    this.moment.setOrigin(ORIGIN_OF_TEST);
    this.orbit = new OrbitCamera(-1.1, 0.68);
    this.view = { orbit: this.orbit, rectangle: { x: 0, y: 0, width: 800, height: 600 }, few: 12,
      pixels: (length, place) => (300 * length) / (Math.hypot(...place.map((x, k) => x - this.orbit.camera.position.getComponent(k))) * Math.tan((this.orbit.camera.fov * Math.PI) / 360)) };
    this.auto = new AutoCamera(this.view);
  }

  at(time, ...places) {
    const one = decodePicture(picture({ time, entities: places.map(([x, y, z], i) => ({ slot: i + 1, x, y, z, speed: 10 })) }));
    this.moment.roster = new Map(places.map((_, i) => [i + 1, { slot: i + 1, kind: 'platform land' }]));
    this.moment.judge();
    this.moment.set(one, one, 1);
    this.view.extent = worldExtent(this.moment);
    this.auto.lead(this.moment, this.view.extent);
    this.orbit.setFrame(this.moment.frameAt(this.orbit.goal.target.toArray()));
    this.orbit.advance(1, 800, 600);
    return this.orbit.goal.target.toArray();
  }
}

test('A place on the earth is that of the EPSG example of method 9602, and comes back', () => {
  const world = new Geodesy({ lat: 0, lon: 0, height: 0 });
  const place = { lat: 53 + 48 / 60 + 33.82 / 3600, lon: 2 + 7 / 60 + 46.38 / 3600, height: 73 };
  const [east, north, up] = world.placeOf(place);
  [[east, 140253.342], [north, 5124304.349], [up + 6378137, 3771793.968]].forEach(([is, should]) => near(is, should, 6e-4));
  const back = world.geodeticOf([east, north, up]);
  ['lat', 'lon', 'height'].forEach((part) => near(back[part], place[part], 1e-6));
  assert.equal(world.geodeticOf([0, 0, -6378137]), null, 'the centre of the earth');
  assert.deepEqual([degrees(-3.25, 2, 'NS'), degrees(8.3, 1, 'EW')], ['3.25° S', '8.3° E']);
});

test('A heading is from north by east, at the place of the entity', () => {
  const level = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  near(headingOf([1, 0, 0, 0], level), 90, 1e-9);
  near(headingOf([Math.SQRT1_2, 0, 0, -Math.SQRT1_2], level), 180, 1e-9);
  const world = new Geodesy({ lat: 0, lon: 0, height: 0 });
  const frame = world.frameAt(world.placeOf({ lat: 0, lon: 90, height: 0 }));
  [[0, 0, -1], [0, 1, 0], [1, 0, 0]].forEach((axis, i) => axis.forEach((x, k) => near(frame[i][k], x, 1e-12)));
});

test('The camera stays on a vehicle, leaps with the time, and leaves off where it is moved', () => {
  const exercise = new Exercise();
  const { orbit, auto } = exercise;
  assert.deepEqual(exercise.at(0, [5, 0, 0]), [5, 0, 0]);
  near(orbit.goal.yaw, -Math.PI / 2, 1e-12);
  const { distance } = orbit.goal;
  assert.deepEqual(exercise.at(1, [15, 3, 0]), [15, 3, 0]);
  assert.deepEqual(exercise.at(60, [900, 0, 0]), [900, 0, 0]);
  assert.equal(orbit.goal.distance, distance);
  orbit.turn(100, 0);
  orbit.zoom(0.5);
  assert.deepEqual(exercise.at(61, [910, 0, 0]), [910, 0, 0], 'turned and nearer, it follows on');
  near(orbit.goal.distance, distance / 2, 1e-9);
  orbit.pan(10, 0);
  const moved = exercise.at(62, [920, 0, 0]);
  assert.deepEqual(exercise.at(63, [990, 0, 0]), moved);
  assert.equal(auto.on, false);
  auto.setOn(true);
  assert.deepEqual(exercise.at(64, [1000, 0, 0]), [1000, 0, 0]);
  near(orbit.goal.distance, distance, 1e-9);
});

test('All vehicles are in the picture, as large as can be seen', () => {
  const exercise = new Exercise();
  for (const apart of [3, 300, 30000]) {
    const places = [[0, 0, 0], [apart, 0, 0], [0, -apart, 0], [0.6 * apart, 0.6 * apart, 0]];
    exercise.at(apart, ...places);
    const scale = leastScale(exercise.view);
    for (const place of places) {
      const at = exercise.orbit.camera.position.clone().set(...place).project(exercise.orbit.camera);
      assert.ok(Math.max(Math.abs(at.x), Math.abs(at.y)) < 0.95, `${apart} m apart: ${at.x}, ${at.y}`);
      assert.ok(2 * exercise.view.pixels(scale(...place, sizeOf(exercise.moment, exercise.view, exercise.moment.roster.get(1))), place) > 14);
    }
  }
  const kinds = ['platform land', 'platform air', 'platform surface', 'platform subsurface', 'life form', 'munition', 'supply'];
  assert.equal(new Set(kinds.map((kind) => shapeOf(kind, false, true))).size, 7, 'each has its own shape');
});

test('Lines of the ground are at round degrees on the ellipsoid, also 50 km from the origin', () => {
  const exercise = new Exercise();
  const { moment, view } = exercise;
  const place = moment.geodesy.placeOf({ lat: 47.5, lon: 8.31234, height: 200 });
  exercise.at(0, place);
  const [group, words] = [new Group(), []];
  const ground = drawnGround.make(group, view, { placed: (_, x, y) => [100 + 2 * (x - place[0]), 300 - 2 * (y - place[1])], widthOf: () => 60, claim: () => true, write: (x, y, text) => words.push(text) });
  ground.paint();
  ground.update(moment);
  const { array } = group.children[0].geometry.attributes.position;
  for (let v = 0; v < array.length; v += 60) {
    const { lat, lon, height } = moment.geodeticOf(group.children[0].position.toArray().map((x, k) => x + array[v + k]));
    [lat / 0.0002, lon / 0.0005].forEach((x) => near(x, Math.round(x), 2e-3));
    near(height, 200, 1);
  }
  assert.ok(words.includes('47.5000° N') && words.some((text) => /^8\.31\d\d° E$/.test(text)), `${words}`);
});
