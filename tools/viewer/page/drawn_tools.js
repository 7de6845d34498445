// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The tool of a hand whose device turns: a bar from the handle to each probe, a knob at each, and the torque in words.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, SphereGeometry } from './libraries.js';
import { Pool } from './arrow.js';
import { colour, handColour } from './colours.js';
import { digits } from './words.js';

const MOST = 8;
const LEAST_TORQUE = 0.0005; // [N m], below it nothing is felt

export const drawnTools = {
  name: 'tools', view: 'touch', says: 'tool and its probes', mark: 'knobs',
  make(group, view, labels) { return new Tools(group, view, labels); },
};

class Tools {
  constructor(group, view, labels) {
    Object.assign(this, { view, labels });
    this.tools = new Pool(() => new Tool(group));
  }

  paint() { for (const tool of this.tools.list) tool.paint(); }

  update(moment) {
    this.tools.begin();
    for (const { index, tool } of moment.hands.slice(0, 64)) {
      if (!tool) continue;
      this.tools.next().set(index, tool, 0.4 * moment.handRadius(index));
      if (tool.newtonMetres < LEAST_TORQUE || this.view.rectangle.width < 400) continue;
      const [x, y, z] = tool.handle;
      this.labels.put(this.view, x, y, z, `${digits(1000 * tool.newtonMetres)} mN m`, 'newtons', -16);
    }
    this.tools.end();
  }
}

class Tool {
  constructor(group) {
    this.material = new MeshLambertMaterial();
    this.knobs = Array.from({ length: MOST }, () => new Mesh(new SphereGeometry(1, 20, 14), this.material));
    this.lineMaterial = new LineBasicMaterial();
    this.bars = new LineSegments(new BufferGeometry(), this.lineMaterial);
    this.bars.geometry.setAttribute('position', new Float32BufferAttribute(new Float32Array(6 * MOST), 3));
    this.bars.frustumCulled = false;
    group.add(this.bars, ...this.knobs);
  }

  paint() {
    this.material.color = colour(handColour(this.index));
    this.lineMaterial.color = colour(handColour(this.index));
  }

  set(index, { handle, probes }, radius) {
    if (index !== this.index) {
      this.index = index;
      this.paint();
    }
    const { position } = this.bars.geometry.attributes;
    this.knobs.forEach((knob, i) => {
      knob.visible = i < probes.length;
      position.array.set([...handle, ...(probes[i] ?? handle)], 6 * i);
      if (!knob.visible) return;
      knob.scale.setScalar(radius);
      knob.position.fromArray(probes[i]);
    });
    position.needsUpdate = true;
    this.bars.visible = true;
  }

  hide() { for (const part of [this.bars, ...this.knobs]) part.visible = false; }
}
