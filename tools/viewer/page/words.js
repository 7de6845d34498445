// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Formats numbers and names for the user.

const WHOLE = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });

export function digits(x, count = 3) {
  if (x === null || x === undefined || !Number.isFinite(x)) return '–';
  const size = Math.abs(x);
  if (size >= 10 ** count) return WHOLE.format(x);
  const whole = size < 1 ? 1 : Math.floor(Math.log10(size)) + 1;
  return x.toFixed(Math.max(0, count - whole));
}

export function bitRate(x) {
  if (!Number.isFinite(x)) return '–';
  if (x >= 1e6) return `${digits(x / 1e6)} Mbit/s`;
  return `${digits(x / 1e3)} kbit/s`;
}

export function metres(x) {
  if (!Number.isFinite(x)) return '–';
  const size = Math.abs(x);
  if (size < 1) return `${digits(x * 1e3)} mm`;
  return size < 1000 ? `${digits(x)} m` : `${digits(x / 1e3)} km`;
}

export function speedText(x) { return `${x.toFixed(x < 9.95 ? 1 : 0)} m/s`; }

export function clock(seconds) {
  if (!Number.isFinite(seconds)) return '–';
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${(seconds - 60 * minutes).toFixed(1).padStart(4, '0')}`;
}

// Text from another host, shortened so that it cannot break the layout of the page.
export function foreign(text, most = 80) {
  const all = String(text ?? '');
  return all.length > most ? `${all.slice(0, most - 1)}…` : all;
}

// The next of 1, 2, 5, 10, .. that is at least x.
export function roundUp(x) {
  const power = 10 ** Math.floor(Math.log10(Math.max(x, 1e-9)));
  return power * [1, 2, 5, 10].find((step) => step * power >= x * 0.999999);
}

// The last of 1, 2, 5, 10, .. that is at most x.
export function roundDown(x) {
  const power = 10 ** Math.floor(Math.log10(Math.max(x, 1e-9)));
  return power * [5, 2, 1].find((step) => step * power <= x * 1.000001);
}

// "500 mm", "20 m", "5 km", of a round length.
export function roundMetres(x) {
  const [of, unit] = x < 1 ? [1e-3, 'mm'] : x < 1e3 ? [1, 'm'] : [1e3, 'km'];
  return `${Number((x / of).toPrecision(3)).toLocaleString('en')} ${unit}`;
}

export function element(tag, className, text, ...children) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text) made.textContent = text;
  made.append(...children);
  return made;
}

export function byId(id) { return document.getElementById(id); }
