// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Places of the world on WGS84: east, north and up of the origin [m], to latitude, longitude and
// height above the ellipsoid.
const EQUATOR = 6378137; // [m], radius
const FLATTENING = 1 / 298.257223563;
const SQUARED = FLATTENING * (2 - FLATTENING); // eccentricity
const DEGREE = Math.PI / 180;
const DEEPEST = 1e6; // [m] from the centre of the earth: nearer places are no real ones

// East, north and up at a latitude and longitude [deg], in geocentric axes.
function axesAt(lat, lon) {
  const [a, o] = [lat * DEGREE, lon * DEGREE];
  return [[-Math.sin(o), Math.cos(o), 0], [-Math.sin(a) * Math.cos(o), -Math.sin(a) * Math.sin(o), Math.cos(a)],
    [Math.cos(a) * Math.cos(o), Math.cos(a) * Math.sin(o), Math.sin(a)]];
}

function geocentric({ lat, lon, height }) {
  const [a, o] = [lat * DEGREE, lon * DEGREE];
  const normal = EQUATOR / Math.sqrt(1 - SQUARED * Math.sin(a) ** 2);
  return [(normal + height) * Math.cos(a) * Math.cos(o), (normal + height) * Math.cos(a) * Math.sin(o), (normal * (1 - SQUARED) + height) * Math.sin(a)];
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export class Geodesy {
  // `origin` has lat, lon [deg] and height [m].
  constructor(origin) {
    this.axes = axesAt(origin.lat, origin.lon);
    this.origin = geocentric(origin);
  }

  // A geocentric vector in the axes of the world.
  turned(vector) { return this.axes.map((axis) => dot(axis, vector)); }

  // Place in the world of a latitude, longitude and height.
  placeOf(place) {
    return this.turned(geocentric(place).map((x, k) => x - this.origin[k]));
  }

  // Latitude, longitude and height of a place in the world; null deep inside the earth.
  geodeticOf([x, y, z]) {
    const [e, n, u] = this.axes;
    const [gx, gy, gz] = this.origin.map((from, k) => from + x * e[k] + y * n[k] + z * u[k]);
    const flat = Math.hypot(gx, gy);
    if (!(Math.hypot(flat, gz) > DEEPEST)) return null;
    let height = 0;
    let a = Math.atan2(gz, flat * (1 - SQUARED));
    for (let i = 0; i < 6; ++i) {
      const normal = EQUATOR / Math.sqrt(1 - SQUARED * Math.sin(a) ** 2);
      height = flat * Math.cos(a) + gz * Math.sin(a) - EQUATOR * Math.sqrt(1 - SQUARED * Math.sin(a) ** 2);
      a = Math.atan2(gz, flat * (1 - (SQUARED * normal) / (normal + height)));
    }
    return { lat: a / DEGREE, lon: Math.atan2(gy, gx) / DEGREE, height };
  }

  // East, north and up at a place in the world.
  frameAt(place) {
    const at = this.geodeticOf(place);
    return at ? axesAt(at.lat, at.lon).map((axis) => this.turned(axis)) : null;
  }
}

// Heading [deg], from north by east, of a body's nose by its quaternion w x y z, against an east
// and a north.
export function headingOf([w, x, y, z], [east, north]) {
  const nose = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)];
  return (Math.atan2(dot(nose, east), dot(nose, north)) / DEGREE + 360) % 360;
}

export const LEVEL = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]; // east, north and up without an origin

// "36.59560° N".
export function degrees(x, digitsBehind, [positive, negative]) {
  return `${Math.abs(x).toFixed(digitsBehind)}° ${x < 0 ? negative : positive}`;
}
