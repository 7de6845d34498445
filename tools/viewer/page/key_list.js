// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keys and their functions: `?` shows this list, and the page executes it.
import { element } from './words.js';

// `page` has the parts that main.js assembles.
export const KEYS = [
  ['Space', 'pause, play', (page) => page.timeLine.playOrPause(), ' '],
  ['← →', 'one update back, on', (page, event) => page.timeLine.step(event.key === 'ArrowLeft' ? -2 : 2), 'ArrowLeft', 'ArrowRight'],
  ['Shift ← →', '1 s back, on', (page, event) => page.timeLine.step(event.key.endsWith('Left') ? -1 : 1), 'Shift+ArrowLeft', 'Shift+ArrowRight'],
  [', .', 'slower, faster', (page, event) => page.timeLine.faster(event.key === ',' ? -1 : 1), ',', '.'],
  ['End', 'live, or the end of a capture', (page) => page.timeLine.live(), 'End'],
  ['v', 'swap world and touch', (page) => page.swap(), 'v'],
  ['f', 'fit the picture', (page) => page.fit(), 'f'],
  ['k', 'keep all in the picture, or leave the camera', (page) => page.toggleLead(), 'k'],
  ['[ ]', 'turn the picture', (page, event) => page.turn(event.key === '[' ? -20 : 20, 0), '[', ']'],
  ['PgUp PgDn', 'tilt the picture', (page, event) => page.turn(0, event.key === 'PageUp' ? 20 : -20), 'PageUp', 'PageDown'],
  ['+ −', 'nearer, farther', (page, event) => page.zoom(event.key === '-' ? 1.15 : 1 / 1.15), '+', '=', '-'],
  ['c', 'friction cones', (page) => page.toggle('friction cones'), 'c'],
  ['g', 'predictions', (page) => page.toggle('predicted', 'predicted hand'), 'g'],
  ['h', 'take or release a hand', (page) => page.hand.askOrGive(), 'h'],
  ['w a s d', 'move your hand up, left, down, right', null],
  ['q e', 'move your hand away, nearer', null],
  ['Gamepad', 'left stick: your hand in the plane; right stick or triggers: depth', null],
  ['A B', 'gamepad (✕ ○): take a hand, hold what it touches; release it', null],
  ['o', 'outage of the demo\u2019s network', (page) => page.outage(), 'o'],
  ['p', 'save the picture', (page) => page.savePicture(), 'p'],
  ['m', 'save the last minute', (page) => page.saveMinute(), 'm'],
  ['t', 'light, dark', (page) => page.swapTheme(), 't'],
  ['l', 'log of actions', (page) => page.log.toggle(), 'l'],
  ['Esc', 'leave the tour, release the hand, stop following', (page) => page.escape(), 'Escape'],
  ['?', 'this list', (page) => page.showKeys(), '?'],
];

// Keys that a slider or a list handles itself.
const TAKEN = ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'Home', 'End', 'PageUp', 'PageDown'];

export function listenForKeys(page) {
  const acts = new Map(KEYS.flatMap(([, , act, ...names]) => names.map((name) => [name, act])));
  const dialog = document.getElementById('keys');
  document.getElementById('key-list').append(...KEYS.flatMap(([name, what]) => [element('dt', '', name), element('dd', '', what)]));
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || dialog.open) return;
    const { tagName } = event.target;
    if (tagName === 'SELECT' || (tagName === 'INPUT' && TAKEN.includes(event.key))) return;
    if (event.key === ' ' && tagName === 'BUTTON') return; // presses that button
    if (page.hand.key(event.key, true)) return;
    const act = acts.get(event.shiftKey && event.key.startsWith('Arrow') ? `Shift+${event.key}` : event.key);
    if (!act) return;
    event.preventDefault();
    act(page, event);
  });
  addEventListener('keyup', (event) => page.hand.key(event.key, false));
}
