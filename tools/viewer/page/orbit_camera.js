// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A camera that rotates around a point, above its own east, north and up, and fits itself to a
// sphere. Corners are stored
// relative to its anchor, because a graphics card has single precision. Places of meshes and
// cameras are multiplied in double precision before they are sent to it.
import { PerspectiveCamera, Vector3 } from './libraries.js';
import { LEVEL } from './geodesy.js';

const FIELD = 36; // degrees, of the shorter side
const REACH = 10; // of the anchor, in distances of the camera: the error of a corner is then a hundredth of a pixel
const calm = matchMedia('(prefers-reduced-motion: reduce)');

export class OrbitCamera {
  constructor(yaw, tilt) {
    this.camera = new PerspectiveCamera(FIELD, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.goal = { yaw, tilt, distance: 10, target: new Vector3() };
    this.now = { yaw, tilt, distance: 10, target: new Vector3() };
    this.anchor = new Vector3();
    this.anchored = 0; // number of its movements
    this.touched = false;
    this.panned = false;
    this.zoomed = false;
    this.setFrame(LEVEL);
  }

  // East, north and up at the target; a camera at a yaw of -90 degrees looks north.
  setFrame(axes) { this.axes = axes.map((axis) => new Vector3(...axis)); }

  // Moves with a target that moves.
  shift(by) {
    this.now.target.add(by);
    this.goal.target.add(by);
  }

  // Fits the camera to a sphere.
  fit(centre, radius) {
    this.goal.target.fromArray(centre);
    this.goal.distance = (1.12 * radius) / Math.sin((FIELD / 2) * (Math.PI / 180));
    this.touched = false;
    this.panned = false;
    this.zoomed = false;
    if (!this.fitted || calm.matches) this.jump();
    this.fitted = true;
  }

  jump() {
    Object.assign(this.now, { yaw: this.goal.yaw, tilt: this.goal.tilt, distance: this.goal.distance });
    this.now.target.copy(this.goal.target);
  }

  turn(dx, dy) {
    this.goal.yaw -= dx * 0.006;
    this.goal.tilt = Math.min(1.52, Math.max(-0.2, this.goal.tilt + dy * 0.005));
    this.touched = true;
  }

  zoom(factor) {
    this.goal.distance = Math.min(1e8, Math.max(0.01, this.goal.distance * factor));
    this.touched = true;
    this.zoomed = true;
  }

  pan(dx, dy) {
    const step = this.now.distance * 0.0012;
    const right = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    this.goal.target.addScaledVector(right, -dx * step).addScaledVector(up, dy * step);
    this.touched = true;
    this.panned = true;
  }

  // Moves towards its goal; true while it moves.
  advance(seconds, width, height) {
    const { now, goal, camera } = this;
    const share = calm.matches ? 1 : 1 - Math.exp(-seconds / 0.09);
    let rest = now.target.distanceTo(goal.target) / now.distance;
    now.target.lerp(goal.target, share);
    for (const key of ['yaw', 'tilt']) {
      rest += Math.abs(goal[key] - now[key]);
      now[key] += (goal[key] - now[key]) * share;
    }
    rest += Math.abs(goal.distance / now.distance - 1);
    now.distance *= (goal.distance / now.distance) ** share;
    this.keepAnchor();
    const flat = Math.cos(now.tilt) * now.distance;
    const [east, north, up] = this.axes;
    camera.position.copy(now.target).addScaledVector(east, flat * Math.cos(now.yaw)).addScaledVector(north, flat * Math.sin(now.yaw))
      .addScaledVector(up, Math.sin(now.tilt) * now.distance);
    camera.up.copy(up);
    camera.lookAt(now.target);
    camera.aspect = width / height;
    // FIELD is the angle of the shorter side.
    const half = Math.tan((FIELD / 2) * (Math.PI / 180)) * Math.max(1, height / width);
    camera.fov = (2 * Math.atan(half) * 180) / Math.PI;
    camera.near = now.distance / 100;
    camera.far = now.distance * 30;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return rest > 1e-3;
  }

  keepAnchor() {
    if (this.anchor.distanceTo(this.now.target) <= REACH * this.now.distance) return;
    this.anchor.copy(this.now.target);
    ++this.anchored;
  }
}
