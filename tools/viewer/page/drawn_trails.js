// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The path of each entity in the last 10 s. Pieces are written once, in a ring; the shader fades
// them by age.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, LineSegments, ShaderMaterial } from './libraries.js';
import { colour, SIDE_COLOURS } from './colours.js';
import { NONE } from './picture.js';

const TRAIL_SECONDS = 10;
const FINE = 20; // pieces of a trail
const COARSE = 3; // of one entity among many
const MOST_LINES = 40000; // limit in all, approximately
const MOST_LINES_BY_SOFTWARE = 3000; // software rendering takes 6 us for each
const MANY_TRAILS = 400;
const MOST_TRAILS = 4096; // entities with a trail

export const drawnTrails = {
  name: 'trails', view: 'world', says: 'trail of 10 s', mark: 'line side-friendly',
  make(group, view) { return new Trails(group, view); },
};

class Trails {
  constructor(group, view) {
    this.view = view;
    this.material = new ShaderMaterial({
      transparent: true, depthWrite: false,
      uniforms: { now: { value: 0 }, strength: { value: 0.5 }, teams: { value: [] } },
      vertexShader: `
        attribute float born; attribute float team; uniform float now; uniform float strength; uniform vec3 teams[4]; varying vec4 tint;
        void main() {
          float age = (now - born) / ${TRAIL_SECONDS.toFixed(1)};
          tint = vec4(teams[int(team)], age < 0.0 || age > 1.0 ? 0.0 : strength * (1.0 - age));
          gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        }`,
      fragmentShader: `
        varying vec4 tint;
        void main() { gl_FragColor = tint; }`,
    });
    this.lines = new LineSegments(new BufferGeometry(), this.material);
    this.lines.frustumCulled = false;
    group.add(this.lines);
    this.key = '';
  }

  paint() { this.material.uniforms.teams.value = SIDE_COLOURS.map((name) => colour(name).convertLinearToSRGB()); }

  // One piece more than the trail needs: the last one follows the entity.
  room(count) {
    this.pieces = Math.min(FINE, Math.max(COARSE, Math.round((this.view.software ? MOST_LINES_BY_SOFTWARE : MOST_LINES) / Math.max(1, count))));
    const corners = 2 * count * (this.pieces + 1);
    this.places = new Float64Array(3 * corners);
    this.at = new Float32Array(3 * corners); // the same, relative to the anchor
    this.anchored = -1;
    this.born = new Float32Array(corners).fill(-1e9);
    this.team = new Float32Array(corners);
    this.lines.geometry.dispose();
    const { geometry } = this.lines;
    geometry.setAttribute('position', new BufferAttribute(this.at, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('born', new BufferAttribute(this.born, 1).setUsage(DynamicDrawUsage));
    geometry.setAttribute('team', new BufferAttribute(this.team, 1).setUsage(DynamicDrawUsage));
    this.old = new Float64Array(3 * count);
    this.piece = 0;
    this.next = -Infinity;
  }

  update(moment) {
    const { picture, time, shown } = moment;
    const count = Math.min(moment.count, MOST_TRAILS);
    const key = `${picture.epoch} ${count}`;
    // Restarts the trails after a step back in time, or if slots belong to other entities.
    if (key !== this.key || time < this.last - 0.2 || time > this.last + 2) {
      this.key = key;
      this.room(count);
      this.base = time;
      this.old.set(shown.subarray(0, 3 * count));
      this.since = 0;
    }
    const now = time - this.base; // small numbers, because floats of the shader have low precision
    if (now >= this.next) {
      this.piece = (this.piece + 1) % (this.pieces + 1);
      if (Number.isFinite(this.next)) this.old.set(shown.subarray(0, 3 * count));
      this.since = now;
      this.next = now + TRAIL_SECONDS / this.pieces;
    }
    this.lines.visible = count <= MANY_TRAILS || this.view.rectangle.width > 400; // with many entities a small picture is too full for trails
    this.write(moment, count, now);
    this.last = time;
    this.material.uniforms.now.value = now;
    this.material.uniforms.strength.value = moment.exercise && count < 100 ? 0.9 : moment.followed === NONE ? 0.5 : 0.2; // keeps highlighted cells visible
  }

  write({ picture, shown }, count, now) {
    const first = this.piece * count * 2;
    for (let i = 0; i < count; ++i) {
      const v = first + 2 * i;
      for (let k = 0; k < 3; ++k) {
        this.places[3 * v + k] = this.old[3 * i + k];
        this.places[3 * v + 3 + k] = shown[3 * i + k];
      }
      this.born[v] = this.since;
      this.born[v + 1] = now;
      this.team[v] = picture.side(i);
      this.team[v + 1] = picture.side(i);
    }
    const { anchored } = this.view.orbit;
    const [begin, number] = anchored === this.anchored ? [first, 2 * count] : [0, this.born.length];
    this.anchored = anchored;
    this.stand(begin, number);
    for (const name of ['position', 'born', 'team']) {
      const attribute = this.lines.geometry.attributes[name];
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(begin * attribute.itemSize, number * attribute.itemSize);
      attribute.needsUpdate = true;
    }
  }

  // Writes corners relative to the anchor; all of them if the anchor has moved.
  stand(begin, number) {
    const { anchor } = this.view.orbit;
    this.lines.position.copy(anchor);
    for (let v = 3 * begin; v < 3 * (begin + number); v += 3) {
      this.at[v] = this.places[v] - anchor.x;
      this.at[v + 1] = this.places[v + 1] - anchor.y;
      this.at[v + 2] = this.places[v + 2] - anchor.z;
    }
  }
}
