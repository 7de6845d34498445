// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The patch of a mesh that a hand touches, in the colour of that hand, with its name.
import { BufferAttribute, BufferGeometry, Mesh, MeshBasicMaterial } from './libraries.js';
import { Pool } from './arrow.js';
import { colour, handColour } from './colours.js';
import { solidShape } from './solid_shapes.js';
import { foreign } from './words.js';

export const drawnPatches = {
  name: 'patches', view: 'touch', says: 'patch that a hand touches', mark: 'patch hand-0',
  make(group, view, labels) { return new Patches(group, view, labels); },
};

class Patches {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.number = -1;
    this.shapes = new Map(); // by number of the surface
    this.marks = new Pool(() => {
      const material = new MeshBasicMaterial({
        transparent: true, opacity: 0.36, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1,
      });
      const mark = new Mesh(new BufferGeometry(), material);
      mark.hide = () => { mark.visible = false; };
      group.add(mark);
      return mark;
    });
  }

  paint() { this.colours = [0, 1, 2, 3].map((index) => colour(handColour(index))); }

  update(moment) {
    if (moment.touchNumber !== this.number) {
      this.number = moment.touchNumber;
      for (const shape of this.shapes.values()) shape?.dispose();
      this.shapes.clear();
    }
    this.marks.begin();
    for (const { patch, index, surface } of moment.hands.slice(0, 64)) {
      const solid = patch > 0 ? moment.touch.solids.find(({ first, patch_names: names }) => first <= patch && patch - first <= names?.length) : null;
      if (!solid) continue;
      this.show(this.marks.next(), solid, patch, index);
      const name = solid.patch_names[patch - solid.first - 1];
      if (name && this.view.rectangle.width > 400) this.labels.put(this.view, ...surface, foreign(name, 24), `hand hand-${index % 4}`, -16);
    }
    this.marks.end();
  }

  show(mark, solid, patch, index) {
    if (!this.shapes.has(patch)) this.shapes.set(patch, shapeOfPatch(solid, patch - solid.first));
    mark.geometry = this.shapes.get(patch);
    mark.material.color = this.colours[index % this.colours.length];
    mark.position.fromArray(solid.position);
    const [w, x, y, z] = solid.quaternion;
    mark.quaternion.set(x, y, z, w).normalize();
    mark.visible = true;
  }
}

// The triangles of only this patch; none for a solid that cannot be drawn.
function shapeOfPatch(solid, patch) {
  const out = new BufferGeometry();
  const corners = solidShape({ ...solid, patches: undefined })?.index;
  if (!corners) return out;
  const { triangles, vertices, patches } = solid;
  const at = triangles.filter((_, i) => patches[Math.floor(i / 3)] === patch).flatMap((i) => vertices.slice(3 * i, 3 * i + 3));
  return out.setAttribute('position', new BufferAttribute(new Float32Array(at), 3));
}
