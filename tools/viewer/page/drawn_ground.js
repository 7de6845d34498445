// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The ground of an exercise: lines of round latitude and longitude on the ellipsoid, at the height
// of the lowest entities, with their degrees at the edges of the picture.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments } from './libraries.js';
import { colour } from './colours.js';
import { degrees } from './geodesy.js';
import { roundUp } from './words.js';

const EDGE = 8; // lines to each side
const CLOSEST = 105; // [pixels] between two lines
const METRES_A_DEGREE = 111320;
const RAIL = 20; // [pixels] from the lower edge of the picture to a label
const HIGH_RAIL = 58; // the same above the buttons of a narrow picture
const NARROW = 700;
const SAMPLES = 100; // entities whose height counts

export const drawnGround = {
  name: 'ground', view: 'world', says: 'latitude and longitude', mark: 'cell-plain',
  make(group, view, labels) { return new Ground(group, view, labels); },
};

class Ground {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true }));
    this.lines.frustumCulled = false;
    group.add(this.lines);
    this.key = '';
  }

  paint() { this.key = ''; }

  update(moment) {
    const { target, distance } = this.view.orbit.now;
    const at = moment.exercise ? moment.geodeticOf(target.toArray()) : null;
    this.lines.visible = !!at;
    if (!at) return;
    const { width, height } = this.view.rectangle;
    const apart = Math.max(CLOSEST, Math.max(width, height) / EDGE) / this.view.pixels(1, target.toArray()); // [m]
    const step = { lat: roundUp(apart / METRES_A_DEGREE), lon: roundUp(apart / (METRES_A_DEGREE * Math.max(0.05, Math.cos((at.lat * Math.PI) / 180)))) };
    if (EDGE * step.lat > 45) return; // of the whole earth there is no ground
    const near = { lat: Math.round(at.lat / step.lat), lon: Math.round(at.lon / step.lon) };
    const level = this.level(moment, distance);
    const key = `${step.lat} ${step.lon} ${near.lat} ${near.lon} ${level} ${this.view.orbit.anchored} ${moment.hello.origin?.lat}`;
    if (key !== this.key) this.make(moment, step, near, level, key);
    if (width > 300) this.label(step, near);
  }

  // Height of the ground [m], slightly below the lowest twentieth of the entities; in steps.
  level(moment, distance) {
    const every = Math.ceil(moment.count / SAMPLES);
    const heights = Array.from({ length: Math.ceil(moment.count / every) }, (_, k) => moment.geodeticOf(moment.shown.subarray(3 * every * k, 3 * every * k + 3))?.height).filter(Number.isFinite).sort((a, b) => a - b);
    const fine = distance / 500;
    return Math.floor((heights[Math.floor(heights.length / 20)] ?? 0) / fine - 0.3) * fine;
  }

  make(moment, step, near, height, key) {
    this.key = key;
    const all = Array.from({ length: 2 * EDGE + 1 }, (_, i) => i - EDGE);
    this.nodes = all.map((a) => all.map((b) => moment.geodesy.placeOf({ lat: Math.min(90, Math.max(-90, (near.lat + a) * step.lat)), lon: (near.lon + b) * step.lon, height })));
    const { anchor } = this.view.orbit;
    const [line, sky] = [colour('grid'), colour('sky')];
    const at = [];
    const tint = [];
    const point = (a, b) => {
      const [x, y, z] = this.nodes[a + EDGE][b + EDGE];
      at.push(x - anchor.x, y - anchor.y, z - anchor.z);
      const faint = Math.min(1, Math.max(0, (Math.hypot(a, b) / EDGE - 0.5) / 0.5));
      tint.push(...['r', 'g', 'b'].map((part) => line[part] + (sky[part] - line[part]) * faint));
    };
    for (const a of all) {
      for (const b of all.slice(1)) {
        point(a, b - 1);
        point(a, b);
        point(b - 1, a);
        point(b, a);
      }
    }
    this.lines.position.copy(anchor);
    this.lines.geometry.setAttribute('position', new Float32BufferAttribute(at, 3));
    this.lines.geometry.setAttribute('color', new Float32BufferAttribute(tint, 3));
  }

  // Each line has its degrees where it leaves the picture: lines that run up and down at the lower
  // edge, the others at the left one.
  label(step, near) {
    const places = this.nodes.map((row) => row.map((node) => this.labels.placed(this.view, ...node)));
    const columns = places.map((_, k) => places.map((row) => row[k]));
    const digitsOf = (x) => Math.max(0, -Math.floor(Math.log10(x) + 1e-9));
    const edgeOf = (points) => {
      const [a, b] = [points[EDGE - 1], points[EDGE + 1]];
      return a && b && Math.abs(a[0] - b[0]) > Math.abs(a[1] - b[1]) ? this.left : this.bottom;
    };
    const edges = { lat: edgeOf(places[EDGE]), lon: edgeOf(columns[EDGE]) };
    for (let k = 2 - EDGE; k <= EDGE - 2; ++k) {
      const lon = (((near.lon + k) * step.lon + 540) % 360) - 180;
      this.put(columns[k + EDGE], degrees(lon, digitsOf(step.lon), 'EW'), edges.lon);
      this.put(places[k + EDGE], degrees((near.lat + k) * step.lat, digitsOf(step.lat), 'NS'), edges.lat);
    }
  }

  put(points, text, edge) {
    const width = this.labels.widthOf(text) * 0.92;
    for (let i = 1; i < points.length; ++i) {
      const [a, b] = [points[i - 1], points[i]];
      const at = a && b ? edge.call(this, a, b, width) : null;
      if (!at) continue;
      if (this.labels.claim(at[0] - 3, at[1], width + 6, 15)) this.labels.write(at[0] + width / 2, at[1], text, 'degrees');
      return;
    }
  }

  // Where a text stands if a piece crosses the lower edge.
  bottom([ax, ay], [bx, by], width) {
    const { width: wide, height } = this.view.rectangle;
    const rail = height - (wide < NARROW ? HIGH_RAIL : RAIL);
    if ((ay < rail) === (by < rail)) return null;
    const x = ax + ((bx - ax) * (rail - ay)) / (by - ay);
    return x > 0 && x < wide ? [x - width / 2, rail] : null;
  }

  left([ax, ay], [bx, by]) {
    const rail = 10;
    if ((ax < rail) === (bx < rail)) return null;
    const y = ay + ((by - ay) * (rail - ax)) / (bx - ax);
    return y > 0 && y < this.view.rectangle.height - RAIL ? [rail, y - 16] : null;
  }
}
