// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shapes of the scene's solids. Messages are checked, because the sender is not trusted.
import { BoxGeometry, BufferGeometry, Float32BufferAttribute, PlaneGeometry, SphereGeometry } from './libraries.js';

const MOST_TRIANGLES = 200000;

export function solidShape(solid) {
  const size = (x, other) => (Number.isFinite(x) && x > 0 ? x : other);
  switch (solid.shape) {
    case 'sphere': return new SphereGeometry(size(solid.radius, 0.1), 40, 28);
    case 'box': return new BoxGeometry(...[0, 1, 2].map((k) => size(solid.size?.[k], 0.1)));
    case 'plane': return new PlaneGeometry(size(solid.reach, 0.6), size(solid.reach, 0.6));
    case 'mesh': return meshShape(solid.vertices, solid.triangles, solid.patches);
    default: return null;
  }
}

// Corners are shared if triangles have no different patches, for smooth shading.
function meshShape(vertices, triangles, patches) {
  if (!Array.isArray(vertices) || !Array.isArray(triangles)) return null;
  const corners = vertices.length / 3;
  const good = triangles.length % 3 === 0 && triangles.length <= 3 * MOST_TRIANGLES && Number.isInteger(corners)
    && vertices.every(Number.isFinite) && triangles.every((i) => Number.isInteger(i) && i >= 0 && i < corners);
  if (!good) return null;
  const smooth = new BufferGeometry();
  smooth.setAttribute('position', new Float32BufferAttribute(vertices, 3));
  smooth.setIndex(triangles);
  smooth.computeVertexNormals();
  if (!Array.isArray(patches) || patches.length !== triangles.length / 3 || new Set(patches).size < 2) return smooth;
  const apart = smooth.toNonIndexed();
  const tint = patches.flatMap((patch) => Array(9).fill(1 - 0.16 * (Math.abs(patch) % 4)));
  apart.setAttribute('color', new Float32BufferAttribute(tint, 3));
  return apart;
}

// Radius of a solid around its position.
export function solidReach(solid, shape) {
  if (solid.shape === 'plane') return 0;
  shape.computeBoundingSphere();
  return shape.boundingSphere.radius + shape.boundingSphere.center.length();
}

// The same, if it is known without the shape; else null.
export function reachOf(solid) {
  const half = Array.isArray(solid.size) ? Math.hypot(...solid.size) / 2 : null;
  return solid.reach ?? solid.radius ?? half;
}
