// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Regions in which a hand feels a force without touching anything: transparent, each with its name.
import { Mesh, MeshBasicMaterial } from './libraries.js';
import { colour } from './colours.js';
import { solidReach, solidShape } from './solid_shapes.js';
import { foreign } from './words.js';

export const drawnRegions = {
  name: 'regions', view: 'touch', says: 'region of the scene', mark: 'body region',
  make(group, view, labels) { return new Regions(group, view, labels); },
};

class Regions {
  constructor(group, view, labels) {
    Object.assign(this, { group, view, labels });
    this.material = new MeshBasicMaterial({ transparent: true, opacity: 0.12, depthWrite: false });
    this.meshes = [];
    this.number = -1;
  }

  paint() { this.material.color = colour('near'); }

  update(moment) {
    if (moment.touchNumber !== this.number) this.rebuild(moment);
    if (this.view.rectangle.width <= 400) return;
    for (const { region, top } of this.meshes) this.labels.put(this.view, region.position[0], region.position[1], top, foreign(region.name, 31), 'region', 4);
  }

  rebuild(moment) {
    this.number = moment.touchNumber;
    for (const { mesh } of this.meshes) {
      mesh.geometry.dispose();
      mesh.removeFromParent();
    }
    this.meshes = moment.touch.regions.flatMap((region) => {
      const shape = solidShape(region);
      if (!shape) return [];
      const mesh = new Mesh(shape, this.material);
      mesh.position.fromArray(region.position);
      const [w, x, y, z] = region.quaternion;
      mesh.quaternion.set(x, y, z, w).normalize();
      this.group.add(mesh);
      const half = region.shape === 'box' ? 0.5 * region.size[2] : solidReach(region, shape);
      return [{ region, mesh, top: region.position[2] + half }];
    });
  }
}
