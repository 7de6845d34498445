// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rigid and stiff objects: meshes, spheres, boxes and walls of the scene, and its bodies at their
// positions.
import { DoubleSide, Mesh, MeshLambertMaterial } from './libraries.js';
import { colour } from './colours.js';
import { solidReach, solidShape } from './solid_shapes.js';
import { foreign } from './words.js';

const MOST_NAMED = 3; // of more, the name of the one under the pointer is shown

export const drawnSolids = {
  name: 'solids', view: 'touch', says: 'solid of the scene', mark: 'body stone',
  make(group, view, labels) { return new Solids(group, view, labels); },
};

class Solids {
  constructor(group, view, labels) {
    Object.assign(this, { group, view, labels });
    this.meshes = [];
    this.moving = [];
    this.number = -1;
  }

  paint() {
    for (const { material } of this.meshes) material.color = colour('stone');
    for (const { mesh } of this.moving) mesh.material.color = colour('moving');
  }

  update(moment) {
    if (moment.touchNumber !== this.number) this.rebuild(moment);
    for (const { mesh, body } of this.moving) this.move(mesh, moment.bodies[body]);
    const { solids } = moment.touch;
    if (this.view.rectangle.width <= 400 || solids.length < 2) return;
    const places = solids.map(({ position, body }) => moment.bodies[body]?.position ?? position);
    const pointed = solids.length > MOST_NAMED ? this.labels.pointed(this.view, places) : null;
    solids.forEach(({ name }, i) => {
      if (pointed === null || pointed === i) this.labels.put(this.view, ...places[i], foreign(name ?? '', 31), 'solid', 8);
    });
  }

  rebuild(moment) {
    this.number = moment.touchNumber;
    for (const mesh of this.meshes) {
      mesh.geometry.dispose();
      mesh.removeFromParent();
    }
    this.moving = [];
    this.meshes = moment.touch.solids.flatMap((solid) => this.mesh(solid));
    this.paint();
  }

  move(mesh, body) {
    if (!body) return;
    const [w, x, y, z] = body.turn;
    mesh.position.fromArray(body.position);
    mesh.quaternion.set(x, y, z, w).normalize();
  }

  mesh(solid) {
    const shape = solidShape(solid);
    if (!shape) return [];
    solid.reach ??= solidReach(solid, shape);
    const material = new MeshLambertMaterial({ side: solid.shape === 'plane' ? DoubleSide : 0, vertexColors: !!shape.attributes.color });
    const mesh = new Mesh(shape, material);
    mesh.position.fromArray(solid.position);
    const [w, x, y, z] = solid.quaternion;
    mesh.quaternion.set(x, y, z, w).normalize();
    this.group.add(mesh);
    if (solid.body !== undefined) this.moving.push({ mesh, body: solid.body });
    return [mesh];
  }
}
