// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Colours are defined only in page.css, once for each theme: hues of Okabe and Ito, which
// colour-blind people can distinguish.
import { Color } from './libraries.js';

export function cssColour(name) { return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim(); }
export function colour(name) { return new Color(cssColour(name)); }
export const SIDE_COLOURS = ['side-other', 'side-friendly', 'side-opposing', 'side-neutral'];
export const HAND_COLOURS = ['hand-0', 'hand-1', 'hand-2', 'hand-3'];
export function handColour(index) { return HAND_COLOURS[index % HAND_COLOURS.length]; }
