// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The surface that is nearest to a hand: of other balls, spheres, boxes and planes exactly, of
// meshes their nearest corner.

const MOST_CORNERS = 20000; // of a mesh; a larger one is left out

export const minus = (a, b) => a.map((x, k) => x - b[k]);
const length = (a) => Math.hypot(...a);

// Rotated by a quaternion w x y z, or back.
export function rotated([w, x, y, z], [a, b, c], back) {
  const [u, v, t] = back ? [-x, -y, -z] : [x, y, z];
  const p = 2 * (v * c - t * b);
  const q = 2 * (t * a - u * c);
  const r = 2 * (u * b - v * a);
  return [a + w * p + v * r - t * q, b + w * q + t * p - u * r, c + w * r + u * q - v * p];
}

// In the axes of a solid.
function pointOn(solid, at) {
  switch (solid.shape) {
    case 'sphere': return at.map((x) => (x * solid.radius) / (length(at) || 1));
    case 'box': return at.map((x, k) => Math.max(-solid.size[k] / 2, Math.min(solid.size[k] / 2, x)));
    case 'plane': return [at[0], at[1], 0];
    case 'mesh': return nearestCorner(solid.vertices, at);
    default: return null;
  }
}

function nearestCorner(corners, [x, y, z]) {
  if (!Array.isArray(corners) || corners.length > 3 * MOST_CORNERS) return null;
  let best = -1;
  let least = Infinity;
  for (let i = 0; i < corners.length; i += 3) {
    const square = (corners[i] - x) ** 2 + (corners[i + 1] - y) ** 2 + (corners[i + 2] - z) ** 2;
    if (square < least) [least, best] = [square, i];
  }
  return best < 0 ? null : corners.slice(best, best + 3);
}

// { point, distance } [m] from the ball of a hand, and its solid if it is not a ball; the distance is
// negative inside a surface. Null without any surface.
export function nearestSurface(moment, hand, balls) {
  const points = balls.filter(({ slot, position }) => slot !== hand.slot && position !== hand.position).map(({ position, radius }) => {
    const away = minus(hand.position, position);
    return { point: position.map((x, k) => x + (away[k] * radius) / (length(away) || 1)) };
  });
  for (const solid of moment.touch.solids) {
    const pose = moment.bodies[solid.body] ?? { position: solid.position, turn: solid.quaternion };
    const point = pointOn(solid, rotated(pose.turn, minus(hand.position, pose.position), true));
    if (point) points.push({ solid, point: rotated(pose.turn, point, false).map((x, k) => x + pose.position[k]) });
  }
  const radius = moment.handRadius(hand.index);
  return points.map(({ solid, point }) => ({ solid, point, distance: length(minus(hand.position, point)) - radius }))
    .reduce((best, one) => (!best || one.distance < best.distance ? one : best), null);
}
