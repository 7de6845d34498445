// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The world at the drawn instant: interpolated between the last two pictures, with the names and
// shapes from text messages.
import { Geodesy, LEVEL } from './geodesy.js';
import { NONE } from './picture.js';
import { reachOf } from './solid_shapes.js';

const MARKING = 11; // letters of a marking
const BODY_ID = '65534:1:'; // of body k, which ends in k + 1

export class Moment {
  constructor() {
    this.count = 0;
    this.shown = new Float64Array(0); // 3 each
    this.predicted = new Float64Array(0);
    this.turns = new Float32Array(0); // 4 each: w x y z, body to east-north-up
    this.hands = [];
    this.contacts = [];
    this.followed = NONE;
    this.reset();
  }

  reset() {
    this.roster = new Map();
    this.rosterNumber = (this.rosterNumber ?? 0) + 1;
    this.cells = { size: 0, cells: [] };
    this.cellsNumber = (this.cellsNumber ?? 0) + 1;
    this.groups = { groups: [], beacons: [] };
    this.touch = { solids: [], regions: [], hands: [] };
    this.touchNumber = (this.touchNumber ?? 0) + 1;
    this.numbers = {};
    this.isExercise = false;
    this.bodies = [];
    this.owners = [];
    this.hello = {};
    this.geodesy = null;
    this.judge();
  }

  // Interpolates with share s from picture a to picture b.
  set(a, b, s) {
    const count = b.entities;
    if (this.shown.length < 3 * count) {
      const room = Math.ceil(1.2 * count);
      this.shown = new Float64Array(3 * room);
      this.predicted = new Float64Array(3 * room);
      this.turns = new Float32Array(4 * room);
    }
    this.picture = b;
    this.count = count;
    this.time = a.time + (b.time - a.time) * s;
    for (let i = 0; i < count; ++i) this.place(i, a, b, s);
    this.hands = b.hands.map((hand) => between(a.hands.find((old) => old.index === hand.index), hand, s));
    this.contacts = b.contacts;
    this.bodies = b.bodies.map((body, i) => bodyBetween(a.bodies[i], body, s));
  }

  place(i, a, b, s) {
    const same = a === b || (i < a.entities && a.slot(i) === b.slot(i));
    const old = same ? i : a.indexOf(b.slot(i));
    const from = old < 0 ? b : a;
    const p = b.placeAt(i);
    const q = old < 0 ? p : a.placeAt(old);
    const e = b.errorAt(i);
    const f = old < 0 ? e : a.errorAt(old);
    for (let k = 0; k < 3; ++k) {
      const x = from.doubles[q + k] + (b.doubles[p + k] - from.doubles[q + k]) * s;
      const error = from.floats[f + k] + (b.floats[e + k] - from.floats[f + k]) * s;
      this.predicted[3 * i + k] = x;
      this.shown[3 * i + k] = x + error;
    }
    const t = b.turnAt(i);
    const u = old < 0 ? t : a.turnAt(old);
    let dot = 0;
    for (let k = 0; k < 4; ++k) dot += from.shorts[u + k] * b.shorts[t + k];
    const first = dot < 0 ? s - 1 : 1 - s;
    let length = 0;
    for (let k = 0; k < 4; ++k) {
      const x = first * from.shorts[u + k] + s * b.shorts[t + k];
      this.turns[4 * i + k] = x;
      length += x * x;
    }
    const scale = length > 0 ? 1 / Math.sqrt(length) : 0;
    for (let k = 0; k < 4; ++k) this.turns[4 * i + k] *= scale;
  }

  // Whether there is something to feel, rather than vehicles and people alone.
  get felt() {
    const { roster, touch: { solids, hands } } = this;
    return solids.length > 0 || hands.length > 1 || (roster.size > 0 && [...roster.values()].every(({ haptic }) => haptic));
  }

  // Whether the place of each entity on the earth matters.
  get exercise() { return this.isExercise; }

  // Called when the roster or what can be felt has changed.
  judge() { this.isExercise = this.roster.size > 0 && !this.felt && !this.touch.hands.length; }

  // Of a place in a picture; null without an origin.
  geodeticOf(place) { return this.geodesy?.geodeticOf(place) ?? null; }
  frameAt(place) { return this.geodesy?.frameAt(place) ?? LEVEL; }

  setOrigin(origin) { this.geodesy = origin ? new Geodesy(origin) : null; }

  // Whether the touch view shows every entity.
  get touchesAll() { return [...this.roster.values()].every((row) => row.haptic || this.bodyOf(row)); }

  // The body of the scene that an entity is, by its name.
  bodyOf({ marking }) { return this.touch.solids.find(({ name, body }) => body !== undefined && marking && name?.slice(0, MARKING) === marking); }

  // The owner of the body of the scene that an entity is, by its ID; else undefined.
  ownerOf(row) { return row?.id?.startsWith(BODY_ID) ? this.owners[Number(row.id.slice(BODY_ID.length)) - 1] : undefined; }

  // The first hand of this program that belongs to a peer.
  handOfPeer(peer) { return this.hands.find(({ slot }) => this.roster.get(slot)?.peer === peer); }

  // The peers of this program's hands.
  get handPeers() { return new Set(this.hands.map(({ slot }) => this.roster.get(slot)?.peer).filter(Boolean)); }

  // Whether more than one peer owns bodies, or could.
  get ownersDiffer() {
    const owners = this.owners.map(({ owner }) => owner).filter(Boolean);
    return this.owners.length > 0 && new Set([...owners, ...this.handPeers]).size > 1;
  }

  // Radius of an entity [m]: of its force model, or of the body of the scene that it is; else null.
  radiusOf(row) {
    const body = row && this.bodyOf(row);
    return row?.radius || (body ? reachOf(body) : null);
  }

  name(slot) {
    const row = this.roster.get(slot);
    return row?.marking || row?.id || `slot ${slot}`;
  }

  // Numbers of the cells that a slot receives, as a set.
  heardBy(slot) {
    return new Set(this.cells.cells.filter((cell) => cell.heard_by.includes(slot)).map((cell) => cell.cell));
  }

  handRow(index) { return this.touch.hands.find((row) => row.index === index); }
  handName(index) { return this.handRow(index)?.name || `hand ${index + 1}`; }
  handRadius(index) { return this.handRow(index)?.radius || 0.01; }
}

const mix = (a, b, s) => a.map((x, k) => x + (b[k] - x) * s);

function between(old, hand, s) {
  if (!old || s >= 1) return hand;
  const force = mix(old.force, hand.force, s);
  return {
    ...hand, force, newtons: Math.hypot(...force), position: mix(old.position, hand.position, s),
    surface: mix(old.surface, hand.surface, s), tool: toolBetween(old.tool, hand.tool, s),
  };
}

function bodyBetween(old, body, s) {
  if (!old) return body;
  const same = old.turn.reduce((sum, x, k) => sum + x * body.turn[k], 0) < 0 ? -1 : 1;
  return { position: mix(old.position, body.position, s), turn: mix(old.turn.map((x) => same * x), body.turn, s) };
}

function toolBetween(old, tool, s) {
  if (!old || !tool || old.probes.length !== tool.probes.length) return tool;
  return { ...tool, handle: mix(old.handle, tool.handle, s), probes: tool.probes.map((probe, i) => mix(old.probes[i], probe, s)) };
}
