// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The large picture and the inset: two scenes on one canvas, each with its things of drawn_list.js.
import { Color, DirectionalLight, Group, HemisphereLight, Scene, Vector3, WebGLRenderer } from './libraries.js';
import { AutoCamera } from './auto_camera.js';
import { cssColour } from './colours.js';
import { DRAWN } from './drawn_list.js';
import { Labels } from './labels.js';
import { OrbitCamera } from './orbit_camera.js';
import { worldExtent, touchExtent } from './extents.js';
import { ScaleBar } from './scale_bar.js';

const MANY_MEASURED = 100; // entities

function drawnBySoftware() {
  const context = document.createElement('canvas').getContext('webgl2');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? context.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

class View {
  constructor(name, yaw, tilt, extent, software) {
    this.name = name;
    this.software = software; // rendering without a graphics card
    this.scene = new Scene();
    this.orbit = new OrbitCamera(yaw, tilt);
    this.extentOf = extent;
    this.extent = null;
    this.rectangle = { x: 0, y: 0, width: 1, height: 1 };
    this.peak = 1; // [N], recent maximum
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(-3, -5, 8);
    this.scene.add(sun, new HemisphereLight(0xffffff, 0xc4cad1, 2.3));
  }

  // The sphere that the camera should show; with many entities it is computed 4 times a second.
  measure(moment) {
    const { count, time } = moment;
    if (this.measured && count > MANY_MEASURED && count === this.measured.count && Math.abs(time - this.measured.time) < 0.25) return this.extent;
    this.measured = { count, time };
    return this.extentOf(moment);
  }

  // Length of an arrow for one newton [m]: the strongest recent force takes a third of the scene.
  get metresPerNewton() { return (0.3 * (this.extent?.radius ?? 1)) / this.scale; }

  // Whether the sphere to show differs too much from the sphere to which the camera was fitted.
  outgrown() {
    const { radius, centre } = this.fitted;
    const drift = Math.hypot(...centre.map((x, k) => x - this.extent.centre[k]));
    return this.extent.radius > 1.5 * radius || this.extent.radius < radius / 2.5 || drift > 0.5 * radius;
  }

  // Size of a length at a place [pixels].
  pixels(length, place) {
    const { camera } = this.orbit;
    const depth = Math.hypot(...place.map((x, k) => x - camera.position.getComponent(k)));
    return (length * this.rectangle.height) / (2 * depth * Math.tan((camera.fov * Math.PI) / 360));
  }

  weigh(newtons, seconds) {
    this.peak = Math.max(this.peak * Math.exp(-seconds / 20), newtons, 0.1);
    const wanted = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1e3, 1e4, 1e5].find((step) => step >= this.peak) ?? 1e6;
    if (!this.scale || wanted > this.scale || this.peak < this.scale / 3) this.scale = wanted;
  }
}

