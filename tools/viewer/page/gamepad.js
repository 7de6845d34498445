// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Gamepads of the browser: sticks, triggers and buttons of the standard mapping as a motion of a
// hand.
import { foreign } from './words.js';

export const STICK = { dead: 0.15, curve: 2 }; // share of its way that counts as rest; above 1 a small turn is finer
const TRIGGER = { dead: 0.05, curve: 2 };
const AXES = { right: 0, down: 1, nearer: 3 };
const BUTTONS = { first: 0, second: 1, nearer: 6, away: 7 };

const unit = (x) => (Number.isFinite(x) ? Math.max(-1, Math.min(1, x)) : 0);

// The gamepads that are connected; the list of the browser has gaps.
export function connectedPads() {
  try {
    return [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad && pad.connected !== false);
  } catch {
    return []; // forbidden by the browser
  }
}

// Name of a gamepad without its numbers of maker and product.
export function padName({ id }) {
  const name = String(id ?? '').replace(/^[0-9a-f]{1,4}-[0-9a-f]{1,4}-/i, '').replace(/\s*\((?=.*(?:vendor|standard)).*$/i, '');
  return foreign(name.trim() || 'gamepad', 40);
}

// A place of a stick, -1 to 1 along both axes, as a share of the greatest speed: the direction stays,
// the length has a dead zone and a curve.
export function shaped(x, y, { dead, curve } = STICK) {
  const [a, b] = [unit(x), unit(y)];
  const length = Math.hypot(a, b);
  if (length <= dead) return [0, 0];
  const share = ((Math.min(1, length) - dead) / (1 - dead)) ** curve / length;
  return [a * share, b * share];
}

// What a gamepad of the standard mapping asks for: `motion` right, up and away, each -1 to 1, and
// its first and second button.
export function readPad({ axes, buttons }) {
  const pressed = (i) => buttons?.[i]?.pressed === true;
  const trigger = (i) => shaped(buttons?.[i]?.value, 0, TRIGGER)[0];
  const [right, down] = shaped(axes?.[AXES.right], axes?.[AXES.down]);
  const [, nearer] = shaped(0, axes?.[AXES.nearer]);
  const away = unit(trigger(BUTTONS.away) - trigger(BUTTONS.nearer) - nearer);
  const motion = [right, -down, away].map((x) => x || 0); // no -0
  return { motion, moves: motion.some((x) => x !== 0), first: pressed(BUTTONS.first), second: pressed(BUTTONS.second) };
}
