// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
import { nominalRadius } from './bodies.js';
import { reachOf } from './solid_shapes.js';

// The sphere that a camera should show: of the world, and of the touched objects.

const FARTHEST = 1e9; // [m] from the origin; more distant entities are ignored
const LEAST_AROUND = 25; // [m] around an entity of an exercise
const SIZES = 11; // or so many times its own size
const AHEAD = 4; // [s], or its way in this time

// All entities except the outermost fiftieth, so that one distant entity does not reduce all others
// to dots; at least a cell.
export function worldExtent(moment) {
  if (!moment.count) return null;
  const columns = [0, 1, 2].map((k) => {
    const step = Math.max(1, Math.floor(moment.count / 400));
    const list = [];
    for (let i = 0; i < moment.count; i += step) if (Math.abs(moment.shown[3 * i + k]) < FARTHEST) list.push(moment.shown[3 * i + k]);
    return list.sort((a, b) => a - b);
  });
  if (!columns[0].length) return null;
  const cut = (list, share) => list[Math.round((list.length - 1) * share)];
  const share = columns[0].length > 50 ? 0.02 : 0;
  const low = columns.map((list) => cut(list, share));
  const high = columns.map((list) => cut(list, 1 - share));
  const centre = low.map((x, k) => (x + high[k]) / 2);
  const spread = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2;
  if (moment.exercise) return { centre, radius: Math.max(cut(distances(moment, centre), 1 - share), surroundings(moment), 0.55 * moment.cells.size) };
  return { centre, radius: Math.max(0.78 * spread, 0.55 * moment.cells.size, 0.05) };
}

// Of all entities from a place [m], ascending.
function distances({ count, shown }, [x, y, z]) {
  return Array.from({ length: count }, (_, i) => Math.hypot(shown[3 * i] - x, shown[3 * i + 1] - y, shown[3 * i + 2] - z)).filter((far) => far < FARTHEST).sort((a, b) => a - b);
}

// What is seen around the entities of an exercise [m].
function surroundings({ count, picture, roster }) {
  let radius = LEAST_AROUND;
  for (let i = 0; i < count; ++i) {
    radius = Math.max(radius, SIZES * nominalRadius(roster.get(picture.slot(i))), AHEAD * Math.min(picture.speed(i), 1e4));
  }
  return radius;
}

// Height of the grid below the touched objects.
export function floorHeight({ centre, radius }) { return centre[2] - 0.62 * radius; }

// Bodies that move, with the hands; without them solids of finite size, else hands; at least 10
// times the size of a hand.
export function touchExtent(moment) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const add = (point, radius) => {
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k], point[k] - radius);
      high[k] = Math.max(high[k], point[k] + radius);
    }
  };
  const { solids } = moment.touch;
  for (const solid of solids) if (solid.body !== undefined) add(moment.bodies[solid.body]?.position ?? solid.position, reachOf(solid) ?? 0.1);
  if (Number.isFinite(low[0])) for (const { position, index } of moment.hands) add(position, 2 * moment.handRadius(index));
  else for (const solid of solids) if (solid.shape !== 'plane') add(solid.position, reachOf(solid) ?? 0.1);
  for (const region of moment.touch.regions) if (region.shape !== 'plane') add(region.position, 0);
  if (!Number.isFinite(low[0])) {
    for (const { position, index } of moment.hands) add(position, 5 * moment.handRadius(index));
  }
  if (!Number.isFinite(low[0])) {
    for (let i = 0; i < moment.count; ++i) {
      const row = moment.roster.get(moment.picture.slot(i));
      if (row?.haptic) add(moment.shown.subarray(3 * i, 3 * i + 3), 5 * (row.radius || 0.01));
    }
  }
  if (!Number.isFinite(low[0])) return null;
  const centre = low.map((x, k) => (x + high[k]) / 2);
  return { centre, radius: 0.66 * Math.max(...high.map((x, k) => x - low[k])) };
}