export class Stage {
  constructor(host, fine) {
    this.host = host;
    this.canvas = host.querySelector('canvas');
    this.inset = host.querySelector('#inset');
    const software = drawnBySoftware() && !fine;
    this.ratio = software ? 1 : Math.min(2, devicePixelRatio);
    // Opaque: with software GL, a transparent canvas over the page costs as much time as 1,500
    // triangles.
    const context = this.canvas.getContext('webgl2', { alpha: false, stencil: false, antialias: !software });
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context });
    this.renderer.autoClear = false;
    this.renderer.setPixelRatio(this.ratio);
    this.views = {
      world: new View('world', -1.1, 0.68, worldExtent, software), touch: new View('touch', -1.15, 0.36, touchExtent, software),
    };
    this.labels = new Labels(host.querySelector('#labels'));
    this.auto = new AutoCamera(this.views.world);
    this.scaleBar = new ScaleBar(host.querySelector('#scale'));
    this.large = 'world';
    this.hidden = new Set();
    this.things = DRAWN.map((row) => this.add(row));
    this.restless = true;
    this.folded = false; // the inset has nothing of its own to show
  }

  add(row) {
    const view = this.views[row.view];
    const group = new Group();
    view.scene.add(group);
    return { row, view, group, thing: row.make(group, view, this.labels) };
  }

  get small() { return this.large === 'world' ? 'touch' : 'world'; }
  view(name) { return this.views[name]; }
  swap() { this.show(this.small); }

  show(name) {
    this.large = name;
    this.host.dataset.large = name;
    this.inset.dataset.name = this.small;
    this.restless = true;
  }

  toggle(name) {
    if (!this.hidden.delete(name)) this.hidden.add(name);
    this.restless = true;
    return !this.hidden.has(name);
  }

  // Where the mouse is on the picture [pixels], or null.
  pointed(mouse) {
    this.labels.pointer = mouse;
    this.restless = true;
  }

  paint() {
    for (const view of Object.values(this.views)) view.scene.background = new Color(cssColour('sky'));
    for (const { thing } of this.things) thing.paint();
    this.restless = true;
  }

  fit(name) {
    const view = this.views[name];
    if (name === 'world' && this.exercise) this.auto.setOn(true);
    else if (view.extent) view.orbit.fit(view.extent.centre, view.extent.radius);
    this.restless = true;
  }

  // Draws if something has changed; false if nothing has.
  draw(moment, seconds, changed) {
    if (changed) this.take(moment, seconds);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return false;
    if (this.canvas.width !== Math.round(width * this.ratio) || this.canvas.height !== Math.round(height * this.ratio)) {
      this.renderer.setSize(width, height, false);
      this.restless = true;
    }
    this.lay(width, height);
    this.views.world.orbit.setFrame(moment.frameAt(this.views.world.orbit.now.target.toArray()));
    let moving = false;
    for (const view of Object.values(this.views)) {
      moving = view.orbit.advance(seconds, view.rectangle.width, view.rectangle.height) || moving;
    }
    if (!changed && !moving && !this.restless) return false;
    this.restless = false;
    this.labels.begin(this.covered());
    this.scaleBar.draw(this.views.world, this.exercise && this.large === 'world');
    for (const { row, view, group, thing } of this.things) {
      group.visible = !this.hidden.has(row.name) && (view.name === this.large || (!row.large && !this.inset.hidden && !this.folded));
      if (group.visible) thing.update(moment);
    }
    this.labels.end();
    this.renderer.setScissorTest(true);
    this.render(this.views[this.large]);
    if (!this.inset.hidden && !this.folded) this.render(this.views[this.small]);
    return true;
  }

  // Parts of the page that lie over the picture; they are measured some times a second.
  covered() {
    const now = performance.now();
    if (now - (this.measuredAt ?? -Infinity) < 200) return this.labels.fixed;
    this.measuredAt = now;
    const { left, top } = this.host.getBoundingClientRect();
    return [...this.host.querySelectorAll('[data-over]')].map((part) => part.getBoundingClientRect()).filter(({ width }) => width > 0)
      .map((box) => [box.left - left - 4, box.top - top - 4, box.right - left + 4, box.bottom - top + 4]);
  }

  take(moment, seconds) {
    if (this.exercise !== moment.exercise) this.host.classList.toggle('exercise', moment.exercise);
    this.exercise = moment.exercise;
    // A world of one cell, in which all is felt, shows no more than the touch view.
    this.folded = this.large === 'touch' && moment.cells.cells.length < 2 && moment.touchesAll;
    const strongest = (list) => list.reduce((most, { newtons }) => Math.max(most, newtons), 0);
    this.views.touch.weigh(Math.max(strongest(moment.hands), strongest(moment.contacts)), seconds);
    this.views.world.weigh(strongest(moment.contacts), seconds);
    for (const view of Object.values(this.views)) {
      const extent = view.measure(moment);
      if (!extent) continue;
      view.extent = extent;
      if (view.name === 'world' && this.exercise) this.auto.lead(moment, extent);
      else if (!view.fitted || (view.outgrown() && !view.orbit.touched)) {
        view.fitted = extent;
        view.orbit.fit(extent.centre, extent.radius);
      }
    }
    const followed = moment.picture.indexOf(moment.followed);
    if (followed >= 0 && !this.exercise) this.views.world.orbit.goal.target.fromArray(moment.shown, 3 * followed);
  }

  lay(width, height) {
    const inner = this.inset;
    inner.hidden = !this.views[this.small].extent;
    inner.classList.toggle('folded', this.folded);
    this.views[this.large].rectangle = { x: 0, y: 0, width, height };
    if (inner.hidden || this.folded) return;
    const box = { width: inner.clientWidth, height: inner.clientHeight };
    this.views[this.small].rectangle = {
      x: inner.offsetLeft + inner.clientLeft, y: height - inner.offsetTop - inner.clientTop - box.height, ...box,
    };
  }

  render(view) {
    const { x, y, width, height } = view.rectangle;
    this.renderer.setScissor(x, y, width, height);
    this.renderer.setViewport(x, y, width, height);
    this.renderer.clear();
    this.renderer.render(view.scene, view.orbit.camera);
  }

  placeOf(name, point) {
    const { orbit, rectangle } = this.views[name];
    const { x, y } = new Vector3().fromArray(point).project(orbit.camera);
    return [rectangle.x + ((x + 1) / 2) * rectangle.width, this.canvas.clientHeight - rectangle.y - ((y + 1) / 2) * rectangle.height];
  }

  // What an entity covers of the large picture: [left, top, right, bottom] in pixels, or null.
  boxOf(moment, slot) {
    const i = moment.picture?.indexOf(slot) ?? -1;
    if (i < 0) return null;
    const [x, y, z] = moment.shown.subarray(3 * i, 3 * i + 3);
    const radius = moment.radiusOf(moment.roster.get(slot)) ?? 0.01;
    const around = [-radius, radius].flatMap((by) => [[x + by, y, z], [x, y + by, z], [x, y, z + by]]);
    const corners = this.large === 'touch' ? around : this.things.find(({ row }) => row.name === 'entities').thing.bodies.cornersOf(i);
    if (!corners.length) return null;
    const places = corners.map((corner) => this.placeOf(this.large, corner));
    const [columns, rows] = [0, 1].map((k) => places.map((place) => place[k]));
    return [Math.min(...columns), Math.min(...rows), Math.max(...columns), Math.max(...rows)];
  }

  // The drawn slot nearest to a point of the large picture, within 14 pixels.
  pick(moment, x, y) {
    const { camera } = this.views.world.orbit;
    const { width, height } = this.views.world.rectangle;
    const place = new Vector3();
    let best = -1;
    let least = 14 * 14;
    for (let i = 0; i < moment.count; ++i) {
      place.fromArray(moment.shown, 3 * i).project(camera);
      if (place.z > 1) continue;
      const dx = ((place.x + 1) / 2) * width - x;
      const dy = ((1 - place.y) / 2) * height - y;
      if (dx * dx + dy * dy < least) {
        least = dx * dx + dy * dy;
        best = moment.picture.slot(i);
      }
    }
    return best;
  }
}
